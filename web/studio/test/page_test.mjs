// SPDX-License-Identifier: Apache-2.0
// node --test page_test.mjs, with PAGE=FOLDER that has the page over the mock: a browser uses it by
// mouse and by keyboard alone. Skipped without a browser.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { drag, edits, edits_are, middle, node, open_robot, page_test, text_of, until } from "./page.mjs";

page_test("the keyboard alone adds, connects, renames, sets, removes and saves", "empty", async (page) => {
  await page.getByLabel("Find a model").focus();
  for (const model of ["source", "lowpass"]) {
    await page.getByLabel("Find a model").fill(model);
    await page.keyboard.press("Enter");
    await page.locator(".react-flow__node", { hasText: new RegExp(model, "i") }).waitFor();
  }
  const tree = page.getByRole("tree");
  await tree.getByRole("treeitem").first().focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("c");
  await page.getByLabel("Connect with").waitFor();
  await page.keyboard.press("Enter");
  await page.locator(".react-flow__edge").waitFor({ state: "attached" });
  await tree.getByRole("treeitem").first().focus();
  await page.keyboard.press("F2");
  await page.keyboard.press("Control+a");
  await page.keyboard.type("Wave");
  await page.keyboard.press("Enter");
  await node(page, "Wave").waitFor();
  await tree.getByRole("treeitem").first().focus();
  await page.keyboard.press("Enter");
  await page.getByLabel("Frequency", { exact: true }).focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.type("4");
  await page.keyboard.press("Enter");
  await until(async () => (await edits(page)).length === 6, "the frequency is set");
  await page.keyboard.press("Control+s");
  await page.locator(".saved").waitFor();
  await edits_are(page, [
    "library wave", "add Source Source", "add LowPass LowPass", "connect Source.Position LowPass.Raw", "rename Source Wave", "set Wave.Frequency 4",
  ]);
});

page_test("a wire that is dropped on a port that fits connects", "wrong", async (page) => {
  await drag(page, node(page, "Source").locator(".pin.output"), node(page, "Watcher").locator(".pin.input"));
  await edits_are(page, ["connect Source.Position Watcher.Value"]);
});

page_test("a wire that is dropped on a port that does not fit says why", "wave", async (page) => {
  await drag(page, node(page, "Source").locator(".pin.output"), node(page, "Watcher").locator(".pin.input"));
  await page.locator(".banner").waitFor();
  assert.deepEqual(await edits(page), []);
  assert.match(await page.locator(".banner").textContent(), /it is written by 'Filter.Filtered' already/);
});

page_test("a wire that is dropped on nothing offers models, and the chosen one is connected", "wave", async (page) => {
  await drag(page, node(page, "Source").locator(".pin.output"), { x: 600, y: 500 });
  await page.getByRole("option", { name: "new LowPass: Raw" }).click();
  await edits_are(page, ["add LowPass LowPass", "connect Source.Position LowPass.Raw"]);
});

page_test("a moved box is placed on the grid, once", "wave", async (page) => {
  const header = node(page, "Filter").locator("header");
  const { x, y } = await middle(header);
  await drag(page, header, { x: x + 50, y: y + 70 });
  await page.waitForFunction(() => window.mock.workbench.edits.length > 0);
  const placed = await page.evaluate(() => window.mock.workbench.edits);
  assert.equal(placed.length, 1);
  const [box, ...place] = placed[0].words;
  assert.equal(box, "Filter");
  assert.ok(place.every((one) => Number(one) % 8 === 0));
});

page_test("Delete removes what is selected, and Undo brings it back", "wave", async (page) => {
  await node(page, "Watcher").locator("header").click();
  await page.keyboard.press("Delete");
  await node(page, "Watcher").waitFor({ state: "detached" });
  assert.match(await page.getByRole("button", { name: "Undo" }).getAttribute("title"), /remove Watcher/);
  await page.keyboard.press("Control+z");
  await node(page, "Watcher").waitFor();
});

