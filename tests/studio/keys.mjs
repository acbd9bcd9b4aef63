// SPDX-License-Identifier: Apache-2.0
// The same walk by keyboard alone: what is pressed goes to what has the focus, which Tab and the arrows move.
import assert from "node:assert/strict";
import { is_inspected, until } from "./session.mjs";
import { joint, kActivity, kParameters, kProperties } from "./walk.mjs";

const kMostStops = 400;

/** Presses Tab until the element has the focus. */
async function reach(page, element) {
  for (let stops = 0; stops < kMostStops; ++stops) {
    if (await element.evaluate((one) => one === document.activeElement)) return;
    await page.keyboard.press("Tab");
  }
  assert.fail(`Tab does not reach ${element}`);
}

async function press(page, name) {
  await reach(page, page.getByRole("button", { name, exact: true }));
  await page.keyboard.press("Enter");
}

async function type(page, field, value) {
  await reach(page, field);
  await page.keyboard.press("Control+a");
  await page.keyboard.type(value);
}

async function set(page, label, value) {
  const field = page.locator(".inspector").getByLabel(label, { exact: true });
  await type(page, field, value);
  await page.keyboard.press("Enter");
}

async function add(page, word, model, name) {
  await type(page, page.getByLabel("Find a model"), word);
  await page.locator(".palette li", { hasText: new RegExp(`^${model}`) }).first().waitFor();
  await page.keyboard.press("Enter");
  await is_inspected(page, name);
  for (const [property, value] of Object.entries(kProperties[name] ?? {})) await set(page, property, value);
}

/** Goes in the outline to a box, and to one of its ports if one is named. */
async function go(page, name, port) {
  await reach(page, page.locator('.outline [role="treeitem"][tabindex="0"]'));
  await page.keyboard.press("Home");
  const focused = (text) => page.locator('.outline [role="treeitem"]:focus .name', { hasText: new RegExp(`^${text.replace(/[{}.]/g, "\\$&")}$`) }).count();
  const down_to = async (text) => {
    for (let rows = 0; !(await focused(text)); ++rows) {
      assert.ok(rows < kMostStops, `the outline has ${text}`);
      await page.keyboard.press("ArrowDown");
    }
  };
  await down_to(name);
  if (!port) return;
  await page.keyboard.press("ArrowRight");
  await page.locator('.outline [role="treeitem"]:focus[aria-expanded="true"]').waitFor();
  await down_to(port);
}

/** `C` on a port lists what fits. */
async function connect(page, name, port, other) {
  await go(page, name, port);
  await page.keyboard.press("c");
  await page.getByRole("combobox", { name: "Connect with" }).waitFor();
  await page.keyboard.type(other);
  await page.locator(".fit-menu [role=option]", { hasText: new RegExp(`^${other}`) }).first().waitFor();
  await page.keyboard.press("Enter");
}

export async function assemble_by_keys(page) {
  await press(page, "Text");
  await page.locator(".cm-content").waitFor();
  await reach(page, page.locator(".editor"));
  await page.keyboard.type("include: simulated_head.yaml\napplication: janus\n");
  await joint(page).waitFor();
  await page.keyboard.press("Escape"); // Tab indents until then
  await press(page, "Text");
  await add(page, "BridgeRef", "BridgeRef", "BridgeRef");
  await add(page, "ControllerNPID", "ControllerNPID", "ControllerNPID");
  await add(page, "PID{1..2}", "PID", "PID{1..2}");
  await add(page, "nAxesGeneratorPos", "nAxesGeneratorPos", "nAxesGeneratorPos");
  await set(page, "Activity", kActivity);
  await add(page, "Button", "Button", "Button");
  await connect(page, "Sensor", "sensor", "BridgeRef.sensor");
  await page.getByRole("button", { name: "Undo", exact: true }).and(page.locator('[title*="connect"]')).waitFor();
  for (const name of ["Arming", "Actuator", "BridgeRef", "ControllerNPID", "PID{1..2}", "nAxesGeneratorPos"]) await connect_what_fits(page, name);
  await connect(page, "Button", "Pressed", "nAxesGeneratorPos.moveTo");
  const form = page.getByRole("form", { name: "Parameters of the command" });
  for (const [parameter, value] of Object.entries(kParameters)) await type(page, form.getByLabel(parameter), value);
  await page.keyboard.press("Enter");
  await form.waitFor({ state: "detached" });
  await page.getByText("No problems").waitFor();
  await page.keyboard.press("Control+s");
  await page.locator(".top-bar .saved").waitFor();
}

/** `C` on a box connects all of it that fits by its name. */
async function connect_what_fits(page, name) {
  await go(page, name);
  await page.keyboard.press("c");
  await until(async () => /^(Connected|Nothing)/.test(await page.locator(".notices").innerText()), `${name} is connected`);
  const dismiss = page.locator(".notices").getByRole("button", { name: "Dismiss" });
  await reach(page, dismiss);
  await page.keyboard.press("Enter");
  await dismiss.waitFor({ state: "detached" });
}
