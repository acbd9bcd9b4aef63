// SPDX-License-Identifier: Apache-2.0
// node --test assembly_test.mjs, with PAGE=FOLDER that has the page over the mock: what is called, who
// commands, what is included, and modes; by mouse and by keyboard alone. Skipped without a browser.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { edits, edits_are, eventually, node, page_test, text_of } from "./page.mjs";

const inspect = (page, name) => node(page, name).locator("header").click();
const kThreshold = "{call: Vision.setThreshold, with: {low: 10, far: Dial.Out}}";

page_test("a call is added, moved, given a parameter and taken away", "vision", async (page) => {
  await inspect(page, "Prepare");
  const calls = page.getByRole("region", { name: "Calls" });
  await calls.getByLabel("New call").fill("Vision.start");
  await page.keyboard.press("Enter");
  await calls.getByLabel("Call 3", { exact: true }).waitFor();
  assert.equal(await calls.getByLabel("New call").inputValue(), "");
  await calls.getByRole("button", { name: "Call Vision.start earlier" }).click();
  await eventually(() => calls.getByLabel("Call 2", { exact: true }).inputValue(), "Vision.start");
  const far = calls.getByLabel("far", { exact: true });
  await far.fill("2 m");
  await far.press("Enter");
  await calls.getByRole("button", { name: "Call Vision.initialize no more" }).click();
  await edits_are(page, [
    `calls Prepare [Vision.initialize, ${kThreshold}, Vision.start]`,
    `calls Prepare [Vision.initialize, Vision.start, ${kThreshold}]`,
    "calls Prepare [Vision.initialize, Vision.start, {call: Vision.setThreshold, with: {low: 10, far: 2 m}}]",
    "calls Prepare [Vision.start, {call: Vision.setThreshold, with: {low: 10, far: 2 m}}]",
  ]);
});

page_test("a Request asks one operation, which is changed where it stands", "vision", async (page) => {
  await inspect(page, "Ask");
  const field = page.getByRole("region", { name: "Calls" }).getByLabel("Call 1", { exact: true });
  assert.equal(await field.inputValue(), "Vision.start");
  assert.equal(await page.getByLabel("New call").count(), 0);
  await field.fill("Vision.initialize");
  await field.press("Enter");
  await edits_are(page, ["calls Ask [Vision.initialize]"]);
});

page_test("F6 goes from part to part of the page, and Shift+F6 back", "vision", async (page) => {
  const part = () => page.evaluate(() => [".top-bar", ".palette", ".outline", "main", ".inspector", ".panel"].findIndex((one) => document.querySelector(one).contains(document.activeElement)));
  for (const expected of [0, 1, 2, 3, 4, 5, 0]) {
    await page.keyboard.press("F6");
    assert.equal(await part(), expected);
  }
  await page.keyboard.press("Shift+F6");
  assert.equal(await part(), 5);
});

page_test("/ in the outline goes to a box or port by its name; Escape and an unknown name stay", "vision", async (page) => {
  const row = page.locator('.outline [role="treeitem"]:focus .name');
  const go = async (name) => {
    await page.keyboard.press("/");
    await page.getByLabel("Go to").fill(name);
    await page.keyboard.press("Enter");
  };
  await page.locator('.outline [role="treeitem"][tabindex="0"]').focus();
  await go("Prepare");
  await eventually(() => row.textContent(), "Prepare");
  await go("dial.out");
  await eventually(() => row.textContent(), "Out");
  await go("Nobody");
  await eventually(() => row.textContent(), "Out");
  await page.keyboard.press("/");
  await page.keyboard.press("Escape");
  await eventually(() => row.textContent(), "Out");
});

page_test("a model is added by the name that stands before it", "vision", async (page) => {
  await page.getByLabel("Find a model").fill("Eye=Camera");
  await page.keyboard.press("Enter");
  await edits_are(page, ["add Eye Camera"]);
});

