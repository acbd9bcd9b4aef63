// SPDX-License-Identifier: Apache-2.0
// What tests of the page over the mock have in common: PAGE=FOLDER has it. They are skipped without a
// browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { isDeepStrictEqual } from "node:util";
import { launch, missing, open, serve } from "./browser.mjs";


let browser;
let server;

before(async () => {
  if (missing) return;
  server = await serve(process.env.PAGE);
  browser = await launch();
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** Runs a test at the page of a deployment; no error may have come by then. */
export function page_test(name, query, body, options) {
  test(name, { skip: missing, timeout: 60_000 }, async () => {
    const { page, errors, close } = await open(browser, `${server.address}?${query}`, options);
    try {
      await body(page);
      assert.deepEqual(errors, []);
    } finally {
      await close();
    }
  });
}

export const edits = (page) => page.evaluate(() => window.mock.workbench.edits.filter((one) => one.edit !== "place").map((one) => `${one.edit} ${one.words.join(" ")}`));
export const node = (page, title) => page.locator(".react-flow__node", { has: page.locator("header strong", { hasText: new RegExp(`^${title}$`) }) });
export const text_of = (page, file) => page.evaluate((path) => window.mock.workbench.text(path), file);

export async function drag(page, from, to) {
  await from.hover();
  await page.mouse.down();
  const { x, y } = "x" in to ? to : await middle(to);
  await page.mouse.move(x - 20, y, { steps: 5 });
  if (await from.evaluate((one) => one.classList.contains("pin"))) await page.locator(".canvas.reaching").waitFor();
  await page.mouse.move(x, y, { steps: 3 });
  await page.mouse.up();
}

/** What comes of what was done, once it has come. */
export async function until(condition, what) {
  for (let tries = 0; !(await condition()); ++tries) {
    assert.ok(tries < 200, what);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

export async function edits_are(page, expected) {
  await until(async () => (await edits(page)).length >= expected.length, `${expected.length} edits`);
  assert.deepEqual(await edits(page), expected);
}

/** Waits on a busy machine until `look` finds what is expected. */
export async function eventually(look, expected) {
  let found;
  for (let tries = 0; tries < 100; ++tries) {
    found = await look();
    if (isDeepStrictEqual(found, expected)) return;
    await new Promise((done) => setTimeout(done, 50));
  }
  assert.deepEqual(found, expected);
}

export async function middle(locator) {
  const { x, y, width, height } = await locator.boundingBox();
  return { x: x + width / 2, y: y + height / 2 };
}

/** What the robot's view asks for, opened. */
export async function open_robot(page) {
  await page.getByRole("button", { name: "Robot", exact: true }).click();
  await page.getByRole("region", { name: "Joints" }).waitFor();
}
