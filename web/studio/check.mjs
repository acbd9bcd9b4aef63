// SPDX-License-Identifier: Apache-2.0
// node check.mjs, with PLACEHOLDERS=FOLDER that rcidl wrote: the types of all sources and tests.
import { spawnSync } from "node:child_process";
import { rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const settings = join(tmpdir(), `studio-types-${process.pid}.json`);
writeFileSync(settings, JSON.stringify({
  extends: join(here, "tsconfig.json"),
  compilerOptions: {
    typeRoots: [join(here, "../node_modules/@types")],
    paths: {
      "@armature/ride": [join(here, "../ride/src/ride.ts")],
      "@armature/placeholders/*": [join(resolve(process.env.PLACEHOLDERS), "*")],
    },
  },
  include: [join(here, "src"), join(here, "test")],
}));
const { status } = spawnSync(process.execPath, [join(here, "../node_modules/typescript/bin/tsc"), "-p", settings], { stdio: "inherit" });
rmSync(settings);
process.exitCode = status ?? 1;
