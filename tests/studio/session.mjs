// SPDX-License-Identifier: Apache-2.0
// A real studio, and users of its page in chromium. ARMATURE=the program.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { resolve as path_of } from "node:path";
import { launch, missing } from "../../web/studio/test/browser.mjs";

export const program = process.env.ARMATURE;
export const skip = missing;
export const folder = mkdtempSync(path_of(tmpdir(), "studio_test_"));
const environment = { ...process.env, XDG_STATE_HOME: folder };
const servers = [];
let browser;

export async function begin() {
  if (!skip) browser = await launch();
}

export async function finish() {
  await browser?.close();
  for (const server of servers) server.kill("SIGKILL"); // those that a failed test left, which would keep this process
  spawnSync("pkill", ["-KILL", "-f", folder]); // and their runs, which outlive studios
  rmSync(folder, { recursive: true, force: true });
}

/** A studio that has `name` open, in the folder of the test unless it is a path, with `text` in it unless it is new; at any free port unless one is named. */
export async function studio(name, text, port = 0) {
  const file = path_of(folder, name);
  if (text !== undefined) writeFileSync(file, text);
  const { server, address, foxglove } = await serve(file, "--listen", `ws://127.0.0.1:${port}`);
  const end = (signal) => new Promise((ended) => server.once("exit", ended) && server.kill(signal));
  return { file, address, foxglove, end, content: () => readFileSync(file, "utf8") };
}

/** A studio with these words of its command line, and the addresses that it says. */
export async function serve(...words) {
  const server = spawn(program, ["studio", ...words, "--no-open"], { env: environment, stdio: ["ignore", "ignore", "pipe"] });
  servers.push(server);
  let told = "";
  const [, address, foxglove] = await new Promise((resolve, reject) => {
    server.stderr.on("data", (data) => {
      told += data;
      const found = /open (http\S+) in[^]*Foxglove finds it at (\S+)/.exec(told);
      if (found) resolve(found);
    });
    server.once("exit", () => reject(new Error(told)));
  });
  return { server, address, foxglove };
}

/** A user of it, with a browser of their own. */
export async function user(address, settings = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...settings });
  const page = await context.newPage();
  page.setDefaultTimeout(30_000);
  await page.goto(address);
  await page.locator(".react-flow__node, .empty").first().waitFor();
  return page;
}

const escaped = (name) => name.replace(/[{}.]/g, "\\$&");

export const box = (page, name) => page.locator(".react-flow__node", { has: page.locator("header strong", { hasText: new RegExp(`^${escaped(name)}$`) }) });

export async function until(condition, what) {
  for (let tries = 0; !(await condition()); ++tries) {
    assert.ok(tries < 300, typeof what === "function" ? what() : what);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

async function middle(locator) {
  const { x, y, width, height } = await locator.boundingBox();
  return { x: x + width / 2, y: y + height / 2 };
}

/** A wire drawn by mouse; it is let go once the page knows what fits. */
export async function drag(page, from, to, before_it_is_let_go = async () => {}) {
  await from.hover();
  await page.mouse.down();
  const end = await middle(to);
  await page.mouse.move(end.x - 30, end.y, { steps: 8 });
  await page.locator(".canvas.reaching").waitFor();
  await before_it_is_let_go();
  const now = await middle(to); // the canvas may have moved
  await page.mouse.move(now.x, now.y, { steps: 4 });
  await page.mouse.up();
}

/** Adds the first model that is found by the word; by mouse or keyboard that is the same. */
export async function add(page, word, model, name = model) {
  await page.getByLabel("Find a model").fill(word);
  await page.locator(".palette li", { hasText: new RegExp(`^${model}`) }).first().waitFor(); // the libraries have been read
  await page.getByLabel("Find a model").press("Enter");
  await is_inspected(page, name);
}

/** Fields are the new box's once it is selected, a moment after it stands on the canvas. */
export async function is_inspected(page, name) {
  await box(page, name).waitFor();
  await page.locator(".inspector h2", { hasText: new RegExp(`^${escaped(name)}(×\\d+)?$`) }).waitFor();
}

export async function sit_down(page) {
  await page.getByRole("button", { name: "Take the seat" }).click();
  await page.getByText("You operate").waitFor();
}

/** Of who sits there, in Operate: holds the button until the act has passed. The first cycles measure nothing yet: who arms then tries again. */
export async function arm(page) {
  const button = page.getByRole("button", { name: /^arm: hold/ });
  const answer = page.locator(".call", { has: button }).locator("output");
  let said = "";
  await until(async () => {
    await button.hover();
    await page.mouse.down();
    await page.waitForTimeout(1500); // it is to be held for a second
    await answer.filter({ hasText: /^[^…]/ }).waitFor();
    await page.mouse.up();
    said = await answer.innerText();
    return /^done|are armed already/.test(said); // the latter if it was still under way before
  }, () => `the head is armed, it says: ${said}`);
}
