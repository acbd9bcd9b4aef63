// SPDX-License-Identifier: Apache-2.0
// A host and those who ask it, with nothing but bytes between them.
import assert from "node:assert/strict";
import { once } from "node:events";
import { mkdtempSync, rmSync, statSync } from "node:fs";
import * as net from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { type Call, Code, type Dial, Host, type HostOptions, Peer, type PeerOptions, policy, RideError, Service } from "../src/service.ts";
import * as ride from "../src/service.ts";
import { connect, listen } from "../src/tcp.ts";
import { decodeControl, encode, encodeControl, Kind, type Message, Stream } from "../src/wire.ts";

const Lit = ride.event<{ level: number }>("Lit", ride.numberOf("event Lit{int}"), { level: ride.int });
const level = ride.within(ride.int, 0, 10);
const set = ride.numberOf("void set(int)");
const get = ride.numberOf("int get()");

/** As rcidl writes it of `interface Lamp { void set([range(0, 10)] int level); [access("read")] int get(); event Lit; }`. */
abstract class LampService extends Service {
  constructor() {
    super("Lamp", 7, [Lit]);
    Service.define(this, "set", set, "command", ride.nothing, (from) => this.set(from.take("level", level), from.call()));
    Service.define(this, "get", get, "read", ride.int, (from) => this.get(from.call()));
  }
  abstract set(level: number, call: Call): void | Promise<void>;
  abstract get(call: Call): number | Promise<number>;
  raise_Lit(event: { level: number }): number {
    return Service.raise(this, Lit, event, 3);
  }
}

class Lamp extends LampService {
  level = 0;
  calls: Call[] = [];
  open: (() => void)[] = [];
  override set(to: number, call: Call): void | Promise<void> {
    this.calls.push(call);
    if (to === 9) throw new Error("the bulb is broken");
    if (to === 8) call.demand("Mains", "configure");
    if (to === 7) return new Promise((resolve) => this.open.push(resolve));
    this.level = to;
    this.raise_Lit({ level: to });
  }
  override get(): number {
    return this.level;
  }
}

class LampPlaceholder extends ride.Placeholder {
  constructor(peer: Peer) {
    super(peer, "Lamp", "Lamp", 7);
  }
  set(to: number, type: ride.Type<number> = level) {
    return this.command("set", set, [ride.parameter("level", type, to)]);
  }
  get(options?: ride.CallOptions) {
    return this.request("get", get, [], ride.int, options);
  }
  missing() {
    return this.request("missing", 1, [], ride.int);
  }
  on_Lit(handler: ride.Handler<{ level: number }>) {
    return this.subscribe(Lit, handler);
  }
}

/** Bytes of one side are the other's a moment later. */
function pair(host: Host, transport = "tcp"): Dial {
  return (near) => {
    let ended = false;
    let far: ride.TransportEvents | undefined;
    const later = (run: () => void) => queueMicrotask(() => ended || run());
    const end = (events: ride.TransportEvents | undefined) => {
      if (ended) return;
      ended = true;
      queueMicrotask(() => events?.end("the other side ended the connection"));
    };
    const way = (events: () => ride.TransportEvents | undefined) => ({
      send: (bytes: Uint8Array) => queueMicrotask(() => events()?.bytes(bytes.slice())),
      unsent: () => 0,
      close: () => end(events()),
    });
    const taken = host.accept((events) => {
      far = events;
      later(() => events.open());
      return way(() => near);
    }, transport);
    later(() => (taken ? near.open() : near.end("there is no place")));
    return way(() => far);
  };
}

async function both(options: HostOptions = {}, of: PeerOptions = {}) {
  const log: string[] = [];
  const host = new Host({ log: (line) => log.push(line), ...options });
  const lamp = new Lamp();
  host.add("Lamp", lamp);
  const peer = await new Peer("test", pair(host), { log: (line) => log.push(line), ...of }).connected();
  return { host, lamp, peer, log, there: new LampPlaceholder(peer) };
}

test("Operations are answered, commands end with their promise, events come", async () => {
  const { host, lamp, peer, there } = await both();
  assert.deepEqual(await peer.list(), [{ identifier: 1, name: "Lamp", interface: "Lamp", digest: 7 }]);
  const seen: number[] = [];
  const subscription = there.on_Lit((event) => void seen.push(event.level));
  await there.get();
  await there.set(3);
  assert.equal(await there.get(), 3);
  assert.deepEqual(seen, [3]);
  let ended = false;
  const long = there.set(7).then(() => (ended = true));
  assert.equal(await there.get(), 3, "others go on meanwhile");
  assert.equal(ended, false);
  lamp.open[0]!();
  await long;
  subscription.end();
  await there.get();
  await there.set(4);
  assert.deepEqual(seen, [3]);
  host.close();
  peer.close();
});

