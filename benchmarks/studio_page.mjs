// SPDX-License-Identifier: Apache-2.0
/**
 * The studio's page in a browser: how long 1000 boxes with 1332 wires take to open and a frame while they are
 * panned, and what the page weighs.
 *
 * usage: studio_page.mjs PROGRAM FILE [--seconds N]
 *
 * FILE is a deployment of 1000 components, studio.py makes it. Prints entries in the form of
 * scripts/bench --json.
 */
import { spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { launch } from "../web/studio/test/browser.mjs";

const [program, file] = process.argv.slice(2);
const at = process.argv.indexOf("--seconds");
const seconds = at < 0 ? 5 : Number(process.argv[at + 1]);
const folder = mkdtempSync(join(tmpdir(), "studio_page_"));

const entry = (name, value, unit) => ({ name, value, unit, reference: null, ratio: null, allocations: null });

/** The address that the studio says. */
function pageOf(server) {
  return new Promise((resolve, reject) => {
    let told = "";
    server.stderr.on("data", (text) => {
      told += text;
      const found = /open (http\S+) in/.exec(told);
      if (found) resolve(found[1]);
    });
    server.once("exit", () => reject(new Error(told)));
  });
}

/** Intervals between frames while the mouse drags the canvas to and fro [ms]. */
async function pan(page) {
  await page.evaluate(() => {
    window.frames_ = [];
    const note = (time) => {
      window.frames_.push(time);
      requestAnimationFrame(note);
    };
    requestAnimationFrame(note);
  });
  const pane = await page.locator(".react-flow__pane").boundingBox();
  const [x, y] = [pane.x + pane.width / 2, pane.y + 12];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const end = performance.now() + 1000 * seconds;
  for (let step = 0; performance.now() < end; ++step) {
    await page.mouse.move(x + 150 * Math.sin(step / 20), y + 40 + 40 * Math.cos(step / 20));
  }
  await page.mouse.up();
  const times = await page.evaluate(() => window.frames_);
  return times.slice(1).map((time, i) => time - times[i]);
}

const middle = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
const kilobytes = (files) => files.reduce((sum, bytes) => sum + gzipSync(bytes, { level: 9 }).length, 0) / 1000;

function weight() {
  const pages = join(dirname(program), "../share/armature/web/studio");
  return kilobytes(readdirSync(pages).filter((name) => /\.(js|css|html|svg)$/.test(name)).map((name) => readFileSync(join(pages, name))));
}

const server = spawn(program, ["studio", file, "--listen", "ws://127.0.0.1:0", "--no-open"], {
  env: { ...process.env, XDG_STATE_HOME: folder },
  stdio: ["ignore", "ignore", "pipe"],
});
const address = await pageOf(server);
const browser = await launch();
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
const loaded = [];
page.on("response", async (answer) => {
  if (answer.ok() && /\.(js|css|html|svg)$|\/$/.test(new URL(answer.url()).pathname)) loaded.push(await answer.body());
});
const begin = performance.now();
await page.goto(address);
await page.waitForSelector(".react-flow__node");
await page.waitForFunction(() => document.querySelectorAll(".react-flow__edge").length > 0);
const opened = (performance.now() - begin) / 1000;
const frames = await pan(page);
const entries = [
  entry("studio/open_1000", opened, "s"),
  entry("studio/pan_1000/p50", middle(frames), "ms"),
  entry("studio/bundle/first_page_kB", kilobytes(loaded), "kB"),
  entry("studio/bundle/all_kB", weight(), "kB"),
];
await browser.close();
server.kill();
console.log(JSON.stringify(entries, null, 1));
rmSync(folder, { recursive: true });
