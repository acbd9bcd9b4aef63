// SPDX-License-Identifier: Apache-2.0
// node --test walk_test.mjs, with ARMATURE=the program: docs/studio_walk.md, by mouse and by keyboard alone. Skipped without chromium.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { application } from "./application.mjs";
import { begin, finish, folder, skip, studio, user } from "./session.mjs";
import { assemble_by_keys } from "./keys.mjs";
import { lay_out, walk } from "./walk.mjs";

before(async () => {
  await begin();
  lay_out();
});
after(finish);

function expect_the_reference(file) {
  const made = application(file);
  assert.equal(made.ok, true);
  assert.deepEqual(made, application(join(folder, "demo/assembled.yaml")));
}

test("the walk ends with the head at its target, and with the application of the reference", { skip, timeout: 240_000 }, async () => {
  const { file, address, end } = await studio("demo/mine.yaml");
  await walk(await user(address));
  expect_the_reference(file);
  await end("SIGTERM");
});

test("by keyboard alone the same application is assembled", { skip, timeout: 240_000 }, async () => {
  const { file, address, end } = await studio("demo/keys.yaml");
  await assemble_by_keys(await user(address));
  expect_the_reference(file);
  await end("SIGTERM");
});