test("What fails says why, and what is malformed which parameter", async () => {
  const { peer, there, log } = await both();
  await assert.rejects(there.set(9), { code: Code.failed, message: "'Lamp' at test, set: the bulb is broken" });
  await assert.rejects(there.set(11, ride.int), { code: Code.malformed, message: /parameter level is 11, expected 0 to 10/ });
  await assert.rejects(there.set(1, ride.byte as ride.Type<number>), { code: Code.malformed, message: /parameter level ends at byte/ });
  await assert.rejects(there.set(1, ride.double), { code: Code.malformed });
  await assert.rejects(there.missing(), { code: Code.noSuchOperation, message: /'Lamp' has no operation 0x1/ });
  assert.deepEqual(log, []);
  peer.close();
});

test("Who may not is refused, for what it asks and for what that acts on", async () => {
  const { peer, there, log } = await both({ allows: policy("allow local read,command Lamp # all that it needs") });
  await there.set(1);
  await assert.rejects(there.set(8), { code: Code.notAllowed, message: /local may not configure 'Mains'/ });
  peer.close();
  const other = await both({ allows: policy("allow local read *") });
  await assert.rejects(other.there.set(1), { code: Code.notAllowed, message: /local may not command 'Lamp'/ });
  assert.equal(await other.there.get(), 0);
  assert.equal(other.lamp.calls.length, 0);
  assert.ok(log.concat(other.log).every((line) => /local may not/.test(line)));
  other.peer.close();
  const blind = await both({ allows: () => false });
  blind.there.on_Lit(() => assert.fail("heard"));
  await assert.rejects(blind.there.get(), { code: Code.notAllowed });
  assert.equal(blind.lamp.raise_Lit({ level: 1 }), 0);
  assert.ok(blind.log.some((line) => /no events 'Lit' of 'Lamp': notAllowed/.test(line)), String(blind.log));
  blind.peer.close();
});