page_test("what is no caller has no calls", "vision", async (page) => {
  await inspect(page, "Dial");
  assert.equal(await page.getByRole("region", { name: "Calls" }).count(), 0);
});

page_test("superiors stand beside peers, and are added and taken", "vision", async (page) => {
  await inspect(page, "Prepare");
  const superiors = page.getByRole("region", { name: "Superiors" });
  await superiors.getByLabel("New superior").fill("Ask");
  await page.keyboard.press("Enter");
  await superiors.getByRole("button", { name: "Remove the superior Ask" }).waitFor();
  await superiors.getByRole("button", { name: "Remove the superior Dial" }).click();
  await edits_are(page, ["superior Prepare Ask", "no_superior Prepare Dial"]);
});

page_test("files are included, and no longer, with nothing selected", "vision", async (page) => {
  const files = page.getByRole("region", { name: "Included files" });
  await files.getByRole("button", { name: "Include lamp.yaml no more" }).click();
  await files.getByText("lamp.yaml").waitFor({ state: "detached" });
  await files.getByLabel("File to include").fill("robot.yaml");
  await page.keyboard.press("Enter");
  await files.getByRole("button", { name: "Include robot.yaml no more" }).waitFor();
  await edits_are(page, ["no_include lamp.yaml", "include robot.yaml"]);
});

const modes = (page) => page.getByRole("tab", { name: "Modes" }).click();

page_test("a mode is made, filled, renamed and removed by the keyboard alone", "vision", async (page) => {
  await page.getByRole("tab", { name: "Problems" }).focus();
  for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowRight");
  await page.getByLabel("Name of the new mode").focus();
  await page.keyboard.type("night");
  await page.keyboard.press("Tab");
  await page.keyboard.type("Lamp");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await page.getByLabel("Name of the mode night").waitFor();
  await page.getByLabel("Dial stands in night").focus();
  await page.keyboard.press("Space");
  await eventually(() => page.getByLabel("Dial stands in night").isChecked(), true);
  await page.keyboard.press("Space");
  await eventually(() => page.getByLabel("Dial stands in night").isChecked(), false);
  await page.getByLabel("Name of the mode night").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.type("sleep");
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Remove the mode sleep" }).focus();
  await page.keyboard.press("Enter");
  await page.getByLabel("Name of the mode sleep").waitFor({ state: "detached" });
  await edits_are(page, ["to_mode night Lamp", "to_mode night Dial", "from_mode night Dial", "rename_mode night sleep", "no_mode sleep"]);
});

page_test("why a mode does not change stands below the table", "vision", async (page) => {
  await modes(page);
  await page.getByLabel("Dial stands in rest").click();
  await page.getByRole("alert").filter({ hasText: "the mode would have no component" }).waitFor();
  assert.equal(await page.getByLabel("Dial stands in rest").isChecked(), true);
});

page_test("the canvas shows what is off in a mode, and a run starts in the chosen one", "vision", async (page) => {
  const off = () => page.locator(".box.is-off header strong").allTextContents();
  assert.deepEqual(await off(), []);
  await page.getByLabel("Mode shown").selectOption("look");
  await eventually(off, ["Dial"]);
  await modes(page);
  await page.getByRole("group", { name: "rest" }).getByRole("button", { name: "Show" }).click();
  await eventually(async () => (await off()).toSorted(), ["Prepare", "Vision"]);
  await page.getByLabel("Mode shown").selectOption("");
  await eventually(off, []);
  await page.getByLabel("Mode", { exact: true }).selectOption("rest");
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByText("running", { exact: true }).waitFor();
  assert.equal(await page.evaluate(() => window.mock.workbench.orders[0].mode), "rest");
});

page_test("the mode in which the application starts is written into the file", "vision", async (page) => {
  await modes(page);
  const look = page.getByRole("group", { name: "look" });
  const rest = page.getByRole("group", { name: "rest" });
  assert.equal(await look.getByRole("button", { name: "Starts in it" }).getAttribute("aria-pressed"), "true");
  await rest.getByRole("button", { name: "Start in it" }).click();
  await rest.getByRole("button", { name: "Starts in it" }).waitFor();
  await look.getByRole("button", { name: "Start in it" }).waitFor();
  await edits_are(page, ["initial_mode rest"]);
  assert.equal(await page.getByLabel("Mode", { exact: true }).inputValue(), "rest");
});

