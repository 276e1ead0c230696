// Installs the packages of package-lock.json where they are not installed already: node packages.mjs NPM.
// Registry and proxies are those that npm is configured with.
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const page = dirname(dirname(fileURLToPath(import.meta.url)));
const lock = createHash("sha256").update(readFileSync(join(page, "package-lock.json"))).digest("hex");
const mark = join(page, "node_modules", ".installed-lock");
if (existsSync(mark) && readFileSync(mark, "utf8") === lock) process.exit(0);

// Scripts of packages stay off: none that is used needs one.
const words = ["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"];
const done = spawnSync(process.argv[2] ?? "npm", words, { cwd: page, encoding: "utf8" });
if (done.status !== 0) {
  process.stderr.write(`${done.stdout ?? ""}${done.stderr ?? ""}npm ci failed in workbench/page\n`);
  process.exit(1);
}
writeFileSync(mark, lock);