test("A policy's mistakes are told with their lines", () => {
  const who = { who: "anna@tls", component: "Lamp", access: "read" } as const;
  assert.equal(policy("allow *@tls read Arm,Lamp")(who), true);
  assert.equal(policy("allow *@web read *\nallow local read *\n")(who), false);
  assert.throws(() => policy("\nallow local look *"), { message: "line 2 of the policy: expected read, command or configure, found 'look'" });
  assert.throws(() => policy("deny local read *"), /line 1 of the policy: expected 'allow WHO ACCESS COMPONENTS'/);
  assert.throws(() => policy("allow anna read *"), /expected NAME@tls/);
  assert.throws(() => policy("allow local read Arm,"), /a component's name at the comma/);
});

test("Limits of a connection hold, and others are served", async () => {
  const { host, peer, there, lamp } = await both({ owed: 2, connections: 2, subscriptions: 1 });
  const open = [there.set(7), there.set(7)];
  await assert.rejects(there.get(), { code: Code.busy });
  const second = await new Peer("second", pair(host), { mostPause: 1 }).connected();
  assert.equal(await new LampPlaceholder(second).get(), 0);
  await assert.rejects(new Peer("third", pair(host)).connected(), { code: Code.notConnected });
  for (const each of lamp.open) each();
  await Promise.all(open);
  second.close();
  peer.close();
});

test("However many commands come at once, what ends at once is executed", () => {
  const lamp = new Lamp();
  const host = new Host();
  host.add("Lamp", lamp);
  let events: ride.TransportEvents | undefined;
  host.accept((given) => {
    events = given;
    return { send: () => assert.fail("nothing is at fault"), unsent: () => 0, close() {} };
  }, "tcp");
  events!.open();
  const command = new ride.Writer();
  command.count(set);
  command.count(3);
  const one = encode(Kind.command, 0, 1, command.body());
  const many = new Uint8Array(3000 * one.length);
  for (let i = 0; i < 3000; ++i) many.set(one, i * one.length);
  events!.bytes(many);
  assert.equal(lamp.calls.length, 3000);
  events!.end("it is over");
});

test("Whose connection has ended is told so, and hears nothing any more", async () => {
  const { peer, there, lamp } = await both();
  there.on_Lit(() => {});
  const lost = there.set(7).catch((error: RideError) => error.code);
  await there.get();
  const call = lamp.calls[0]!;
  assert.equal(call.who, "local");
  assert.equal(call.signal.aborted, false);
  peer.close();
  assert.equal(await lost, Code.lost);
  await Promise.resolve();
  assert.equal(call.signal.aborted, true);
  assert.equal(lamp.raise_Lit({ level: 1 }), 0);
});

test("A component that was removed is not found, and a name is given once", async () => {
  const { host, peer, there, lamp } = await both();
  assert.throws(() => host.add("Lamp", new Lamp()), { message: "a component 'Lamp' is there already" });
  assert.equal(await there.get(), 0);
  host.remove(lamp);
  await assert.rejects(there.get(), { code: Code.noSuchComponent });
  assert.deepEqual(await peer.list(), []);
  peer.close();
});

test("A body that is too large is refused to who has sent it", async () => {
  const host = new Host({ bodyBytes: 1000, log: () => {} });
  class Long extends Service {
    constructor() {
      super("Long", 1, []);
      Service.define(this, "take", 5, "command", ride.int, (from) => (from.take("text", ride.string), from.call(), 1));
    }
  }
  class LongPlaceholder extends ride.Placeholder {
    take(text: string) {
      return this.request("take", 5, [ride.parameter("text", ride.string, text)], ride.int);
    }
  }
  host.add("Long", new Long());
  const peer = await new Peer("test", pair(host)).connected();
  const there = new LongPlaceholder(peer, "Long", "Long", 1);
  await assert.rejects(there.take("x".repeat(70_000)), { code: Code.tooLarge, message: /the body is larger than 1000 bytes/ });
  assert.equal(await there.take("x"), 1);
  peer.close();
});

test("A peer serves over the connection that it has begun itself", async () => {
  const host = new Host();
  host.add("Lamp", new Lamp());
  let events: ride.TransportEvents | undefined;
  const answers: Message[] = [];
  const stream = new Stream();
  const dial: Dial = (given) => {
    events = given;
    queueMicrotask(() => given.open());
    return { send: (bytes) => stream.add(bytes, (m) => answers.push({ ...m, body: m.body.slice() })), unsent: () => 0, close() {} };
  };
  const peer = await new Peer("node", dial, { serving: host.serving("ws") }).connected();
  const request = new ride.Writer();
  request.count(get);
  request.count(77);
  events!.bytes(encode(Kind.request, 5, 1, request.body()));
  await new Promise((resolve) => setImmediate(resolve));
  const reply = answers.at(-1)!;
  assert.deepEqual([reply.kind, reply.identifier, reply.priority], [Kind.reply, 77, 5]);
  peer.close();
});

test("Node.js listens for programs of its own machine alone, greets once, and says that it ends", async () => {
  const folder = mkdtempSync(join(tmpdir(), "served_"));
  const host = new Host({ name: "lamp" });
  host.add("Lamp", new Lamp());
  assert.throws(() => listen("tcp://0.0.0.0:0", host), /other machines would reach it/);
  const file = await listen(`unix:${folder}/lamp.sock`, host);
  assert.equal(statSync(`${folder}/lamp.sock`).mode & 0o777, 0o600);
  await assert.rejects(listen(`unix:${folder}/lamp.sock`, host), /EADDRINUSE/);
  const near = await connect(file.address);
  assert.equal(await new LampPlaceholder(near).get(), 0);
  near.close();
  const listening = await listen("tcp://127.0.0.1:0", host);
  const socket = net.connect(Number(listening.address.split(":")[2]), "127.0.0.1");
  const texts: string[] = [];
  const stream = new Stream();
  socket.on("data", (chunk) => stream.add(new Uint8Array(chunk), ({ body }) => texts.push(decodeControl(body).text)));
  const hello = encodeControl(0, { code: Code.hello, type: 0, recipient: 0, operation: 0, text: "me" });
  socket.write(hello);
  socket.write(hello);
  while (texts.length === 0) await once(socket, "data");
  host.close();
  await once(socket, "close");
  assert.deepEqual(texts, ["lamp armature-web/0.1.0", "the program ends"]);
  listening.close();
  file.close();
  rmSync(folder, { recursive: true });
});