page_test("a stacked box is plotted with all its members, which the legend names", "arm", async (page) => {
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await node(page, "Joint\\{1..7\\}").locator(".port.out", { hasText: "Position" }).click();
  await page.getByRole("button", { name: "Plot", exact: true }).click();
  const legend = page.getByRole("list", { name: "Curves of Joint{1..7}.Position" });
  await eventually(() => legend.locator("li").allTextContents(), [1, 2, 3, 4, 5, 6, 7].map((i) => `Joint${i}`));
  assert.match(await page.locator(".diagram").getAttribute("aria-label"), /^Curves of Joint1\.Position, .*Joint7\.Position, the last 60 s$/);
  await node(page, "Sensor").locator(".port.out", { hasText: "sensor" }).click();
  await page.getByRole("button", { name: "Plot", exact: true }).click();
  await eventually(() => page.getByRole("list", { name: "Curves of Sensor.sensor" }).locator("li").allTextContents(), [1, 2, 3, 4, 5, 6, 7].map((i) => `[${i}]`));
  await page.getByRole("button", { name: "Plot Joint{1..7}.Position no more" }).click();
  await legend.waitFor({ state: "detached" });
});

page_test("curves beyond the most that are drawn are counted", "arm", async (page) => {
  await page.getByRole("button", { name: "Run", exact: true }).click();
  for (const port of ["Position", "Velocity", "Armed"]) {
    await node(page, "Joint\\{1..7\\}").locator(".port.out", { hasText: port }).click();
    await page.getByRole("button", { name: "Plot", exact: true }).click();
  }
  await page.getByText("3 more are not drawn: 18 are the most.").waitFor();
  await eventually(() => page.locator(".legend li").count(), 18);
});

page_test("an empty canvas invites, and nothing on the page is red", "empty", async (page) => {
  await page.getByText("Drag a model here").waitFor();
  assert.equal(await page.locator(".problem.error, .count.bad, [role=alert]").count(), 0);
  assert.match(await page.getByRole("tabpanel").textContent(), /Nothing to check yet/);
});

const axe = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

for (const dark of [false, true]) {
  for (const [view, query, act] of [
    ["calls", "vision", (page) => inspect(page, "Prepare")],
    ["an empty canvas", "empty", async () => undefined],
    ["modes", "vision", async (page) => {
      await modes(page);
      await page.getByLabel("Mode shown").selectOption("look");
    }],
    ["a plot", "arm", async (page) => {
      await page.getByRole("button", { name: "Run", exact: true }).click();
      await node(page, "Joint\\{1..7\\}").locator(".port.out", { hasText: "Position" }).click();
      await page.getByRole("button", { name: "Plot", exact: true }).click();
      await page.locator(".legend li").nth(6).waitFor();
    }],
  ]) {
    page_test(`axe finds nothing at ${view}, ${dark ? "dark" : "light"}`, query, async (page) => {
      await act(page);
      await page.evaluate(await readFile(axe, "utf8"));
      const found = await page.evaluate(() => window.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"] }));
      assert.deepEqual(found.violations.map((one) => `${one.id} (${one.impact}): ${one.nodes.slice(0, 3).map((where) => where.html.slice(0, 140)).join(" | ")}`), []);
    }, { dark });
  }
}

page_test("what a run says of a box comes before what the shown mode says", "vision", async (page) => {
  await page.getByLabel("Mode shown").selectOption("look");
  await page.locator(".box.is-off", { hasText: "Dial" }).waitFor();
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await node(page, "Dial").locator(".box.is-running", { hasText: "Running" }).waitFor();
  assert.equal(await page.locator(".box.is-off").count(), 0);
});
