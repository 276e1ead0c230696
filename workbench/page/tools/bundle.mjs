// Bundles the page and the viewer: node bundle.mjs FOLDER. Everything that a browser loads ends up in these files.
import { copyFileSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const page = dirname(dirname(fileURLToPath(import.meta.url)));
const folder = process.argv[2] ?? join(page, "dist");
mkdirSync(folder, { recursive: true });

const common = {
  absWorkingDir: page,
  bundle: true,
  minify: true,
  target: "es2022",
  charset: "ascii",
  legalComments: "eof",
  logLevel: "warning",
};
await build({ ...common, entryPoints: { app: "src/app/main.ts" }, format: "esm", outdir: folder });
await build({ ...common, entryPoints: { viewer: "src/viewer/main.ts" }, format: "iife", outdir: folder });
copyFileSync(join(page, "src", "app", "index.html"), join(folder, "index.html"));
