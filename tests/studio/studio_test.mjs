// SPDX-License-Identifier: Apache-2.0
// node --test studio_test.mjs, with ARMATURE=the program: the page in chromium at a real studio, whose
// checks and runs are real, too. Skipped without chromium.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { after, before, test } from "node:test";
import { add, begin, box, drag, finish, program, skip, studio, until, user } from "./session.mjs";

before(begin);
after(finish);

const studio_test = (name, body) => test(name, { skip, timeout: 240_000 }, body);

studio_test("examples/02 is assembled from nothing by mouse, saved, run, watched and stopped", async () => {
  const { file, address, end, content } = await studio("new.yaml");
  const page = await user(address);
  await add(page, "source", "Source");
  await add(page, "lowpass", "LowPass");
  await add(page, "watcher", "Watcher");
  await page.keyboard.press("Escape");
  await drag(page, box(page, "Source").locator(".pin.output").first(), box(page, "LowPass").locator(".pin.input").first());
  await until(async () => (await page.locator(".react-flow__edge").count()) === 1, "Source is connected");
  await drag(page, box(page, "LowPass").locator(".pin.output").first(), box(page, "Watcher").locator(".pin.input").first());
  await until(async () => (await page.locator(".react-flow__edge").count()) === 2, "LowPass is connected");
  for (const [name, activity] of [["Source", "{periodic: 10 ms}"], ["Watcher", "{periodic: 200 ms}"]]) {
    await box(page, name).locator("header").click();
    const field = page.getByLabel("Activity", { exact: true });
    await field.fill(activity);
    await field.press("Enter");
    await until(async () => (await box(page, name).textContent()).includes("every"), `${name} has an activity`);
  }
  assert.equal(existsSync(file), false, "nothing is written before it is saved");
  await page.getByRole("button", { name: "Save and run" }).click();
  await page.locator(".port .value:not(:empty)").first().waitFor();
  assert.match(content(), /Source\.Position -> LowPass\.Raw/);
  assert.equal(spawnSync(program, ["check", file]).status, 0);
  await page.keyboard.press("Shift+Escape");
  await page.getByText("ended", { exact: true }).waitFor();
  await end("SIGTERM");
});

const kWave = "application: wave\nlibraries: [wave]\ncomponents:\n  Source: {model: Source, activity: {periodic: 10 ms}}\n";

studio_test("two people see what each of them does; one undoes it", async () => {
  const { address, end } = await studio("two.yaml", kWave);
  const one = await user(address);
  const other = await user(address);
  await add(one, "watcher", "Watcher");
  await box(other, "Watcher").waitFor();
  await other.keyboard.press("Control+z");
  await until(async () => (await box(one, "Watcher").count()) === 0, "it is gone at the first one's, too");
  await end("SIGTERM");
});

studio_test("a studio that is killed loses no run and no edit", async () => {
  const first = await studio("kept.yaml", kWave);
  const page = await user(first.address);
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".port .value:not(:empty)").first().waitFor();
  await add(page, "watcher", "Watcher");
  await first.end("SIGKILL");
  await page.getByText("The connection to the studio is lost").waitFor();
  const second = await studio("kept.yaml");
  const again = await user(second.address);
  await box(again, "Watcher").waitFor();
  await again.locator(".port .value:not(:empty)").first().waitFor();
  assert.equal(second.content(), kWave, "nothing is saved by that");
  await again.keyboard.press("Shift+Escape");
  await again.getByText("ended", { exact: true }).waitFor();
  await second.end("SIGTERM");
});

studio_test("a studio that is started again has the pages back that are open, unasked", async () => {
  const first = await studio("again.yaml", kWave);
  const page = await user(first.address);
  await first.end("SIGKILL");
  await page.getByText("The connection to the studio is lost").waitFor();
  const second = await studio("again.yaml", undefined, new URL(first.address).port);
  assert.equal(second.address, first.address);
  await page.getByText("The connection to the studio is lost").waitFor({ state: "detached" });
  await add(page, "watcher", "Watcher");
  await second.end("SIGTERM");
});

studio_test("a file full of mistakes opens and is mended by its fixes", async () => {
  const { address, end, content } = await studio("wrong.yaml", kWave.replace("{model: Source", "{model: Sourc") + "connections:\n  - Source.Position -> Nobody.In\n");
  const page = await user(address);
  await page.getByRole("button", { name: "Write Source" }).click();
  await box(page, "Source").waitFor();
  await page.getByText("Nobody").first().waitFor();
  await page.keyboard.press("Control+s");
  await until(() => content().includes("{model: Source,"), "the fix is saved");
  await end("SIGTERM");
});
