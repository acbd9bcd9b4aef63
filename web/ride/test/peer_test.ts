// SPDX-License-Identifier: Apache-2.0
// A peer beside a node that does what tests tell it, in simulated time.
import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";
import * as ride from "../src/ride.ts";
import { encode, Kind } from "../src/wire.ts";
import { encoded } from "./bytes.ts";
import { kDigest, NodeDouble, settle } from "./node_double.ts";
import { go_on, stop_time, tick } from "./stopped_time.ts";

const Blink = ride.event<{ count: number }>("Blink", 0xb11, { count: ride.int });

class Lamp extends ride.Placeholder {
  constructor(peer: ride.Peer, name = "Lamp", digest = kDigest) {
    super(peer, name, "Lamp", digest);
  }
  level(options?: ride.CallOptions) {
    return this.request("level", 1, [], ride.int, options);
  }
  dim(to: number, options?: ride.CallOptions) {
    return this.command("dim", 2, [ride.parameter("to", ride.within(ride.double, 0, 1), to)], options);
  }
  on_Blink(handler: ride.Handler<{ count: number }>, options?: ride.SubscribeOptions) {
    return this.subscribe(Blink, handler, options);
  }
}

function blink(count: number): Uint8Array {
  const event = new ride.Writer();
  event.count(Blink.number);
  Blink.put(event, { count });
  return event.body().slice();
}

async function pass(ms: number): Promise<void> {
  for (let at = 0; at < ms; at += 10) {
    tick(10);
    await settle();
  }
}

function fails(promise: Promise<unknown>, code: number, text: RegExp): Promise<void> {
  return assert.rejects(promise, (error: unknown) => {
    assert.ok(error instanceof ride.RideError, String(error));
    assert.equal(error.code, code, error.message);
    assert.match(error.message, text);
    return true;
  });
}

beforeEach(stop_time);
afterEach(go_on);

test("It says who it is, finds its component, asks and gets the answer", async () => {
  const node = new NodeDouble();
  const peer = await node.peer({ name: "operator" });
  assert.match(node.last.controls()[0]!.text, /^operator armature-web\//);
  const answer = new Lamp(peer).level({ priority: 9 });
  await settle();
  const [request] = node.last.requests();
  assert.equal(request!.operation, 1);
  node.last.reply(request!.call, encoded(ride.int, 42));
  assert.equal(await answer, 42);
  peer.close();
});

test("A command ends when it has ended there, and fails with the reason", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const lamp = new Lamp(peer);
  const done = lamp.dim(0.5);
  const cancelled = lamp.dim(1);
  await pass(60_000); // longer than any request may take
  const [first, second] = node.last.requests();
  node.last.reply(first!.call, new Uint8Array(0));
  node.last.control(ride.Code.failed, "cancelled: by the operator", second!.call);
  await done;
  await fails(cancelled, ride.Code.failed, /'Lamp' at test, dim: cancelled: by the operator/);
  peer.close();
});

test("What is out of its range is not sent", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  await fails(new Lamp(peer).dim(1.5), ride.Code.malformed, /dim: parameter to is 1.5, expected 0 to 1/);
  await fails(new Lamp(peer).dim(undefined as never), ride.Code.malformed, /is undefined, expected 0 to 1/);
  assert.equal(node.last.requests().length, 0);
  peer.close();
});

test("A request ends with its deadline, and its late answer is ignored", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const late = fails(new Lamp(peer).level(), ride.Code.timeout, /level: no answer within 1000 ms/);
  await pass(1100);
  await late;
  node.last.reply(node.last.requests()[0]!.call, encoded(ride.int, 1));
  assert.equal(peer.isConnected(), true);
  peer.close();
});

test("Open calls fail at once when the connection breaks, and nothing is sent again", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const lamp = new Lamp(peer);
  const open = fails(lamp.dim(1), ride.Code.lost, /the connection was lost: reset/);
  await settle();
  node.last.end("reset");
  await open;
  await fails(lamp.dim(1), ride.Code.notConnected, /is not connected/);
  await pass(30);
  node.last.open();
  await settle();
  assert.equal(node.served.length, 2);
  assert.equal(peer.isConnected(), true);
  await pass(5000);
  assert.deepEqual(node.last.requests(), []);
  peer.close();
});

