// SPDX-License-Identifier: Apache-2.0
// The rover's control program assembled by keyboard alone: F6 goes from part to part of the page, Tab from field to field, `/` to a box or port.
import assert from "node:assert/strict";
import { box, is_inspected } from "./session.mjs";
import { components, connections, is_opened, kHeader, labelled } from "./pilot.mjs";

const kMostStops = 60;

const is_in = (element) => element.evaluate((one) => one.contains(document.activeElement));

/** Presses the key until the focus is in the element. */
async function until_in(page, element, key) {
  for (let stops = 0; !(await is_in(element)); ++stops) {
    assert.ok(stops < kMostStops, `${key} does not reach ${element}`);
    await page.keyboard.press(key);
  }
}

const go_to = (page, region, key = "F6") => until_in(page, page.locator(region), key);

const tab_to = (page, element) => until_in(page, element, "Tab");

async function type(page, field, value) {
  await tab_to(page, field);
  await page.keyboard.press("Control+a");
  await page.keyboard.insertText(value);
}

async function enter(page, field, value) {
  await type(page, field, value);
  await page.keyboard.press("Enter");
}

async function press(page, button) {
  await tab_to(page, button);
  await page.keyboard.press("Enter");
}

async function set(page, label, value) {
  await go_to(page, ".inspector");
  await enter(page, page.locator(".inspector").getByLabel(label, { exact: true }), value);
}

async function begin(page) {
  const text = page.getByRole("button", { name: "Text", exact: true });
  await press(page, text);
  await page.locator(".cm-content").waitFor();
  await go_to(page, ".beside");
  await tab_to(page, page.locator(".editor"));
  await page.keyboard.type(kHeader);
  await page.keyboard.press("Escape"); // Tab indents until then
  await box(page, "Chassis").waitFor();
  await go_to(page, ".top-bar");
  await press(page, text);
}

async function add_one(page, { name, model, fields }) {
  await go_to(page, ".palette", "Shift+F6");
  await type(page, page.getByLabel("Find a model"), `${name}=${model}`);
  await page.locator(".palette li", { hasText: new RegExp(`^${model}`) }).first().waitFor();
  await page.keyboard.press("Enter");
  await is_inspected(page, name);
  for (const [label, value] of fields) await set(page, label, value);
}

/** Goes to a box, or to `Box.Port`. */
async function find(page, name) {
  await go_to(page, ".outline");
  await page.keyboard.press("/");
  await page.getByLabel("Go to").waitFor();
  await page.keyboard.insertText(name);
  await page.keyboard.press("Enter");
  const shown = name.slice(name.lastIndexOf(".") + 1);
  await page.locator('.outline [role="treeitem"]:focus .name', { hasText: new RegExp(`^${shown}$`) }).waitFor();
}

async function give_calls(page, { name, calls }) {
  await find(page, name);
  await page.keyboard.press("Enter");
  for (const [i, { to, parameters }] of calls.entries()) {
    const section = page.getByRole("region", { name: "Calls" });
    await go_to(page, ".inspector");
    await enter(page, section.getByLabel("New call"), to);
    await section.getByLabel(`Call ${i + 1}`, { exact: true }).waitFor();
    for (const [label, value] of parameters) {
      await go_to(page, ".top-bar");
      await go_to(page, ".inspector", "Shift+F6");
      await enter(page, section.getByLabel(label, { exact: true }).last(), value);
    }
  }
}

export async function connect(page, { from, to, parameters, settings, name }) {
  await find(page, from);
  await page.keyboard.press("c");
  await page.getByRole("combobox", { name: "Connect with" }).waitFor();
  await page.keyboard.insertText(to);
  await page.locator(".fit-menu [role=option]").first().waitFor();
  await page.keyboard.press("Enter");
  if (parameters.length > 0) {
    const form = page.getByRole("form", { name: "Parameters of the command" });
    for (const [label, value] of parameters) await type(page, form.getByLabel(labelled(label)), value);
    await page.keyboard.press("Enter");
    await form.waitFor({ state: "detached" });
  }
  await page.locator(`.react-flow__edge[aria-label="${from} to ${to}"]`).waitFor({ state: "attached" });
  if (name) await give_name(page, { from, to, settings, name });
}

async function give_name(page, one) {
  await find(page, one.from);
  await page.keyboard.press("Enter");
  await go_to(page, ".inspector");
  await press(page, page.locator(".inspector").getByRole("button", { name: one.to, exact: true }));
  await set(page, "Settings", one.settings);
  await page.locator(".inspector .lead", { hasText: `· ${one.name}` }).waitFor();
  if (!is_opened(one)) return;
  await press(page, page.getByRole("button", { name: "Parameters as pins" }));
  await box(page, one.name).waitFor();
}

export async function assemble_by_keys(page) {
  await begin(page);
  for (const one of components) await add_one(page, one);
  for (const one of components.filter(({ calls }) => calls.length > 0)) await give_calls(page, one);
  for (const one of connections) await connect(page, one);
  await page.getByText("No problems").waitFor();
  await page.keyboard.press("Control+s");
  await page.locator(".top-bar .saved").waitFor();
}
