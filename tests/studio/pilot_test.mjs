// SPDX-License-Identifier: Apache-2.0
// node --test pilot_test.mjs, with ARMATURE=the program: the rover's control program from an empty canvas, by mouse and by keyboard alone
// (docs/rover.md). Skipped without chromium.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { application } from "./application.mjs";
import { begin, finish, folder, skip, studio, user } from "./session.mjs";
import { expected_lines, lay_out, without_comments } from "./pilot.mjs";
import { assemble_by_keys } from "./pilot_by_keys.mjs";
import { assemble_by_mouse } from "./pilot_by_mouse.mjs";

/** Room for all boxes at once, as a wire is dragged from one to another. */
const kScreen = { viewport: { width: 3000, height: 1900 } };

before(async () => {
  await begin();
  lay_out();
});
after(finish);

async function expect_the_pilot_of(assemble, name) {
  const { file, address, content, end } = await studio(`rover/deployments/${name}`);
  await assemble(await user(address, kScreen));
  assert.deepEqual(without_comments(content()), expected_lines());
  const made = application(file);
  assert.equal(made.ok, true);
  assert.deepEqual(made, application(join(folder, "rover/deployments/pilot.yaml")));
  await end("SIGTERM");
}

test("the rover's pilot is assembled by mouse, line for line as it is shipped", { skip, timeout: 240_000 }, () => expect_the_pilot_of(assemble_by_mouse, "mouse.yaml"));

test("by keyboard alone the same pilot is assembled", { skip, timeout: 240_000 }, () => expect_the_pilot_of(assemble_by_keys, "keys.yaml"));