test("After a loss it comes back, looks up and subscribes anew, and tells", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const told: ride.PeerChange[] = [];
  peer.on_change((change) => told.push(change));
  const counts: number[] = [];
  new Lamp(peer).on_Blink(({ count }) => counts.push(count)); // a result that is no promise
  await settle();
  node.last.event(node.last.subscriptions()[0]!, blink(1));
  node.last.end("killed");
  await pass(30);
  node.last.open();
  await settle();
  assert.equal(node.last.subscriptions().length, 1);
  node.last.event(node.last.subscriptions()[0]!, blink(2));
  assert.deepEqual(counts, [1, 2]);
  assert.deepEqual(told, [{ connected: false, text: "killed" }, { connected: true, text: "" }]);
  assert.equal(peer.losses, 1);
  peer.close();
});

test("Pauses before it comes back double up to the most", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  node.last.end("killed");
  for (let attempts = 2; attempts <= 9; ++attempts) {
    const before = Date.now();
    while (node.served.length < attempts) await pass(10);
    const pause = Math.min(20 * 2 ** (attempts - 2), 2000);
    assert.ok(Date.now() - before <= 1.25 * pause + 10, `attempt ${attempts}: ${Date.now() - before} ms`);
    assert.ok(Date.now() - before >= 0.75 * pause, `attempt ${attempts}: ${Date.now() - before} ms`);
    node.last.end("nobody");
  }
  peer.close();
});

test("The first attempt that fails is told, and is the last", async () => {
  const node = new NodeDouble();
  const connected = new ride.Peer("test", node.dial).connected();
  node.last.end("connection refused");
  await fails(connected, ride.Code.notConnected, /test: connection refused/);
  await pass(10_000);
  assert.equal(node.served.length, 1);
});

test("Several subscriptions are one on the wire, which ends with the last", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const lamp = new Lamp(peer);
  await settle();
  const counts: number[] = [];
  const all = [1, 10, 100].map((factor) => lamp.on_Blink(({ count }) => void counts.push(factor * count)));
  await settle();
  assert.equal(node.last.subscriptions().length, 1);
  node.last.event(node.last.subscriptions()[0]!, blink(2));
  all[0]!.end();
  node.last.event(node.last.subscriptions()[0]!, blink(3));
  assert.deepEqual(counts, [2, 20, 200, 30, 300]);
  const before = node.last.received.length;
  all[1]!.end();
  assert.equal(node.last.received.length, before);
  all[2]!.end();
  assert.equal(node.last.received.length, before + 1);
  node.last.event(node.last.subscriptions()[0]!, blink(4)); // was on its way
  assert.equal(counts.length, 5);
  peer.close();
});

test("Of events for a handler that takes its time the latest stay, and the others are counted", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const lamp = new Lamp(peer);
  await settle();
  const counts: number[] = [];
  let goOn: (value: unknown) => void = () => {};
  const slow = lamp.on_Blink(({ count }) => {
    counts.push(count);
    return new Promise((resolve) => (goOn = resolve));
  }, { keep: 2 });
  await settle();
  for (let i = 1; i <= 1000; ++i) node.last.event(1, blink(i));
  for (let i = 0; i < 5; ++i) {
    goOn(undefined);
    await settle();
  }
  assert.deepEqual(counts, [1, 999, 1000]);
  assert.equal(slow.dropped, 997);
  peer.close();
});

test("A handler that fails neither ends the connection nor its subscription", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const told = mock.method(console, "error", () => {});
  let calls = 0;
  const lamp = new Lamp(peer);
  await settle();
  lamp.on_Blink(() => {
    if (++calls === 1) throw new Error("oh");
    return Promise.reject(new Error("no"));
  });
  await settle();
  for (let i = 0; i < 3; ++i) {
    node.last.event(1, blink(i));
    await settle();
  }
  assert.equal(calls, 3);
  assert.equal(told.mock.callCount(), 3);
  told.mock.restore();
  peer.close();
});

test("A component that is missing, or has another interface, is told by every call", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  await fails(new Lamp(peer, "Candle").level(), ride.Code.noSuchComponent, /'Candle' .*no component has this name/);
  class Other extends ride.Placeholder {
    go() {
      return this.request("go", 1, [], ride.int);
    }
  }
  const other = new Other(peer, "Lamp", "Chassis", 1);
  await fails(other.go(), ride.Code.wrongInterface, /has the interface 'Lamp', expected 'Chassis'/);
  new Lamp(peer, "Lamp", 8);
  await settle();
  assert.match(node.log.join(), /'Lamp' has another definition of 'Lamp'/);
  peer.close();
});

test("A silent node is asked twice and lost; one that answers stays", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const first = node.last;
  const pings = () => first.controls().filter(({ code }) => code === ride.Code.ping).length;
  await pass(10_000);
  assert.equal(peer.isConnected(), true);
  const before = pings();
  assert.ok(before >= 4 && before <= 10, `${before}`);
  first.answersPing = false;
  await pass(3100);
  assert.equal(pings(), before + 2);
  assert.equal(peer.isConnected(), false);
  assert.equal(node.served[0]!.closed, true);
  peer.close();
});

