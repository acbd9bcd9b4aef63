// SPDX-License-Identifier: Apache-2.0
// node --test encrypted_test.mjs, with ARMATURE=the program: the studio's page over TLS, as a browser of
// another machine has it. Skipped without chromium.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { begin, finish, folder, program, serve, skip, user } from "./session.mjs";

before(begin);
after(finish);

const [certificate, key, policy, file] = ["robot.pem", "robot.key", "studio.policy", "wave.yaml"].map((name) => join(folder, name));
const kAddress = ["--listen", "wss://127.0.0.1:0"];

writeFileSync(file, "application: wave\nlibraries: [wave]\ncomponents:\n  Source: {model: Source, activity: {periodic: 10 ms}}\n");
writeFileSync(policy, "allow page@web read,command workbench,run\n");
execFileSync("openssl", ["req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2", "-subj", "/CN=robot",
  "-addext", "subjectAltName=DNS:localhost", "-keyout", key, "-out", certificate], { stdio: "ignore" });

test("a browser of another machine runs and stops, and edits nothing that the policy does not allow", { skip, timeout: 120_000 }, async () => {
  const { address } = await serve(file, ...kAddress, "--certificate", certificate, "--key", key, "--policy", policy);
  assert.match(address, /^https:\/\/localhost:\d+\/#[0-9a-f]{32}$/);
  const page = await user(address, { ignoreHTTPSErrors: true });
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
    const { status, stderr } = spawnSync(program, ["studio", file, ...kAddress, "--no-open", ...missing], { encoding: "utf8" });
    assert.equal(status, 2);
    assert.match(stderr, text);
  });
}
