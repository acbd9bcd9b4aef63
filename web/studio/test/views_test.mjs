// SPDX-License-Identifier: Apache-2.0
// node --test views_test.mjs, with PAGE=FOLDER that has the page over the mock: a robot in 3D, a cycle,
// what is set for a run, lanes, and the parameters of commands. Skipped without a browser.
import assert from "node:assert/strict";
import { drag, edits, eventually, node, open_robot, page_test } from "./page.mjs";

const joints = (page) => page.locator(".joints tbody tr").evaluateAll((rows) => rows.map((row) => row.textContent));

page_test("a robot is shown in 3D and moved by the run; its view is loaded when it is opened", "arm", async (page) => {
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  await open_robot(page);
  assert.ok(asked.some((url) => /part-.*\.js$/.test(url)), "its code comes now");
  assert.equal((await joints(page)).length, 7);
  assert.match((await joints(page))[0], /^joint1no value-2\.6 … 2\.6 rad$/);
  await page.getByText("All joints are shown at 0.").waitFor();
  const canvas = page.locator(".stage canvas");
  await page.waitForTimeout(500);
  const rest = await canvas.screenshot();
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".joints .position", { hasText: "rad" }).first().waitFor();
  assert.match((await joints(page))[6], /^joint7-?\d\.\d{3} rad-?\d+\.\d°/);
  await eventually(async () => rest.equals(await canvas.screenshot()), false);
  await page.keyboard.press("Shift+Escape");
  await page.getByText("All joints are shown at 0.").waitFor();
});

page_test("keys turn the view of a robot, zoom it, and show all of it again", "arm", async (page) => {
  await open_robot(page);
  const canvas = page.getByRole("application", { name: /wam7 in 3D/ });
  await canvas.focus();
  await page.keyboard.press("Home"); // by which it shows that it has the focus
  await page.waitForTimeout(500);
  const home = await canvas.screenshot();
  let before = home;
  for (const key of ["ArrowLeft", "ArrowUp", "+"]) {
    await page.keyboard.press(key);
    await eventually(async () => before.equals(await canvas.screenshot()), false);
    before = await canvas.screenshot();
  }
  await page.keyboard.press("Home");
  await eventually(async () => home.equals(await canvas.screenshot()), true);
});

page_test("what moves a robot is the user's choice, and is kept", "arm", async (page) => {
  await open_robot(page);
  const choice = page.getByLabel("Moved by");
  assert.equal(await choice.locator("option:checked").textContent(), "found: Sensor.sensor");
  await choice.selectOption("Joint{1..7}.Position");
  await eventually(() => edits(page), ["robot Robot Joint{1..7}.Position"]);
  await page.getByRole("button", { name: "Robot", exact: true }).click();
  await open_robot(page);
  assert.equal(await choice.inputValue(), "Joint{1..7}.Position");
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".joints .position", { hasText: "rad" }).nth(6).waitFor();
});

page_test("without WebGL the joints' positions are in the table", "arm", async (page) => {
  await page.evaluate(() => (HTMLCanvasElement.prototype.getContext = () => null));
  await open_robot(page);
  await page.getByText("This browser has no WebGL").waitFor();
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".joints .position", { hasText: "rad" }).first().waitFor();
});

page_test("a robot whose description cannot be read says why", "arm", async (page) => {
  await page.evaluate(() => (window.mock.workbench.description = async () => "<sdf/>"));
  await page.getByRole("button", { name: "Robot", exact: true }).click();
  await page.getByText("The robot of Robot is not shown: the description begins with <sdf>, expected <robot>").waitFor();
  await page.getByRole("button", { name: "Robot", exact: true }).click();
  await page.evaluate(() => (window.mock.workbench.description = async (path) => Promise.reject(new Error(`${path} is not there`))));
  await page.getByRole("button", { name: "Robot", exact: true }).click();
  await page.getByText("wam7.urdf is not there").waitFor();
});

page_test("one cycle of a chosen thread is drawn in microseconds, and held", "arm", async (page) => {
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByRole("tab", { name: "Cycle" }).click();
  await page.locator(".bars tbody tr").nth(6).waitFor();
  assert.match(await page.locator(".bars tbody tr").first().textContent(), /^Joint1\d+\.\d us/);
  await page.getByRole("button", { name: "Hold" }).click();
  await page.waitForTimeout(600);
  const held = await page.locator(".cycle .about").textContent();
  assert.match(held, /^Cycle \d+ at \d+\.\d{3} s: \d+\.\d us of 10 ms, \d+\.\d %$/);
  await page.waitForTimeout(900);
  assert.equal(await page.locator(".cycle .about").textContent(), held);
  await page.getByRole("button", { name: "Hold" }).click();
  await page.getByLabel("Thread", { exact: true }).selectOption("Generator");
  await page.locator(".bars tbody tr", { hasText: "Generator" }).waitFor();
});

