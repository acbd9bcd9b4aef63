// SPDX-License-Identifier: Apache-2.0
// docs/studio_walk.md, step by step: from an empty canvas to the head that moves. The test walks it, and
// scripts/studio_pictures, which keeps a picture where `show` is called.
import { cpSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { add, box, drag, folder, until } from "./session.mjs";

const janus = join(dirname(fileURLToPath(import.meta.url)), "../../robots/janus");

export const kTarget = [2, 0.8];  ///< of the joints [rad]

/** The head's description and its part of the deployment, as a user has them beside the new file. */
export function lay_out() {
  mkdirSync(join(folder, "demo"), { recursive: true });
  cpSync(join(janus, "janus.urdf"), join(folder, "janus.urdf"));
  for (const name of ["simulated_head.yaml", "assembled.yaml"]) cpSync(join(janus, "demo", name), join(folder, "demo", name));
}

export const kProperties = {
  BridgeRef: { joints: "2" },
  ControllerNPID: { joints: "2" },
  "PID{1..2}": { Kp: "400", Ki: "20", Kd: "200", UMin: "-12", UMax: "12" },
  nAxesGeneratorPos: { num_axes: "2", max_vel: "[2.0]", max_acc: "[5.0]", lower: "[-0.5]", upper: "[4.5]" },
};
export const kActivity = "{periodic: 10 ms, priority: 40}";
export const kParameters = { positions: "[2.0, 0.8]", time: "2 s" };

const port = (page, name, kind, member) => box(page, name).locator(`.pin.${kind}[title^="${kind} ${member}:"]`);
const nothing_selected = (page) => page.locator(".react-flow__pane").click({ position: { x: 8, y: 8 } });

export const joint = (page) => page.locator(".react-flow__node", { has: page.locator("header strong", { hasText: /^Joint/ }) });

export async function include_the_head(page) {
  await page.getByRole("button", { name: "Text", exact: true }).click();
  await page.locator(".cm-content").click();
  await page.keyboard.type("include: simulated_head.yaml\napplication: janus\n");
  await joint(page).waitFor();
}

/** Set with Enter; the field has it once the deployment has. */
export async function set(page, label, value) {
  const field = page.locator(".inspector").getByLabel(label, { exact: true });
  await field.fill(value);
  await field.press("Enter");
  await until(async () => !(await page.locator(".inspector .field.refused").count()) && (await page.locator(".top-bar .changed").count()) > 0, `${label} is taken`);
}

export async function set_properties(page, name) {
  for (const [property, value] of Object.entries(kProperties[name])) await set(page, property, value);
}

export async function add_the_control(page) {
  await add(page, "BridgeRef", "BridgeRef");
  await set_properties(page, "BridgeRef");
  await add(page, "ControllerNPID", "ControllerNPID");
  await set_properties(page, "ControllerNPID");
  await add(page, "PID{1..2}", "PID", "PID{1..2}");
  await set_properties(page, "PID{1..2}");
  await add(page, "nAxesGeneratorPos", "nAxesGeneratorPos");
  await set(page, "Activity", kActivity);
  await set_properties(page, "nAxesGeneratorPos");
  await add(page, "Button", "Button");
}


/** One wire by hand, the others by their names. @param held  done while the wire is held */
export async function connect_the_control(page, held) {
  await arrange(page);
  await drag(page, port(page, "Sensor", "output", "sensor"), port(page, "BridgeRef", "input", "sensor"), held);
  await page.getByRole("button", { name: "Undo", exact: true }).and(page.locator('[title*="connect"]')).waitFor();
  await nothing_selected(page);
  await page.getByRole("button", { name: "Connect what fits" }).click();
  await page.getByText("No problems").waitFor();
  await arrange(page);
}

/** Boxes that nobody has moved stand anew, all in sight. */
async function arrange(page) {
  await page.getByRole("button", { name: "Arrange" }).click();
  await page.getByRole("button", { name: "Fit View" }).click();
}

/** @param show  called once the parameters are typed */
export async function make_the_button_command(page, show) {
  await drag(page, port(page, "Button", "event", "Pressed"), port(page, "nAxesGeneratorPos", "command", "moveTo"));
  const form = page.getByRole("form", { name: "Parameters of the command" });
  for (const [parameter, value] of Object.entries(kParameters)) await form.getByLabel(parameter).fill(value);
  await show();
  await form.getByRole("button", { name: "Connect" }).click();
  await form.waitFor({ state: "detached" });
  await page.locator('.react-flow__edge[aria-label="Button.Pressed to nAxesGeneratorPos.moveTo"]').waitFor({ state: "attached" });
  await page.getByText("No problems").waitFor();
}

export async function save_and_run(page) {
  await page.getByRole("button", { name: "Save and run" }).click();
  await page.locator(".run-state.is-running").waitFor();
  await page.locator(".port .value:not(:empty)").first().waitFor();
}

export async function arm(page) {
  await box(page, "Arming").locator("header").click();
  await page.getByRole("tab", { name: "Operate" }).click();
  const call = page.locator(".call", { has: page.getByRole("button", { name: "arm", exact: true }) });
  const answer = call.locator("output");
  let said = "";
  await until(async () => {
    // The first cycles measure nothing yet: who arms then is told to try again.
    await call.getByRole("button", { name: "arm", exact: true }).click();
    await answer.getByText(/^[^…]/).waitFor();
    said = await answer.innerText();
    return /^(succeeded|done)|are armed already/.test(said); // the latter if it was still under way before
  }, () => `the head is armed, it says: ${said}`);
}

/** What the port of the joints has now [rad]. */
export async function positions(page) {
  const texts = await joint(page).locator(".port.out", { hasText: /^Position/ }).locator(".value").allTextContents();
  return texts.join(",").split(",").map(Number);
}

export async function is_at_the_target(page) {
  const now = await positions(page);
  return now.length === kTarget.length && now.every((each, i) => Math.abs(each - kTarget[i]) < 0.01);
}

export async function press_the_button(page) {
  await page.getByRole("tab", { name: "Operate" }).click();
  await page.getByRole("button", { name: "Press", exact: true }).click();
}

export async function plot_the_joints(page) {
  await joint(page).locator(".port.out", { hasText: /^Position/ }).click();
  await page.locator(".inspector").getByRole("button", { name: "Plot", exact: true }).click();
  await page.locator(".u-over").waitFor();
}

export async function stop(page) {
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  await page.getByText("ended", { exact: true }).waitFor();
}

/** From the empty canvas to the head that has moved. @param show  called with each picture's name while there is to be seen what it shows */
export async function walk(page, show = async () => {}) {
  await show("begin");
  await include_the_head(page);
  await show("head");
  await page.getByRole("button", { name: "Text", exact: true }).click();
  await add_the_control(page);
  await show("control");
  await connect_the_control(page, () => show("wire"));
  await show("connected");
  await make_the_button_command(page, () => show("command"));
  await save_and_run(page);
  await arm(page);
  await show("armed");
  await plot_the_joints(page);
  await press_the_button(page);
  await page.getByRole("tab", { name: "Plot" }).click();
  await until(() => is_at_the_target(page), "the head is at the target");
  await show("moved");
  await stop(page);
}
