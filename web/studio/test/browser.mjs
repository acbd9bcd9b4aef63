// SPDX-License-Identifier: Apache-2.0
// A browser at the page over the mock, served as the studio serves it.
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join } from "node:path";

const kTypes = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".svg": "image/svg+xml" };

export async function serve(folder) {
  const server = createServer(async ({ url }, answer) => {
    const path = new URL(url, "http://localhost").pathname;
    const file = join(folder, path === "/" ? "index.html" : path);
    try {
      const bytes = await readFile(file);
      answer.writeHead(200, { "content-type": kTypes[extname(file)] ?? "text/plain", "content-security-policy": "default-src 'self'" });
      answer.end(bytes);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

const kChromium = process.env.CHROMIUM ?? "/usr/bin/chromium";

/** Why no page can be opened here; false if one can. */
export const missing = existsSync(kChromium)
  ? Number.parseInt(process.versions.node) < 20 && `playwright needs Node.js 20, found ${process.versions.node}`
  : "there is no chromium";

export async function launch() {
  const { chromium } = await import("playwright-core"); // which ends the process where it cannot run
  return chromium.launch({ executablePath: kChromium, args: ["--no-sandbox", "--disable-gpu"] });
}

/** A page whose errors are collected; it is open once the canvas has boxes, or says that it has none. */
export async function open(browser, address, { width = 1280, height = 800, dark = false } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: dark ? "dark" : "light", bypassCSP: false });
  const page = await context.newPage();
  const errors = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  await page.goto(address);
  await page.waitForSelector(".react-flow__node, .empty", { timeout: 15000 });
  await page.waitForTimeout(300);
  return { page, errors, close: () => context.close() };
}
