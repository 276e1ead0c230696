// Writes the bundles and the examples as C++ sources: node bytes.mjs BUNDLES EXAMPLES.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";

const [folder, examples] = process.argv.slice(2);

/** The bytes as string literals, each short enough for a line. */
function literal(bytes) {
  const lines = [];
  let line = "";
  for (const byte of bytes) {
    const plain = byte >= 0x20 && byte < 0x7f && byte !== 0x22 && byte !== 0x5c && byte !== 0x3f;
    line += plain ? String.fromCharCode(byte) : `\\${byte.toString(8).padStart(3, "0")}`;
    if (line.length > 110) {
      lines.push(`"${line}"`);
      line = "";
    }
  }
  lines.push(`"${line}"`);
  return lines.join("\n");
}

const view = (bytes) => `std::string_view(${literal(bytes)}, ${bytes.length})`;
const bundle = (name) => readFileSync(join(folder, name));

writeFileSync(
  join(folder, "viewer_bytes.cpp"),
  `#include "report/viewer.hpp"
namespace clearloci::report {
ViewerBundle viewer_bundle() {
return {${view(bundle("viewer.js"))},
${view(bundle("viewer.css"))}};
}
}  // namespace clearloci::report
`,
);

function yamlFiles(at) {
  return readdirSync(at, { withFileTypes: true })
    .flatMap((entry) => (entry.isDirectory() ? yamlFiles(join(at, entry.name)) : [join(at, entry.name)]))
    .filter((path) => path.endsWith(".yaml"))
    .sort();
}

function assets(name, entries) {
  const list = entries.map(([path, bytes]) => `{"${path}",\n${view(bytes)}}`).join(",\n");
  return `std::span<const Asset> ${name}() {
static constexpr Asset all[] = {${list}};
return all;
}
`;
}

const pageFiles = ["index.html", "app.js", "app.css"].map((name) => [name, bundle(name)]);
const exampleFiles = yamlFiles(examples).map((path) => [relative(examples, path), readFileSync(path)]);
writeFileSync(
  join(folder, "page_bytes.cpp"),
  `#include "workbench/server/assets.hpp"
namespace clearloci::workbench {
${assets("page_assets", pageFiles)}${assets("example_assets", exampleFiles)}}  // namespace clearloci::workbench
`,
);
