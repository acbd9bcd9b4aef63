// SPDX-License-Identifier: Apache-2.0
// The rover's control program assembled by mouse: clicks, drags, and fields that are typed.
import { add, box, drag } from "./session.mjs";
import { components, connections, is_opened, kHeader, labelled } from "./pilot.mjs";

const inspector = (page) => page.locator(".inspector");
const nothing_selected = (page) => page.locator(".react-flow__pane").click({ position: { x: 8, y: 8 } });

async function fill(field, value) {
  await field.fill(value);
  await field.press("Enter");
}

const set = (page, label, value) => fill(inspector(page).getByLabel(label, { exact: true }), value);

/** Boxes that nobody has moved stand anew, all in sight. */
export async function arrange(page) {
  await page.getByRole("button", { name: "Arrange" }).click();
  await page.getByRole("button", { name: "Fit View" }).click();
}

async function begin(page) {
  await page.getByRole("button", { name: "Text", exact: true }).click();
  await page.locator(".cm-content").click();
  await page.keyboard.type(kHeader);
  await box(page, "Chassis").waitFor();
  await page.getByRole("button", { name: "Text", exact: true }).click();
}

async function add_one(page, { name, model, fields }) {
  await add(page, `${name}=${model}`, model, name);
  for (const [label, value] of fields) await set(page, label, value);
}

async function give_calls(page, { name, calls }) {
  await box(page, name).locator("header").click();
  for (const [i, { to, parameters }] of calls.entries()) {
    const section = page.getByRole("region", { name: "Calls" });
    await fill(section.getByLabel("New call"), to);
    await section.getByLabel(`Call ${i + 1}`, { exact: true }).waitFor();
    for (const [label, value] of parameters) await fill(section.getByLabel(label, { exact: true }).last(), value);
  }
}

function pin(page, end, ...kinds) {
  const dot = end.lastIndexOf(".");
  const [owner, member] = [end.slice(0, dot), end.slice(dot + 1)];
  return box(page, owner).locator(kinds.map((kind) => `.pin[data-handleid="${kind}:${member}"]`).join(", "));
}

export async function connect(page, { from, to, parameters, settings, name }) {
  await drag(page, pin(page, from, "output", "event"), pin(page, to, "input", "command"));
  if (parameters.length > 0) {
    const form = page.getByRole("form", { name: "Parameters of the command" });
    for (const [label, value] of parameters) await form.getByLabel(labelled(label)).fill(value);
    await form.getByRole("button", { name: "Connect" }).click();
    await form.waitFor({ state: "detached" });
  }
  await page.locator(`.react-flow__edge[aria-label="${from} to ${to}"]`).waitFor({ state: "attached" });
  if (name) await give_name(page, { from, to, settings, name });
}

/** Of a wire: its port lists it. */
async function give_name(page, one) {
  const dot = one.from.lastIndexOf(".");
  await box(page, one.from.slice(0, dot)).locator(".port.out", { hasText: new RegExp(`^${one.from.slice(dot + 1)}`) }).click();
  await inspector(page).getByRole("button", { name: one.to, exact: true }).click();
  await set(page, "Settings", one.settings);
  await page.locator(".inspector .lead", { hasText: `· ${one.name}` }).waitFor();
  if (!is_opened(one)) return;
  await page.getByRole("button", { name: "Parameters as pins" }).click();
  await box(page, one.name).waitFor();
  await arrange(page);
}

/** @param show  called with each picture's name while there is to be seen what it shows */
export async function assemble_by_mouse(page, show = async () => {}) {
  await begin(page);
  await show("begin");
  for (const one of components) await add_one(page, one);
  await show("components");
  for (const one of components.filter(({ calls }) => calls.length > 0)) await give_calls(page, one);
  await show("calls");
  await nothing_selected(page);
  await arrange(page);
  for (const one of connections) await connect(page, one);
  await arrange(page);
  await nothing_selected(page);
  await page.getByText("No problems").waitFor();
  await show("wired");
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await page.locator(".top-bar .saved").waitFor();
}
