// SPDX-License-Identifier: Apache-2.0
// Looks at a sweep's page in a browser, and prints what it found there as JSON:
//   node sweep_page.mjs WEB_FOLDER PAGE
// Exit code 77 if there is no browser here.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [, , web, file] = process.argv;
const chromiumPath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const require = createRequire(join(web, "package.json"));
let chromium;
try {
  ({ chromium } = require("playwright-core"));
} catch {
  process.exit(77);
}
if (!existsSync(chromiumPath)) process.exit(77);

const browser = await chromium.launch({ executablePath: chromiumPath, args: ["--no-sandbox", "--disable-gpu"] });
const context = await browser.newContext({ viewport: { width: 1180, height: 900 }, colorScheme: "light" });
const page = await context.newPage();
const errors = [], requests = [];
page.on("pageerror", (error) => errors.push(error.message));
page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
page.on("request", (request) => requests.push(request.url()));
await page.goto(pathToFileURL(file).href);
const texts = (selector) => page.locator(selector).allTextContents();
const chosen = () => page.locator("#chosen").innerText();

const found = {
  title: await page.title(),
  lead: await page.locator(".lead").textContent(),
  best: await page.locator("#best tbody tr").evaluateAll((rows) => rows.map((row) => [...row.cells].map((cell) => cell.textContent))),
  cells: await page.locator("#heat-map .cell").evaluateAll((cells) => cells.map((cell) => [Number(cell.dataset.run), cell.getAttribute("aria-label"), cell.querySelector("rect").getAttribute("fill")])),
  lines: (await texts("#parallel polyline")).length,
  axes: await texts("#parallel .axis .name"),
  reasons: await texts("#without .reason"),
};

await page.locator("#best tbody tr").first().click();
found.chosen = await chosen();
found.links = await page.locator("#chosen a").evaluateAll((links) => links.map((link) => [link.textContent, link.getAttribute("href")]));
found.marked = await page.locator("polyline.chosen").evaluateAll((lines) => lines.map((line) => Number(line.dataset.run)));

await page.locator("#without button.run").first().click();
found.chosenWithout = await chosen();
await page.locator("#chosen button").click();

await page.locator("#heat-map select").nth(2).selectOption({ index: 1 });
found.cellsOfOther = await page.locator("#heat-map .cell").evaluateAll((cells) => cells.map((cell) => cell.getAttribute("aria-label")));

// The lower three quarters of the first axis.
const grip = await page.locator("#parallel .grip").first().boundingBox();
await page.mouse.move(grip.x + grip.width / 2, grip.y + grip.height - 1);
await page.mouse.down();
await page.mouse.move(grip.x + grip.width / 2, grip.y + grip.height / 4, { steps: 4 });
await page.mouse.up();
found.kept = await page.locator("#kept").textContent();

await page.locator("#all summary").click();
await page.locator("#all tbody tr").first().waitFor();
found.all = await page.locator("#all tbody tr").count();
found.errors = errors;
found.elsewhere = requests.filter((url) => !url.startsWith("file:") && !url.startsWith("data:"));
await browser.close();
console.log(JSON.stringify(found));
