// SPDX-License-Identifier: Apache-2.0
// node --test studio_test.mjs, with ARMATURE=the program: the page in chromium at a real studio, whose
// checks and runs are real, too. Skipped without chromium.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { add, arm, begin, box, drag, finish, folder, program, sit_down, skip, studio, until, user } from "./session.mjs";

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

/** In Operate of the simulated head. */
async function operating(page) {
  await page.getByRole("tab", { name: "Operate" }).click();
  await page.getByText("Generator: jog").waitFor();
}

const kJanus = fileURLToPath(new URL("../../robots/janus/demo/studio.yaml", import.meta.url));

studio_test("Janus in 3D goes where it is sent, and its cycle is drawn", async () => {
  const { address, end } = await studio(kJanus);
  const page = await user(address);
  await page.getByRole("button", { name: "Robot", exact: true }).click();
  await page.getByRole("application", { name: /janus in 3D/ }).waitFor();
  assert.equal(await page.getByLabel("Moved by").locator("option:checked").textContent(), "found: BridgeRef.nAxesSensorPosition");
  await page.getByLabel("Pace of simulated time").selectOption("10 ×");
  await page.getByRole("button", { name: "Run", exact: true }).click();
  const positions = () => page.locator(".joints .position").evaluateAll((cells) => cells.map((cell) => Number.parseFloat(cell.textContent)));
  await until(async () => (await positions()).every(Number.isFinite), "all joints have positions");
  await operating(page);
  await sit_down(page);
  await arm(page);
  await page.getByRole("group", { name: "Left" }).getByRole("button", { name: "Press" }).click();
  await until(async () => {
    const [pan, tilt] = await positions();
    return Math.abs(pan - 2.0) < 0.05 && Math.abs(tilt - 0.8) < 0.05;
  }, "it is where the button sends it");
  await page.getByRole("tab", { name: "Cycle" }).click();
  await page.getByLabel("Thread", { exact: true }).selectOption("Sampler");
  await page.locator(".bars tbody tr", { hasText: "Controller" }).waitFor();
  await page.keyboard.press("Shift+Escape");
  await page.getByText("ended", { exact: true }).waitFor();
  await end("SIGTERM");
});

studio_test("a run has the mode and the values that were set for it, and the file stays as it is", async () => {
  const activity = "activity: {periodic: 10 ms, thread: waves}";
  const text = `application: wave\nlibraries: [wave]\ncomponents:\n  Source: {model: Source, ${activity}}\n  Other: {model: Source, ${activity}}\nmodes:\n  one: [Source]\n  two: [Other]\n`;
  const { address, end, content } = await studio("modes.yaml", text);
  const page = await user(address);
  await sit_down(page);
  await page.getByLabel("Mode", { exact: true }).selectOption("two");
  await page.getByRole("button", { name: "Set …" }).click();
  await page.getByLabel("Name 1").fill("Other.Frequency");
  await page.getByLabel("Value 1").fill("7 Hz");
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".box.is-running").first().waitFor();
  assert.match(await box(page, "Other").textContent(), /Running/);
  assert.match(await box(page, "Source").textContent(), /Stopped/);
  await page.keyboard.press("Shift+Escape");
  await page.getByText("ended", { exact: true }).waitFor();
  assert.equal(content(), text);
  await end("SIGTERM");
});

const kCommanded = `application: lift
libraries: [controls]
components:
  Go: {model: Button}
  Height: {model: Slider, activity: {periodic: 50 ms}}
  Lift: {model: Slider, activity: {periodic: 50 ms}}
connections:
  - {on: Go.Pressed, do: Lift.move, name: Travel, with: {value: 0.5}}  # half way up
`;

studio_test("the parameter of a command is given by a wire to its pin", async () => {
  const { address, end, content } = await studio("lift.yaml", kCommanded);
  const page = await user(address);
  await page.locator("[aria-label='Go.Pressed to Lift.move']").first().focus();
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Parameters as pins" }).click();
  assert.equal(await box(page, "Travel").locator(".outside").textContent(), "0.5");
  await drag(page, box(page, "Height").locator(".pin.output").first(), box(page, "Travel").locator(".pin.input").first());
  await page.locator("[aria-label='Height.Out to Travel.value']").first().waitFor({ state: "attached" });
  await page.keyboard.press("Control+s");
  await until(() => content().includes("with: {value: Height.Out}}  # half way up"), "it is in the file");
  await end("SIGTERM");
});

