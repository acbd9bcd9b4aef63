// SPDX-License-Identifier: Apache-2.0
// node --test foxglove_seat_test.mjs, with ARMATURE=the program: who operates hands the seat
// over to a client of Foxglove, which then sets parameters. Skipped without chromium.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { client, file_of } from "./foxglove_session.mjs";
import { begin, finish, sit_down, skip, studio, until, user } from "./session.mjs";

before(begin);
after(finish);

test("parameters are set from the operator's seat, which is handed over", { skip, timeout: 240_000 }, async () => {
  const { address, foxglove, end } = await studio("head.yaml", `include: ${file_of("robots/janus/demo/studio.yaml")}\napplication: janus\n`);
  const page = await user(address);
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".run-state", { hasText: "running" }).waitFor();
  const one = await client(foxglove);
  const name = "PID1.Kp";
  const before = (await one.ask((id) => one.library.getParameters([name], id))).get(name);
  const set = async (value) => (await one.ask((id) => one.library.setParameters([{ name, value }], id))).get(name);
  assert.equal(await set(before + 1), before, "nobody sits there");
  await page.getByRole("tab", { name: "Operate" }).click();
  await sit_down(page);
  assert.equal(await set(before + 1), before, "somebody else sits there");
  const hand_over = page.getByLabel("Hand the seat over");
  await hand_over.locator("option", { hasText: "foxglove@web" }).waitFor({ state: "attached" });
  await hand_over.selectOption({ label: (await hand_over.locator("option", { hasText: "foxglove@web" }).textContent()) ?? "" });
  await until(async () => (await set(before + 1)) === before + 1, () => one.said());
  one.library.setParameters([{ name: "AIC1.position_confirmed", value: true }], "word");
  await until(() => /word of the operator/.test(one.said()), () => one.said());
  one.library.close();
  await sit_down(page);
  await end("SIGINT");
});