page_test("Ctrl+G groups the selected boxes, and the new box stands in their middle", "wave", async (page) => {
  const [first, second] = [await middle(node(page, "Source")), await middle(node(page, "Filter"))];
  await node(page, "Source").locator("header").click();
  await node(page, "Filter").locator("header").click({ modifiers: ["Control"] });
  assert.equal(await page.getByRole("button", { name: "Group", exact: true }).count(), 1);
  await page.keyboard.press("Control+g");
  await page.waitForTimeout(300);
  assert.deepEqual(await edits(page), ["group Group Source Filter"]);
  const placed = await page.evaluate(() => window.mock.workbench.edits.filter((one) => one.edit === "place").map((one) => one.words));
  assert.equal(placed.length, 1);
  assert.equal(placed[0][0], "Group");
  const [{ x: from }, { x: to }] = [first, second];
  assert.ok(from < to && Number(placed[0][1]) % 8 === 0);
});

page_test("a composite is dissolved by its button", "arm", async (page) => {
  await node(page, "Rover").locator("header").click();
  await page.getByRole("button", { name: "Dissolve" }).click();
  await page.waitForTimeout(300);
  assert.deepEqual(await edits(page), ["dissolve Rover"]);
});

page_test("one of a stacked box gets a box of its own", "arm", async (page) => {
  await node(page, "PID\\{1..7\\}").locator("header").click();
  const field = page.getByLabel("Split off", { exact: true });
  await field.fill("9");
  await field.press("Enter");
  await page.getByRole("button", { name: "Change control.yaml" }).click();
  await page.waitForTimeout(200);
  assert.match(await page.getByRole("alert").textContent(), /no part of \{1\.\.7\}/);
  await field.fill("7");
  await field.press("Enter");
  await page.waitForTimeout(300);
  assert.deepEqual(await edits(page), ["split PID{1..7} 9", "split PID{1..7} 7"]);
  assert.equal(await node(page, "PID7").count(), 1);
});

page_test("Delete in the outline removes once", "wave", async (page) => {
  await page.getByRole("treeitem").filter({ hasText: "Watcher" }).focus();
  await page.keyboard.press("Delete");
  await edits_are(page, ["remove Watcher"]);
});

page_test("a selected wire is disconnected by Delete", "wave", async (page) => {
  await page.locator(".react-flow__edge").first().focus();
  await page.keyboard.press("Enter");
  await page.locator(".react-flow__edge.selected").waitFor({ state: "attached" });
  await page.keyboard.press("Delete");
  await edits_are(page, ["disconnect Source.Position Filter.Raw"]);
});

page_test("what an included file says is asked for once", "arm", async (page) => {
  await node(page, "Generator").locator("header").click();
  const field = page.getByLabel("max_vel", { exact: true });
  await field.fill("[2]");
  await field.press("Enter");
  await page.getByRole("button", { name: "Change control.yaml" }).click();
  await edits_are(page, ["set Generator.max_vel [2]"]);
  await field.fill("[3]");
  await field.press("Enter");
  await edits_are(page, ["set Generator.max_vel [2]", "set Generator.max_vel [3]"]);
  assert.match(await text_of(page, "control.yaml"), /max_vel: +\[3\]/);
});

page_test("a refused value stays in its field with the reason, until it is mended", "wave", async (page) => {
  await node(page, "Source").locator("header").click();
  const field = page.getByLabel("Frequency", { exact: true });
  await field.fill("fast");
  await field.press("Enter");
  assert.match(await page.getByRole("alert").textContent(), /'fast' is no number/);
  await field.fill("3");
  await field.press("Enter");
  await page.getByRole("alert").waitFor({ state: "detached" });
});

page_test("a fix is applied by its button", "wrong", async (page) => {
  await page.getByRole("button", { name: "Write LowPass" }).click();
  await page.getByRole("button", { name: "Write Value" }).click();
  await until(async () => /Filter: \{model: LowPass\}[^]*Watcher\.Value/.test(await text_of(page, "wrong.yaml")), "both fixes are in the text");
});