const position = async (page) => Number.parseFloat(await page.getByRole("group", { name: "Generator axis 1" }).locator("output").textContent());

/** Holds the button until the axis has gone so far. */
async function jog(page, least) {
  const from = await position(page);
  await page.getByRole("button", { name: "axis 1 forth" }).hover();
  await page.mouse.down();
  await until(async () => (await position(page)) > from + least, `the axis moves, and does not say ${await page.locator(".jog [role=status]").textContent()}`);
}

async function rests(page) {
  await page.waitForTimeout(800);
  const there = await position(page);
  await page.waitForTimeout(800);
  assert.equal(await position(page), there, "the axis rests");
}

studio_test("a robot is armed from the seat, jogged, stopped by somebody else, and rests when its browser is gone", async () => {
  cpSync(new URL("../../robots/janus", import.meta.url), join(folder, "janus"), { recursive: true });
  const { address, end } = await studio("janus/demo/studio.yaml");
  const one = await user(address);
  const other = await user(address);
  await one.getByRole("button", { name: "Run", exact: true }).click();
  await operating(one);
  await operating(other);
  assert.equal(await one.getByRole("button", { name: /^arm: hold/ }).isDisabled(), true, "nobody sits at the seat");
  await sit_down(one);
  await other.getByText(/^Browser \d+ operates$/).waitFor();
  await arm(one);
  await jog(one, 0.1);
  await one.mouse.up();
  await rests(one);
  await jog(one, 0.02);
  await other.keyboard.press("F8");
  await other.getByText("E-stop: Arming disarmed").waitFor();
  await one.mouse.up();
  await rests(other);
  await one.getByRole("button", { name: "axis 1 forth" }).click({ delay: 100 });
  await one.getByText(/arm first/).waitFor();
  await arm(one);
  await jog(one, 0.02);
  await one.context().close();
  await rests(other);
  await other.getByRole("button", { name: "Take the seat" }).waitFor();
  await other.keyboard.press("Shift+Escape");
  await other.getByText("ended", { exact: true }).waitFor();
  await end("SIGTERM");
});

const kCalling = `# Prepares.
application: calling
libraries: [controls]
modes:
  day: [Begin]  # all day
components:
  Begin: {model: Button, activity: triggered}
  Dial: {model: Slider, activity: {periodic: 100 ms}, properties: {High: 5}}
  Prepare: {model: Sequence, activity: {periodic: 100 ms}}
connections:
  - Begin.Pressed -> Prepare.run
`;

studio_test("calls, superiors, included files and modes are changed in the file, and nothing else", async () => {
  const { address, end, content } = await studio("calling.yaml", kCalling);
  await studio("lamp.yaml", "components:\n  Lamp: {model: Number}\n").then(({ end: close }) => close("SIGTERM"));
  const page = await user(address);
  await box(page, "Prepare").locator("header").click();
  const calls = page.getByRole("region", { name: "Calls" });
  await calls.getByLabel("New call").fill("Dial.move");
  await page.keyboard.press("Enter");
  await calls.getByLabel("Call 1", { exact: true }).waitFor();
  const value = calls.locator(".field").nth(1).locator("input");
  await value.fill("2");
  await value.press("Enter");
  await page.getByText("No problems").waitFor();
  await page.getByLabel("New superior").fill("Begin");
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Remove the superior Begin" }).waitFor();
  await page.getByRole("button", { name: "Undo", exact: true }).click();
  await page.getByRole("button", { name: "Remove the superior Begin" }).waitFor({ state: "detached" });
  await page.locator(".react-flow__pane").click({ position: { x: 300, y: 8 } });
  await page.getByLabel("File to include").fill("lamp.yaml");
  await page.keyboard.press("Enter");
  await box(page, "Lamp").waitFor();
  await page.getByRole("tab", { name: "Modes" }).click();
  await page.getByLabel("Begin stands in day").waitFor();
  await page.getByLabel("Dial stands in day").click();
  await until(() => page.getByLabel("Dial stands in day").isChecked(), "Dial runs by day");
  await page.keyboard.press("Control+s");
  await page.locator(".top-bar .saved").waitFor({ state: "attached" });
  await until(() => content().includes("include"), "it is saved");
  const expected = kCalling.replace("# Prepares.\n", "# Prepares.\ninclude: lamp.yaml\n").replace("[Begin]", "[Begin, Dial]")
    .replace("Prepare: {model: Sequence, activity: {periodic: 100 ms}}", "Prepare: {model: Sequence, activity: {periodic: 100 ms}, calls: [{call: Dial.move, with: {value: 2}}]}");
  assert.equal(content(), expected);
  await end("SIGTERM");
});

