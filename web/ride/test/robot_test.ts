// SPDX-License-Identifier: Apache-2.0
// Node.js beside a robot in C++ (examples/08_another_process) over TCP and over a socket file.
import assert from "node:assert/strict";
import { type ChildProcess, spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import * as ride from "../src/tcp.ts";

const folder = mkdtempSync(join(tmpdir(), "robot_"));
after(() => rmSync(folder, { recursive: true }));

const ObjectPosition = ride.event<{ x: number; y: number }>("ObjectPositionEvent", 0xd5a0d923, { x: ride.int, y: ride.int });

/** As rcidl writes it of ball.idl. */
class Vision extends ride.Placeholder {
  constructor(peer: ride.Peer) {
    super(peer, "Vision", "VS", 0x0b00e8e4);
  }
  initialize() {
    return this.request("initialize", ride.numberOf("int initialize()"), [], ride.int);
  }
  setThreshold(...values: number[]) {
    const parameters = values.map((value, i) => ride.parameter("abc"[i]!, ride.unsignedInt, value));
    return this.request("setThreshold", 0x22f17958, parameters, ride.int);
  }
  start() {
    return this.command("start", 0xdcab56ac, []);
  }
  missing() {
    return this.request("missing", ride.numberOf("int missing()"), [], ride.int);
  }
  on_ObjectPositionEvent(handler: ride.Handler<{ x: number; y: number }>) {
    return this.subscribe(ObjectPosition, handler);
  }
}

async function robot(address: string): Promise<{ process: ChildProcess; address: string }> {
  const made = spawn(process.env["ROBOT"]!, [address], { stdio: ["ignore", "pipe", "ignore"] });
  const [line] = (await once(made.stdout!, "data")) as [Buffer];
  return { process: made, address: String(line).trim().replace("the robot is at ", "") };
}

async function ended(child: ChildProcess): Promise<void> {
  const over = once(child, "exit");
  child.kill("SIGKILL");
  await over;
}

for (const address of ["tcp://127.0.0.1:0", `unix:${folder}/robot.sock`]) {
  test(`A robot in C++ is asked, commanded and heard at ${address.split(":")[0]}`, async () => {
    const there = await robot(address);
    const peer = await ride.connect(there.address);
    const all = await peer.list();
    assert.deepEqual(all.map(({ name }) => name), ["Vision", "Chassis"]);
    const vision = new Vision(peer);
    assert.equal(await vision.initialize(), 0);
    assert.equal(await vision.setThreshold(1, 2, 3), 0);
    await assert.rejects(vision.setThreshold(300, 2, 3), /'Vision' at .*, setThreshold: parameter red is 300, expected 0 to 255/);
    await assert.rejects(vision.missing(), { code: ride.Code.noSuchOperation });
    const seen = new Promise<{ x: number; y: number }>((resolve) => void vision.on_ObjectPositionEvent(resolve));
    await vision.start();
    assert.equal((await seen).y, 240);
    peer.close();
    await ended(there.process);
  });
}

test("A robot that is killed and started again is found again, and is not told anything twice", async () => {
  const address = `unix:${folder}/again.sock`;
  const first = await robot(address);
  const peer = await ride.connect(address);
  const vision = new Vision(peer);
  let seen = 0;
  vision.on_ObjectPositionEvent(() => void ++seen);
  await vision.start();
  await ended(first.process);
  while (peer.isConnected()) await new Promise((resolve) => setTimeout(resolve, 5));
  await assert.rejects(vision.start(), { code: ride.Code.notConnected });
  const back = new Promise<void>((resolve) => peer.on_change(({ connected }) => connected && resolve()));
  const second = await robot(address);
  await back;
  const before = seen; // the camera of the new one is off: nobody has started it
  assert.equal(await vision.initialize(), 0);
  assert.equal(seen, before);
  await vision.start();
  while (seen === before) await new Promise((resolve) => setTimeout(resolve, 5));
  peer.close();
  await ended(second.process);
});

test("An address that is none is told, and so is one where nobody listens", async () => {
  await assert.rejects(ride.connect("http://127.0.0.1:1"), /must be an address such as tcp:/);
  await assert.rejects(ride.connect(`unix:${folder}/nobody.sock`), { code: ride.Code.notConnected });
});
