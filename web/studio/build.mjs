// SPDX-License-Identifier: Apache-2.0
// node build.mjs PLACEHOLDERS OUTPUT [--mock]: bundles the studio's page into a folder of files.
// PLACEHOLDERS has what rcidl --typescript made of inspection.idl and workbench.idl.
import { build } from "esbuild";
import { cp, mkdir, rm } from "node:fs/promises";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [placeholders, output, mock] = process.argv.slice(2);

await rm(output, { recursive: true, force: true });
await mkdir(output, { recursive: true });
await build({
  entryPoints: [
    { in: join(here, mock ? "test/mock/page.ts" : "src/studio.tsx"), out: "studio" },
    { in: join(here, "studio.css"), out: "studio" },
  ],
  outdir: output,
  entryNames: "[name]",
  chunkNames: "part-[hash]",
  bundle: true,
  splitting: true,
  minify: true,
  format: "esm",
  target: "es2022",
  jsx: "automatic",
  logLevel: "warning",
  legalComments: "linked",
  loader: { ".urdf": "text" },
  define: { "process.env.NODE_ENV": '"production"' },
  alias: {
    // Files of meshes are not drawn: their readers, which urdf-loader brings, stay out.
    "three/examples/jsm/loaders/STLLoader.js": join(here, "src/no_meshes.ts"),
    "three/examples/jsm/loaders/ColladaLoader.js": join(here, "src/no_meshes.ts"),
    "@armature/ride": join(here, "../ride/src/ride.ts"),
    "@armature/placeholders/inspection": resolve(placeholders, "inspection.ts"),
    "@armature/placeholders/workbench": resolve(placeholders, "workbench.ts"),
  },
});
for (const file of ["index.html", "icon.svg"]) await cp(join(here, file), join(output, file));