const set = async (page, label, text) => {
  await page.getByLabel(label, { exact: true }).fill(text);
  await page.keyboard.press("Enter");
};

studio_test("a number is given in its unit, a wire has what it leads to name the unit, and what is shown has it", async () => {
  const { address, end, content } = await studio("units.yaml");
  const page = await user(address);
  await add(page, "constant", "Constant");
  await set(page, "Value", "45 deg");
  await page.getByText("name its unit: Unit: deg").waitFor();
  await set(page, "Unit", "rad");
  await page.getByText("= 0.785 rad").waitFor();
  assert.equal(await page.getByLabel("Value", { exact: true }).inputValue(), "45 deg", "as the file has it");
  await set(page, "Activity", "{periodic: 10 ms}");
  await page.keyboard.press("Escape");
  await add(page, "number", "Number");
  await drag(page, box(page, "Constant").locator(".pin.output").first(), box(page, "Number").locator(".pin.input").first());
  await page.getByText("No problems").waitFor();
  await page.getByRole("button", { name: "Save and run" }).click();
  await box(page, "Constant").getByText("0.785 rad").waitFor();
  await box(page, "Constant").locator(".port.out").first().click();
  await page.getByRole("button", { name: "Plot", exact: true }).click();
  await page.locator(".legend .chips", { hasText: "Constant.Out" }).getByText("rad", { exact: true }).waitFor();
  assert.match(content(), /Number: \{model: Number, properties: \{Unit: rad\}\}/);
  await page.keyboard.press("Shift+Escape");
  await page.getByText("ended", { exact: true }).waitFor();
  await end("SIGTERM");
});

studio_test("a run that crashes is told so, and its log is a press away", async () => {
  const { file, address, end } = await studio("crashes.yaml", kWave);
  const page = await user(address);
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".port .value:not(:empty)").first().waitFor();
  assert.equal(spawnSync("pkill", ["-SEGV", "-f", `run ${file}`]).status, 0);
  await page.getByText("crashed: segmentation fault").waitFor();
  await page.getByRole("tab", { name: "Threads" }).click();
  await page.getByRole("button", { name: "See the log" }).click();
  await page.getByRole("log").waitFor();
  await end("SIGTERM");
});

studio_test("the mode in which the application starts is chosen on the page, and stands in the file", async () => {
  const { address, end, content } = await studio("starts.yaml", `${kWave}  Watcher: {model: Watcher}\nmodes:\n  day: [Source]\n  night: [Watcher]\n`);
  const page = await user(address);
  await page.getByRole("tab", { name: "Modes" }).click();
  await page.getByRole("group", { name: "night" }).getByRole("button", { name: "Start in it" }).click();
  await page.getByRole("group", { name: "night" }).getByRole("button", { name: "Starts in it" }).waitFor();
  await page.keyboard.press("Control+s");
  await until(() => content().endsWith("night: [Watcher]\nmode: night\n"), content);
  await end("SIGTERM");
});

studio_test("the arm of seven joints in 3D has its tool, and is where it is measured", async () => {
  cpSync(new URL("../../robots/wam", import.meta.url), join(folder, "wam"), { recursive: true });
  const { address, end } = await studio("wam/deployments/npid7.yaml");
  const page = await user(address);
  await page.getByRole("button", { name: "Robot", exact: true }).click();
  await page.getByRole("application", { name: /wam7 in 3D/ }).waitFor();
  await page.getByText("Arrows at tool").waitFor();
  await page.getByRole("button", { name: "Run", exact: true }).click();
  const elbow = page.getByRole("region", { name: "Joints" }).getByRole("row", { name: /joint4/ });
  await until(async () => (await elbow.textContent()).includes("3.130 rad"), "the elbow is where it is at home");
  await page.keyboard.press("Shift+Escape");
  await page.getByText(/^ended/).waitFor();
  await end("SIGTERM");
});
