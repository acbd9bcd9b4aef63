// SPDX-License-Identifier: Apache-2.0
// A robot, a studio and clients of Foxglove's own library. ARMATURE=the program.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const from_web = createRequire(new URL("../../web/package.json", import.meta.url));
const { FoxgloveClient } = from_web("@foxglove/ws-protocol");
const { WebSocket } = from_web("ws"); // Debian's Node.js has none of its own
const program = process.env.ARMATURE;
export const folder = mkdtempSync(join(tmpdir(), "foxglove_test_"));
const children = [];

export const file_of = (name) => fileURLToPath(new URL(`../../${name}`, import.meta.url));

export function finish() {
  for (const child of children) child.kill("SIGKILL");
  rmSync(folder, { recursive: true, force: true });
}

/** A process of the program, once it has said what `wanted` finds. @return what was found */
export async function begin(words, wanted) {
  const environment = { ...process.env, XDG_STATE_HOME: folder };
  const child = spawn(program, words, { env: environment, stdio: ["ignore", "ignore", "pipe"] });
  children.push(child);
  let told = "";
  const found = await new Promise((resolve, reject) => {
    child.stderr.on("data", (data) => {
      told += data;
      const match = wanted.exec(told);
      if (match) resolve(match);
    });
    child.once("exit", () => reject(new Error(told)));
  });
  return { child, found, end: () => new Promise((ended) => child.once("exit", ended) && child.kill("SIGINT")) };
}

/** A simulated robot of its own process, at a socket. */
export async function robot(deployment, name, policy = "allow local read,command,configure *\n") {
  const socket = join(folder, `${name}.sock`);
  const policy_file = join(folder, `${name}.policy`);
  writeFileSync(policy_file, policy);
  rmSync(socket, { force: true });
  const started = await begin(["run", deployment, "--sim", "--pace", "1", "--listen", `unix:${socket}`, "--policy", policy_file], /listens at/);
  return { ...started, address: `unix:${socket}` };
}

/** The studio at an application's address. @return where Foxglove finds it */
export async function studio(address, ...words) {
  const started = await begin(["studio", address, "--listen", "ws://127.0.0.1:0", "--no-open", ...words], /Foxglove finds it at (\S+)/);
  return { ...started, foxglove: started.found[1] };
}

/** A client of Foxglove's library, and what it was told. */
export class Client {
  channels = new Map(); // by topic
  messages = []; // of all subscriptions: {topic, time, value}
  parameters = new Map();
  statuses = [];
  answers = []; // to requests with an id
  assets = [];
  times = [];
  closed = false;
  #topics = new Map();

  constructor(address) {
    this.library = new FoxgloveClient({ ws: new WebSocket(address, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
    const library = this.library;
    library.on("error", (error) => this.statuses.push({ level: 2, message: String(error.message ?? error) }));
    library.on("close", () => (this.closed = true));
    library.on("serverInfo", (info) => (this.info = info));
    library.on("advertise", (channels) => channels.forEach((one) => this.channels.set(one.topic, one)));
    library.on("unadvertise", (ids) => [...this.channels].forEach(([topic, one]) => ids.includes(one.id) && this.channels.delete(topic)));
    library.on("message", ({ subscriptionId, timestamp, data }) =>
      this.messages.push({ topic: this.#topics.get(subscriptionId), time: Number(timestamp) / 1e9, value: JSON.parse(new TextDecoder().decode(data)) }));
    library.on("time", ({ timestamp }) => this.times.push(Number(timestamp) / 1e9));
    library.on("status", (status) => this.statuses.push(status));
    library.on("fetchAssetResponse", (asset) => this.assets.push(asset));
    library.on("parameterValues", ({ parameters, id }) => {
      if (id !== undefined) this.answers.push({ id, parameters });
      for (const one of parameters) this.parameters.set(one.name, one.value);
    });
  }

  subscribe(topic) {
    const channel = this.channels.get(topic);
    assert.ok(channel, `no channel ${topic}`);
    const id = this.library.subscribe(channel.id);
    this.#topics.set(id, topic);
    return id;
  }

  of(topic) {
    return this.messages.filter((one) => one.topic === topic);
  }

  /** The answer to a request for parameters. */
  async ask(request) {
    const id = `request ${this.answers.length}`;
    request(id);
    await until(() => this.answers.some((one) => one.id === id), `the answer to ${id}; ${this.said()}`);
    return new Map(this.answers.find((one) => one.id === id).parameters.map((one) => [one.name, one.value]));
  }

  said() {
    return JSON.stringify(this.statuses);
  }
}

/** A client that has been told of the application. */
export async function client(address) {
  const one = new Client(address);
  await until(() => one.channels.size > 0, () => `channels; ${one.said()}`);
  return one;
}

export async function until(condition, what) {
  for (let tries = 0; !condition(); ++tries) {
    assert.ok(tries < 600, typeof what === "function" ? what() : what);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}
