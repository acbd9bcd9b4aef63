// SPDX-License-Identifier: Apache-2.0
// node --test elsewhere_test.mjs, with ARMATURE=the program: the page at the address of an application
// that another process runs. Skipped without chromium.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { arm, begin, box, finish, folder, program, serve, sit_down, skip, until, user } from "./session.mjs";

before(begin);
after(finish);

const kJanus = fileURLToPath(new URL("../../robots/janus/demo/studio.yaml", import.meta.url));
const socket = join(folder, "janus.sock");

/** The simulated head as a process of its own, once it can be reached. */
async function head() {
  const policy = join(folder, "head.policy");
  writeFileSync(policy, "allow local read,command,configure *\n");
  rmSync(socket, { force: true });
  const process = spawn(program, ["run", kJanus, "--sim", "--pace", "1", "--listen", `unix:${socket}`, "--policy", policy], { stdio: ["ignore", "ignore", "pipe"] });
  await new Promise((resolve, reject) => {
    let told = "";
    process.stderr.on("data", (data) => {
      told += data;
      if (told.includes("listens at")) resolve();
    });
    process.once("exit", () => reject(new Error(told)));
  });
  return process;
}

const ended = (process) => new Promise((resolve) => process.once("exit", resolve));

/** Numbers that stand at the boxes' ports. */
const values = (page) => page.locator(".port .value:not(:empty)").allTextContents();

test("Janus of another process is shown, watched, operated, lost and found again", { skip, timeout: 240_000 }, async () => {
  const first = await head();
  const { server, address } = await serve(`unix:${socket}`, "--listen", "ws://127.0.0.1:0");
  const page = await user(address);
  await box(page, "Generator").waitFor();
  await page.locator(".react-flow__edge.data").first().waitFor();
  assert.ok((await page.locator(".react-flow__edge").count()) >= 5, "its connections are wires");
  await page.locator(".run-state", { hasText: "running" }).waitFor();

  await page.getByText(`This application runs at unix:${socket}: open its file to change it.`).first().waitFor();
  for (const name of ["Text", "Save", "Run", "Stop", "Undo"]) {
    assert.equal(await page.getByRole("button", { name, exact: true }).count(), 0, `${name} is not offered`);
  }
  await box(page, "Controller").locator("header").click();
  await page.getByRole("heading", { name: "Controller" }).waitFor();
  assert.equal(await page.getByRole("button", { name: "Remove" }).count(), 0);
  await page.keyboard.press("Delete");
  await box(page, "Controller").waitFor();

  await page.locator(".port .value:not(:empty)").first().waitFor();
  await page.getByRole("button", { name: "Robot", exact: true }).click();
  await page.getByRole("application", { name: /janus in 3D/ }).waitFor();
  await page.getByRole("tab", { name: "Operate" }).click();
  await sit_down(page);
  await arm(page);
  const before_motion = await values(page);
  await page.getByRole("group", { name: "Left" }).getByRole("button", { name: "Press" }).click();
  await until(async () => (await values(page)).some((one, i) => one !== before_motion[i]), "values change");
  await page.getByRole("tab", { name: "Log" }).click();
  await page.locator(".log .lines div").first().waitFor();
  await page.keyboard.press("F8");
  await page.getByText("E-stop: Arming disarmed").waitFor();
  assert.equal(first.exitCode, null, "it goes on");

  await page.getByRole("tab", { name: "Operate" }).click();
  await page.getByText("Generator: jog").waitFor();
  first.kill("SIGKILL");
  await page.locator(".notices", { hasText: "is not there" }).waitFor();
  await page.locator(".run-state", { hasText: "not there" }).waitFor();
  await box(page, "Generator").waitFor();
  const second = await head();
  await page.locator(".notices", { hasText: "is not there" }).waitFor({ state: "detached" });
  await page.getByText("Generator: jog").waitFor();
  await page.locator(".run-state", { hasText: "running" }).waitFor();
  await page.locator(".port .value:not(:empty)").first().waitFor();

  server.kill("SIGTERM");
  await ended(server);
  assert.equal(second.exitCode, null, "it goes on without the studio");
  second.kill("SIGKILL");
});
