// SPDX-License-Identifier: Apache-2.0
// node shots.mjs FOLDER OUTPUT [NAME]: pictures of each view of the page in FOLDER (bundled with
// the mock), light and dark, 1280 and 800 wide, to be looked at. CAPTURED=pid,wam shows pid.json and
// wam.json in FOLDER, too.
import { mkdir } from "node:fs/promises";
import { join } from "node:path";
import { launch, open, serve } from "./browser.mjs";

const [folder, output, only] = process.argv.slice(2);

const start = async (page) => {
  await page.getByRole("button", { name: /run$/i }).first().click();
  await page.waitForTimeout(1500);
};
const tab = (page, name) => page.getByRole("tab", { name }).click();

const robot = async (page) => {
  await page.getByRole("button", { name: "Robot", exact: true }).click();
  await page.waitForTimeout(2000);
};

const kViews = {
  wave: ["wave"],
  arm: ["arm"],
  empty: ["empty"],
  wrong: ["wrong"],
  box: ["wave", async (page) => page.locator(".react-flow__node", { hasText: "Source" }).locator("header").click()],
  range: ["arm", async (page) => page.locator(".react-flow__node", { hasText: "Joint{1..7}" }).locator("header").click()],
  several: ["wave", async (page) => {
    for (const name of ["Source", "Filter"]) await page.locator(".react-flow__node", { hasText: name }).locator("header").first().click({ modifiers: ["Control"] });
  }],
  composite: ["arm", async (page) => page.locator(".react-flow__node", { hasText: "Rover" }).locator("header").click()],
  inside: ["arm", async (page) => {
    await page.locator(".react-flow__node", { hasText: "Rover" }).locator("header").dblclick();
    await page.waitForTimeout(500);
  }],
  text: ["wrong", async (page) => {
    await page.getByRole("button", { name: "Text", exact: true }).click();
    await page.waitForTimeout(800);
  }],
  run: ["arm", start],
  log: ["wave", async (page) => (await start(page), await tab(page, "Log"))],
  threads: ["arm", async (page) => (await start(page), await tab(page, "Threads"), await page.waitForTimeout(800))],
  plot: ["wave", async (page) => {
    await start(page);
    await page.locator(".port.out", { hasText: "Position" }).click();
    await page.getByRole("button", { name: "Plot", exact: true }).click();
    await page.waitForTimeout(3000);
  }],
  operate: ["arm", async (page) => {
    await start(page);
    await page.locator(".react-flow__node", { hasText: "Generator" }).locator("header").click();
    await tab(page, "Operate");
    await page.waitForTimeout(500);
  }],
  operator: ["operated", async (page) => {
    await start(page);
    await page.getByRole("button", { name: "Take the seat" }).click();
    await page.locator(".react-flow__node", { hasText: "Generator" }).locator("header").click();
    await tab(page, "Operate");
    await page.getByRole("button", { name: /^arm: hold/ }).hover();
    await page.mouse.down();
    await page.waitForTimeout(600);
  }],
  guest: ["operated", async (page) => {
    await start(page);
    await page.evaluate(() => window.mock.workbench.sit(2));
    await page.locator(".react-flow__node", { hasText: "Generator" }).locator("header").click();
    await tab(page, "Operate");
    await page.keyboard.press("F8");
  }],
  robot: ["arm", robot],
  robot_run: ["arm", async (page) => (await start(page), await robot(page))],
  cycle: ["arm", async (page) => (await start(page), await tab(page, "Cycle"), await page.waitForTimeout(1200))],
  settings: ["arm", async (page) => {
    await page.getByRole("button", { name: "Set …" }).click();
    await page.getByLabel("Name 1").fill("Joint1.MaxVelocity");
    await page.waitForTimeout(300);
  }],
  lanes: ["arm", async (page) => (await page.getByRole("button", { name: "Threads as lanes" }).click(), await page.waitForTimeout(500))],
  opened: ["arm", async (page) => {
    await page.locator("[aria-label='Power.TurnedOn to Generator.moveTo']").first().focus();
    await page.keyboard.press("Enter");
    await page.getByRole("button", { name: "Parameters as pins" }).click();
    await page.waitForTimeout(600);
  }],
  fitting: ["wave", async (page) => {
    const pin = page.locator(".react-flow__node", { hasText: "Filter" }).locator(".pin.output");
    await pin.hover();
    await page.mouse.down();
    await page.mouse.move(640, 260, { steps: 6 });
    await page.waitForTimeout(400);
  }],
  menu: ["wave", async (page) => {
    const pin = page.locator(".react-flow__node", { hasText: "Filter" }).locator(".pin.output");
    await pin.hover();
    await page.mouse.down();
    await page.mouse.move(640, 200, { steps: 6 });
    await page.waitForTimeout(300);
    await page.mouse.up();
    await page.waitForTimeout(300);
  }],
  question: ["arm", async (page) => {
    await page.locator(".react-flow__node", { hasText: "Sensor · " }).locator("header").click();
    await page.getByLabel("joints", { exact: true }).fill("6");
    await page.keyboard.press("Enter");
    await page.waitForTimeout(300);
  }],
  refused: ["wave", async (page) => {
    await page.locator(".react-flow__node", { hasText: "Source" }).locator("header").click();
    await page.getByLabel("Frequency", { exact: true }).fill("fast");
    await page.keyboard.press("Enter");
    await page.waitForTimeout(300);
  }],
  lost: ["wave", async (page) => page.evaluate(() => window.mock.connection(false, "the studio was closed"))],
  many: ["many=1000"],
  ...Object.fromEntries((process.env.CAPTURED ?? "").split(",").filter(Boolean).map((name) => [name, [`captured=${name}`]])),
};

const { address, close } = await serve(folder);
const browser = await launch();
await mkdir(output, { recursive: true });
let failed = 0;
for (const [name, [query, act]] of Object.entries(kViews)) {
  if (only && !only.split(",").includes(name)) continue;
  for (const dark of [false, true]) {
    for (const width of [1280, 800]) {
      const opened = await open(browser, `${address}?${query}`, { width, dark });
      try {
        await act?.(opened.page);
      } catch (error) {
        console.log(`${name}: ${error.message.split("\n")[0]}`);
        ++failed;
      }
      await opened.page.waitForTimeout(250);
      await opened.page.screenshot({ path: join(output, `${name}-${dark ? "dark" : "light"}-${width}.png`) });
      for (const error of opened.errors) console.log(`${name} ${width}: ${error}`);
      await opened.close();
    }
  }
}
await browser.close();
close();
process.exitCode = failed > 0 ? 1 : 0;