page_test("typed text is written, and what others write comes in beside the cursor", "wave", async (page) => {
  await page.getByRole("button", { name: "Text", exact: true }).click();
  const editor = page.locator(".editor .cm-content");
  await editor.click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("# mine");
  await page.evaluate(() => {
    const { workbench } = window.mock;
    return workbench.text("wave.yaml").then((text) => workbench.change_elsewhere("wave.yaml", `# theirs\n${text}`));
  });
  await editor.getByText("# theirs").waitFor();
  await page.keyboard.type("!");
  await until(async () => /^# theirs\n[^]*# mine!$/.test(await text_of(page, "wave.yaml")), "both are in the text");
});

page_test("a mistake that hides everything leaves the canvas as it was, and is mended in the text", "wave", async (page) => {
  const before = await text_of(page, "wave.yaml");
  await page.evaluate((text) => window.mock.workbench.change_elsewhere("wave.yaml", text), before.replace("{model: LowPass", "{model: LowPass]"));
  await page.locator(".canvas.stale").waitFor();
  assert.equal(await page.locator(".react-flow__node").count(), 3);
  await page.evaluate((text) => window.mock.workbench.change_elsewhere("wave.yaml", text), before);
  await page.locator(".canvas:not(.stale)").waitFor();
});

page_test("a run shows values and states, and Shift+Esc stops it", "arm", async (page) => {
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".box.is-running").first().waitFor();
  await page.locator(".port .value:not(:empty)").first().waitFor();
  assert.match(await node(page, "PID\\{1..7\\}").textContent(), /Exception/);
  await page.keyboard.press("Shift+Escape");
  await page.getByText("ended", { exact: true }).waitFor();
});

page_test("controls are operated; what holds is moved again while it is held", "arm", async (page) => {
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByRole("tab", { name: "Operate" }).click();
  await page.getByRole("button", { name: "Press", exact: true }).click();
  await page.getByRole("switch", { name: "Power" }).click();
  await page.getByText("Says.Text is read").first().waitFor();
  const slider = page.getByRole("slider", { name: "Jog" });
  await slider.hover();
  const { x, y } = await middle(slider);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.waitForFunction(() => window.mock.run.called.filter((one) => one.startsWith("Jog.move(")).length >= 4);
  await page.mouse.up();
  await page.waitForTimeout(200);  // what is still under way; nothing is to come after it
  const called = await page.evaluate(() => window.mock.run.called);
  assert.ok(called.includes("Go.press()") && called.some((one) => one.startsWith("Power.turn(")));
  await page.waitForTimeout(200);
  assert.equal((await page.evaluate(() => window.mock.run.called)).length, called.length, "it is let go of");
});

page_test("a light shines while it reads true, and a number has its unit", "arm", async (page) => {
  const give = (item, value) => page.evaluate(([of, what]) => window.mock.run.numbers.set(of, what), [item, value]);
  await give("Lamp.On", 0);
  await give("Height.Value", 1.23456);
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByRole("tab", { name: "Operate" }).click();
  await page.getByRole("img", { name: "Lamp is off" }).waitFor();
  const height = page.getByRole("group", { name: "Height" });
  await height.getByText(/^1\.235\s+rad$/).waitFor();
  await give("Lamp.On", 1);
  await page.getByRole("img", { name: "Lamp is on" }).waitFor();
  await give("Height.Value", -0.5);
  await height.getByText(/^-0\.5\s+rad$/).waitFor();
});

page_test("a lost connection is told, and its recovery", "wave", async (page) => {
  await page.evaluate(() => window.mock.connection(false, "closed"));
  await page.getByText("The connection to the studio is lost").waitFor();
  await page.evaluate(() => window.mock.connection(true));
  await page.getByText("The connection to the studio is lost").waitFor({ state: "detached" });
});

page_test("a composite opens, and the breadcrumb leads back", "arm", async (page) => {
  await node(page, "Rover").locator("header").dblclick();
  await node(page, "mixer").waitFor();
  await page.getByRole("navigation", { name: "Open composite" }).getByRole("button", { name: "arm" }).click();
  await node(page, "Rover").waitFor();
});