page_test("no cycle is asked for while nobody looks", "arm", async (page) => {
  const asked = () => page.evaluate(() => window.mock.run.cycles);
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.waitForTimeout(900);
  assert.equal(await asked(), 0);
  await page.getByRole("tab", { name: "Cycle" }).click();
  await page.locator(".bars").waitFor();
  await page.getByRole("tab", { name: "Log" }).click();
  await page.waitForTimeout(500); // the last one is answered
  const then = await asked();
  await page.waitForTimeout(900);
  assert.equal(await asked(), then);
});

page_test("a run begins in the mode and with the values that were set for it", "arm", async (page) => {
  await page.getByLabel("Mode", { exact: true }).selectOption("work");
  await page.getByRole("button", { name: "Set …" }).click();
  await page.getByLabel("Name 1").fill("Joint1.MaxVelocity");
  assert.equal(await page.getByLabel("Value 1").getAttribute("placeholder"), "3");
  await page.getByLabel("Value 1").fill("2 rad/s");
  await page.keyboard.press("Enter");
  assert.equal(await page.getByLabel("Name 1").count(), 0, "Enter closes it");
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByText("running", { exact: true }).waitFor();
  const orders = await page.evaluate(() => window.mock.workbench.orders);
  assert.deepEqual(orders, [{ simulated: true, pace: 1, mode: "work", overrides: ["Joint1.MaxVelocity=2 rad/s"] }]);
  assert.deepEqual(await edits(page), [], "the file stays as it is");
});

page_test("a deployment without modes offers none", "wave", async (page) => {
  assert.equal(await page.getByLabel("Mode", { exact: true }).count(), 0);
});

page_test("threads are lanes, and boxes go back to their places", "arm", async (page) => {
  const places = () => page.locator(".react-flow__node").evaluateAll((nodes) => nodes.map((one) => one.style.transform));
  const before = await places();
  await page.getByRole("button", { name: "Threads as lanes" }).click();
  await eventually(() => page.locator(".lane").allTextContents(), ["Joint", "Generator", "Driver", "Jog", "Power"]);
  const is_inside = () => page.evaluate(() => {
    const rect_of = (css) => [...document.querySelectorAll(css)].find((one) => one.textContent.startsWith("Power")).getBoundingClientRect();
    const [lane, box] = [rect_of(".lane"), rect_of(".react-flow__node")];
    return box.top > lane.top && box.bottom < lane.bottom && box.left > lane.left;
  });
  await eventually(is_inside, true);
  await page.getByRole("button", { name: "Threads as lanes" }).click();
  await eventually(places, before);
  assert.equal((await page.evaluate(() => window.mock.workbench.edits)).length, 0, "nothing is moved by it");
});

page_test("wires that leave an open composite are told at its ports", "arm", async (page) => {
  await node(page, "Rover").locator("header").dblclick();
  await node(page, "mixer").locator(".outside", { hasText: "Driver.Forward" }).waitFor();
  await node(page, "left").locator(".outside", { hasText: "Driver.Left" }).waitFor();
});

/** The inspector of the connection Power.TurnedOn -> Generator.moveTo. */
async function select_command(page) {
  await page.locator("[aria-label='Power.TurnedOn to Generator.moveTo']").first().focus();
  await page.keyboard.press("Enter");
}

page_test("the parameters of a command are changed where its event is connected", "arm", async (page) => {
  await select_command(page);
  const field = page.getByLabel("time", { exact: true });
  assert.equal(await field.inputValue(), "2 s");
  await field.fill("3 s");
  await field.press("Enter");
  await eventually(() => edits(page), ["connection Power.TurnedOn Generator.moveTo name: Move, with: {target: Sensor.sensor, time: 3 s}"]);
});

page_test("a command opens into pins, to which wires lead and from which they are taken", "arm", async (page) => {
  await select_command(page);
  await page.getByRole("button", { name: "Parameters as pins" }).click();
  await node(page, "Move").waitFor();
  assert.equal(await node(page, "Move").locator(".outside").textContent(), "2 s");
  await drag(page, node(page, "Jog").locator(".pin.output"), node(page, "Move").locator(".pin.input").nth(1));
  await eventually(async () => (await edits(page)).length, 1);
  await page.locator("[aria-label='Jog.Out to Move.time']").first().waitFor({ state: "attached" });
  await page.locator("[aria-label='Sensor.sensor to Move.target']").first().focus();
  await page.keyboard.press("Enter");
  await page.waitForTimeout(150);
  await page.keyboard.press("Delete");
  await eventually(() => edits(page), [
    "connection Power.TurnedOn Generator.moveTo name: Move, with: {target: Sensor.sensor, time: Jog.Out}",
    "connection Power.TurnedOn Generator.moveTo name: Move, with: {time: Jog.Out}",
  ]);
  await node(page, "Move").locator("header").click();
  await page.waitForTimeout(150);
  await page.keyboard.press("Delete");
  await eventually(async () => (await edits(page)).slice(2), ["disconnect Power.TurnedOn Generator.moveTo"]);
});