test("PING is answered by PONG with its text, and a flood of it fills no memory", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  node.last.control(ride.Code.ping, "hü");
  assert.deepEqual(node.last.controls().at(-1), { ...node.last.controls().at(-1), code: ride.Code.pong, text: "hü" });
  const before = node.last.received.length;
  node.last.unsent = 2 ** 30; // it takes nothing
  for (let i = 0; i < 10_000; ++i) node.last.control(ride.Code.ping, "x".repeat(1000));
  assert.equal(node.last.received.length, before);
  await fails(new Lamp(peer).level({ deadline: 1 }), ride.Code.queueFull, /has not taken earlier messages/);
  peer.close();
});

test("Requests to a page are refused by their call, commands and unknown types, too", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  node.last.send(encode(Kind.request, 0, 5, Uint8Array.of(1, 0, 0, 0, 77, 0, 0, 0)));
  const refusal = node.last.received.at(-1)!;
  assert.equal(refusal.identifier, 77);
  assert.equal(node.last.controls().at(-1)!.code, ride.Code.noSuchComponent);
  node.last.send(encode(Kind.command, 0, 5, new Uint8Array(1)));
  assert.equal(node.last.controls().at(-1)!.code, ride.Code.noSuchComponent);
  node.last.send(encode(77, 0, 5, new Uint8Array(0)));
  assert.equal(node.last.controls().at(-1)!.code, ride.Code.malformed);
  assert.equal(peer.isConnected(), true);
  peer.close();
});

test("An answer that is too large fails its call, and the next one is taken", async () => {
  const node = new NodeDouble();
  const peer = await node.peer({ bodyBytes: 100_000 });
  const lamp = new Lamp(peer);
  const large = fails(lamp.level(), ride.Code.tooLarge, /larger than 100000 bytes/);
  const next = lamp.level();
  await settle();
  const [first, second] = node.last.requests();
  node.last.reply(first!.call, new Uint8Array(200_000));
  node.last.reply(second!.call, encoded(ride.int, 5));
  await large;
  assert.equal(await next, 5);
  peer.close();
});

test("An answer and an event that are none of their type harm nobody else", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const lamp = new Lamp(peer);
  await settle();
  const counts: number[] = [];
  const subscription = lamp.on_Blink(({ count }) => void counts.push(count));
  const answer = fails(lamp.level(), ride.Code.malformed, /the answer has 1 bytes left over/);
  await settle();
  node.last.reply(node.last.requests()[0]!.call, new Uint8Array(5));
  await answer;
  node.last.event(1, blink(1).subarray(0, 7));
  node.last.event(1, encoded(ride.long, 0n));
  node.last.event(99, blink(1));
  node.last.reply(12345, new Uint8Array(4));
  node.last.control(4711, "?");
  node.last.event(1, blink(2));
  assert.deepEqual(counts, [2]);
  assert.equal(subscription.dropped, 2);
  assert.match(node.log.join(), /an event Blink was dropped/);
  peer.close();
});

test("Bytes that are no message end the connection, which comes back", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  node.last.send(new Uint8Array(64));
  assert.equal(peer.isConnected(), false);
  assert.equal(node.served[0]!.closed, true);
  await pass(30);
  assert.equal(node.served.length, 2);
  peer.close();
});

test("A node that shuts down is told, and no more than 1024 calls are open", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const lamp = new Lamp(peer);
  await settle();
  const open = Array.from({ length: 1024 }, () => lamp.level());
  for (const each of open) each.catch(() => {});
  await settle();
  await fails(lamp.level(), ride.Code.queueFull, /1024 requests wait for answers/);
  node.last.control(ride.Code.shuttingDown);
  await fails(open[0]!, ride.Code.lost, /the other side shuts down/);
  peer.close();
});

test("Who waits for a connection that is closed here is told", async () => {
  const peer = new ride.Peer("test", new NodeDouble().dial);
  const connected = peer.connected();
  peer.close();
  await fails(connected, ride.Code.notConnected, /test: it was closed here/);
});

test("A closed peer sends nothing and does not come back", async () => {
  const node = new NodeDouble();
  const peer = await node.peer();
  const lamp = new Lamp(peer);
  await settle();
  peer.close();
  await fails(lamp.level(), ride.Code.notConnected, /is not connected/);
  await pass(10_000);
  assert.equal(node.served.length, 1);
});
