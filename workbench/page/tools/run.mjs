// Runs a script in TypeScript: node run.mjs SCRIPT.ts ARGUMENT..., bundled as it is with its packages left where they are.
import { mkdirSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { build } from "esbuild";

const page = dirname(dirname(fileURLToPath(import.meta.url)));
const script = resolve(process.argv[2] ?? "");
const folder = join(page, "node_modules", ".cache"); // below it, so that packages are found
mkdirSync(folder, { recursive: true });
const bundle = join(folder, `${basename(script, ".ts")}.mjs`);
process.env.CLEARLOCI_BROWSER_DIR = dirname(script);
await build({ entryPoints: [script], bundle: true, platform: "node", format: "esm", packages: "external", outfile: bundle, logLevel: "warning" });
await import(pathToFileURL(bundle).href);