page_test("of 1000 boxes those in sight are drawn, without ports", "many=1000", async (page) => {
  const drawn = await page.locator(".react-flow__node").count();
  assert.ok(drawn > 20 && drawn < 400, `${drawn} boxes`);
  assert.equal(await page.locator(".port").count(), 0);
});

page_test("what was typed last is saved, too", "wave", async (page) => {
  await page.getByRole("button", { name: "Text", exact: true }).click();
  await page.locator(".editor .cm-content").click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("# last words");
  await page.keyboard.press("Control+s");
  await until(async () => /# last words$/.test(await text_of(page, "wave.yaml")), "it is in the text");
  await page.locator(".saved").waitFor();
});

const axe = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

for (const dark of [false, true]) {
  for (const [view, query, act] of [
    ["the canvas", "arm", async () => undefined],
    ["an inspected box", "wave", async (page) => node(page, "Source").locator("header").click()],
    ["problems and text", "wrong", async (page) => {
      await page.getByRole("button", { name: "Text", exact: true }).click();
      await page.locator(".editor .cm-content").waitFor();
    }],
    ["a robot", "arm", async (page) => {
      await page.getByRole("button", { name: "Run", exact: true }).click();
      await open_robot(page);
    }],
    ["a cycle", "arm", async (page) => {
      await page.getByRole("button", { name: "Run", exact: true }).click();
      await page.getByRole("tab", { name: "Cycle" }).click();
      await page.locator(".bars").waitFor();
    }],
    ["what is set for a run", "arm", async (page) => {
      await page.getByRole("button", { name: "Set …" }).click();
    }],
    ["a run", "arm", async (page) => {
      await page.getByRole("button", { name: "Run", exact: true }).click();
      await page.locator(".box.is-running").first().waitFor();
      await page.getByRole("tab", { name: "Operate" }).click();
    }],
    ["an operator's page", "operated", async (page) => {
      await operated(page);
      await page.getByRole("button", { name: "Take the seat" }).click();
      await page.getByText("You operate").waitFor();
    }],
    ["a guest's page", "operated", async (page) => {
      await operated(page);
      await page.evaluate(() => window.mock.workbench.sit(2));
      await page.keyboard.press("F8");
      await page.getByText("Arming disarmed").waitFor();
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

const called = (page) => page.evaluate(() => window.mock.run.called);

async function operated(page) {
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByRole("tab", { name: "Operate" }).click();
  await page.getByText("Generator: jog").waitFor();
}

page_test("an axis jogs as long as its button is held, by mouse and by keyboard", "operated", async (page) => {
  await operated(page);
  await page.getByRole("button", { name: "axis 2 back" }).hover();
  await page.mouse.down();
  await page.waitForTimeout(400);
  await page.mouse.up();
  await page.waitForTimeout(200);
  const first = await called(page);
  assert.equal(first[0], "Generator.jog(2, -0.1)");
  assert.ok(first.filter((one) => one === "Generator.keepJogging(2, -0.1)").length >= 3, first.join());
  assert.equal(first.at(-1), "cancel");
  await page.getByRole("button", { name: "axis 1 forth" }).focus();
  await page.keyboard.down("Space");
  await page.waitForTimeout(300);
  await page.evaluate(() => document.activeElement.blur());
  await page.waitForTimeout(200);
  const both = await called(page);
  assert.equal(both.filter((one) => one.includes(".jog(")).at(-1), "Generator.jog(1, 0.1)");
  assert.equal(both.at(-1), "cancel", "it ends with the focus");
  await page.keyboard.up("Space");
});

page_test("a tool jogs along and about the axes of the base or the tool, each with its speed", "tool", async (page) => {
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByRole("tab", { name: "Operate" }).click();
  await page.getByText("Planner: jog").waitFor();
  const hold = async (name) => {
    await page.getByRole("button", { name }).hover();
    await page.mouse.down();
    await page.waitForTimeout(200);
    await page.mouse.up();
    await page.waitForTimeout(100);
  };
  await hold("along z back");
  await page.getByLabel("In the axes of the").selectOption("tool");
  await hold("about x forth");
  const all = await called(page);
  assert.deepEqual(all.filter((one) => /[.]jog\(| = /.test(one)), [
    "Planner.jog_frame = base",
    "Planner.jog(3, -0.025)",
    "Planner.jog_frame = tool",
    "Planner.jog(4, 0.1)",
  ]);
  assert.ok(all.includes("Planner.keepJogging(3, -0.025)"), all.join());
  assert.equal(all.at(-1), "cancel");
});

for (const [what, leave] of [
  ["Escape", (page) => page.keyboard.press("Escape")],
  ["the window's loss of the focus", (page) => page.evaluate(() => window.dispatchEvent(new Event("blur")))],
  ["a pointer that is cancelled", (page) => page.getByRole("button", { name: "axis 1 forth" }).dispatchEvent("pointercancel")],
]) {
  page_test(`a jog ends with ${what}`, "operated", async (page) => {
    await operated(page);
    await page.getByRole("button", { name: "axis 1 forth" }).hover();
    await page.mouse.down();
    await page.waitForTimeout(200);
    await leave(page);
    await page.waitForTimeout(100);
    const ended = await called(page);
    assert.equal(ended.at(-1), "cancel");
    await page.waitForTimeout(200);
    assert.deepEqual(await called(page), ended, "nothing is renewed any more");
  });
}

page_test("arming needs the seat and a button that is held for a second; one hold arms once", "operated", async (page) => {
  await operated(page);
  const arm = page.getByRole("button", { name: /^arm: hold/ });
  assert.equal(await arm.isDisabled(), true, "nobody sits at the seat");
  await page.getByRole("button", { name: "Take the seat" }).click();
  await page.getByText("You operate").waitFor();
  await arm.focus();
  await page.keyboard.down("Space");
  await page.waitForTimeout(500);
  await page.keyboard.up("Space");
  await page.waitForTimeout(200);
  assert.deepEqual(await called(page), [], "held too short");
  await arm.hover();
  await page.mouse.down();
  await page.waitForTimeout(2500);
  await page.mouse.up();
  assert.deepEqual(await called(page), ["Arming.arm()"]);
  await page.evaluate(() => window.mock.workbench.sit(2));
  await page.getByText("Browser 2 operates").waitFor();
  assert.equal(await arm.isDisabled(), true, "somebody else sits there");
  assert.equal(await page.getByRole("button", { name: "Take the seat" }).count(), 0);
});

page_test("a word of the operator is said from the seat, by a button that is held", "operated", async (page) => {
  await operated(page);
  await page.getByRole("button", { name: "Take the seat" }).click();
  await page.getByRole("button", { name: /^at_home: hold/ }).hover();
  await page.mouse.down();
  await page.getByText("said", { exact: true }).waitFor();
  await page.mouse.up();
  assert.deepEqual(await called(page), ["Hardware.at_home = true"]);
});

page_test("the seat is handed over", "operated", async (page) => {
  await page.getByRole("button", { name: "Take the seat" }).click();
  await page.getByLabel("Hand the seat over").selectOption({ label: "to browser 2 (page@web)" });
  await page.getByText("Browser 2 operates").waitFor();
});

page_test("E-stop is always there, by mouse and by F8, also while somebody types", "operated", async (page) => {
  const presses = () => page.evaluate(() => window.mock.workbench.emergencies);
  await page.getByRole("button", { name: /^E-stop/ }).click();
  assert.equal(await presses(), 1);
  await page.getByText("Arming disarmed").waitFor();
  await page.getByLabel("Find a model").fill("arm");
  await page.keyboard.press("F8");
  await page.waitForTimeout(100);
  assert.equal(await presses(), 2);
  assert.match(await page.getByRole("button", { name: /^E-stop/ }).textContent(), /replaces no switch/);
});
