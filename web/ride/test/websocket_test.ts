// SPDX-License-Identifier: Apache-2.0
// What a page does with its WebSocket and its token, with a browser that tests tell what happens.
import assert from "node:assert/strict";
import { afterEach, beforeEach, test } from "node:test";
import { connectPage, Code, type TransportEvents, websocket } from "../src/ride.ts";

class FakeSocket {
  static made: FakeSocket[] = [];
  binaryType = "blob";
  bufferedAmount = 0;
  closed = false;
  readonly sent: Uint8Array[] = [];
  onopen = () => {};
  onmessage = (_: { data: unknown }) => {};
  onclose = (_: { reason: string }) => {};
  readonly url: string;

  constructor(url: string) {
    this.url = url;
    FakeSocket.made.push(this);
  }
  send(bytes: Uint8Array): void {
    this.sent.push(bytes);
  }
  close(): void {
    this.closed = true;
  }
}

/** What a browser has and Node.js has not, or not so. */
const browser = globalThis as unknown as Record<string, unknown>;
const names = ["WebSocket", "location", "history", "fetch"];
const before = names.map((name) => Object.getOwnPropertyDescriptor(globalThis, name));
const set = (name: string, value: unknown) => Object.defineProperty(browser, name, { value, configurable: true, writable: true });

beforeEach(() => {
  FakeSocket.made = [];
  set("WebSocket", FakeSocket);
});
afterEach(() => {
  names.forEach((name, i) => {
    const had = before[i];
    if (had === undefined) delete browser[name];
    else Object.defineProperty(browser, name, had);
  });
});

function opened() {
  const told: string[] = [];
  const events: TransportEvents = {
    open: () => told.push("open"),
    bytes: (chunk) => told.push(`${chunk.length} bytes`),
    end: (why) => told.push(why),
  };
  const connection = websocket("ws://127.0.0.1:1/")(events);
  return { told, connection, socket: FakeSocket.made.at(-1)! };
}

test("Frames are bytes, and the end is told once", () => {
  const { told, socket } = opened();
  assert.equal(socket.binaryType, "arraybuffer");
  socket.onopen();
  socket.onmessage({ data: new ArrayBuffer(5) });
  socket.onclose({ reason: "" });
  socket.onclose({ reason: "again" });
  assert.deepEqual(told, ["open", "5 bytes", "the connection was closed or refused"]);
});

test("A text, and a frame that is larger than any node sends, end the connection", () => {
  for (const [data, why] of [
    ["RIDE", "it sent a frame that is not binary"],
    [new ArrayBuffer(1024 * 1024 + 1), "it sent a frame of 1048577 bytes"],
  ]) {
    const { told, socket } = opened();
    socket.onmessage({ data });
    socket.onmessage({ data: new ArrayBuffer(5) });
    assert.deepEqual(told, [why]);
    assert.equal(socket.closed, true);
  }
});

test("What is larger than a node takes in a frame goes in several", () => {
  const { connection, socket } = opened();
  const bytes = new Uint8Array(150_000).map((_, i) => i % 251);
  connection.send(bytes);
  assert.deepEqual(socket.sent.map(({ length }) => length), [65536, 65536, 18928]);
  assert.deepEqual(Uint8Array.from(socket.sent.flatMap((each) => [...each])), bytes);
  socket.bufferedAmount = 7;
  assert.equal(connection.unsent(), 7);
});

test("A connection that was closed here tells nothing more", () => {
  const { told, connection, socket } = opened();
  connection.close();
  socket.onmessage({ data: new ArrayBuffer(5) });
  socket.onclose({ reason: "late" });
  assert.deepEqual(told, []);
});

/** A page at this address, whose token is answered by `status`. */
function page(hash: string, status: number) {
  const requests: { url: string; method: string; headers: Record<string, string> }[] = [];
  let shown = hash;
  set("location", { hash, host: "127.0.0.1:8080", pathname: "/", search: "?a" });
  set("history", { replaceState: (_: unknown, __: string, url: string) => (shown = url) });
  set("fetch", (url: string, options: { method: string; headers: Record<string, string> }) => {
    requests.push({ url, ...options });
    return Promise.resolve({ ok: status < 300, status });
  });
  return { requests, shown: () => shown };
}

test("The token is exchanged, leaves the address, and is not sent to the socket", async () => {
  const { requests, shown } = page("#secret", 204);
  const connected = connectPage();
  await new Promise((resolve) => setImmediate(resolve));
  assert.deepEqual(requests, [{ url: "/token", method: "POST", headers: { Authorization: "Bearer secret" } }]);
  assert.equal(shown(), "/?a");
  const socket = FakeSocket.made.at(-1)!;
  assert.equal(socket.url, "ws://127.0.0.1:8080/");
  socket.onclose({ reason: "" });
  await assert.rejects(connected, { code: Code.notConnected });
});

test("A token that is not good any more is told, and no socket is opened", async () => {
  const { shown } = page("#old", 403);
  await assert.rejects(connectPage(), /this address is not good any more \(403\)/);
  assert.equal(shown(), "/?a");
  assert.equal(FakeSocket.made.length, 0);
});

test("Without a token the cookie of an earlier visit is tried", async () => {
  const { requests } = page("", 500);
  const connected = connectPage();
  await new Promise((resolve) => setImmediate(resolve));
  assert.deepEqual(requests, []);
  FakeSocket.made.at(-1)!.onclose({ reason: "" });
  await assert.rejects(connected, /closed or refused/);
});
