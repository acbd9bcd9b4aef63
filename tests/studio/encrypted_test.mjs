// SPDX-License-Identifier: Apache-2.0
// node --test encrypted_test.mjs, with ARMATURE=the program: the studio's page over TLS, as a browser of
// another machine has it. Skipped without chromium.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { launch, missing } from "../../web/studio/test/browser.mjs";

const program = process.env.ARMATURE;
const folder = mkdtempSync(join(tmpdir(), "encrypted_test_"));
const [certificate, key, policy, file] = ["robot.pem", "robot.key", "studio.policy", "wave.yaml"].map((name) => join(folder, name));
const command = (...more) => ["studio", file, "--listen", "wss://127.0.0.1:0", "--no-open", ...more];
const environment = { ...process.env, XDG_STATE_HOME: folder };
const left = [];

writeFileSync(file, "application: wave\nlibraries: [wave]\ncomponents:\n  Source: {model: Source, activity: {periodic: 10 ms}}\n");
writeFileSync(policy, "allow page@web read,command workbench,run\n");
execFileSync("openssl", ["req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2", "-subj", "/CN=robot",
  "-addext", "subjectAltName=DNS:localhost", "-keyout", key, "-out", certificate], { stdio: "ignore" });

after(async () => {
  for (const end of left.reverse()) await end();
  rmSync(folder, { recursive: true, force: true });
});

async function address_of(server) {
  let told = "";
  return new Promise((resolve, reject) => {
    server.stderr.on("data", (data) => {
      told += data;
      const found = /open (http\S+) in/.exec(told);
      if (found) resolve(found[1]);
    });
    server.once("exit", () => reject(new Error(told)));
  });
}

test("a browser of another machine runs and stops, and edits nothing that the policy does not allow", { skip: missing, timeout: 120_000 }, async () => {
  const server = spawn(program, command("--certificate", certificate, "--key", key, "--policy", policy), { env: environment, stdio: ["ignore", "ignore", "pipe"] });
  left.push(() => server.kill("SIGTERM"));
  const address = await address_of(server);
  assert.match(address, /^https:\/\/localhost:\d+\/#[0-9a-f]{32}$/);
  const browser = await launch();
  left.push(() => browser.close());
  const page = await (await browser.newContext({ ignoreHTTPSErrors: true })).newPage();
  await page.goto(address);
  await page.locator(".react-flow__node").first().waitFor();
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".port .value:not(:empty)").first().waitFor();
  await page.getByLabel("Find a model").fill("watcher");
  await page.locator(".palette li", { hasText: /^Watcher/ }).waitFor();
  await page.getByLabel("Find a model").press("Enter");
  await page.getByText("may not configure").first().waitFor();
  await page.keyboard.press("Shift+Escape");
  await page.getByText("ended", { exact: true }).waitFor();
});

for (const [missing, text] of [
  [["--key", key, "--policy", policy], /needs --certificate and --key/],
  [["--certificate", certificate, "--key", key], /say with --policy what their pages may do/],
]) {
  test(`without what other machines need it does not listen: ${text.source}`, () => {
    const { status, stderr } = spawnSync(program, command(...missing), { env: environment, encoding: "utf8" });
    assert.equal(status, 2);
    assert.match(stderr, text);
  });
}
