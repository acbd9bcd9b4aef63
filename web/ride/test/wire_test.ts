// SPDX-License-Identifier: Apache-2.0
// Messages as docs/ride.md has them, and streams that are none.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Assembler } from "../src/assembler.ts";
import { Code, RideError } from "../src/error.ts";
import { decodeControl, encode, encodeControl, Kind, kMostBodyBytes, type Message, Stream } from "../src/wire.ts";
import { hex, unhex } from "./bytes.ts";

const kCommand = "52 49 44 45 07 00 00 00 01 00 1c 00 03 00 00 00 df 99 e2 66 00 00 00 3f 00 00 80 be";
const kControl =
  "52 49 44 45 00 00 00 00 05 00 26 00 09 00 00 00 02 00 00 00 02 00 00 00 03 00 00 00 78 56 34 12 02 00 00 00 6e 6f";

function messagesOf(stream: Stream, bytes: Uint8Array): Message[] {
  const all: Message[] = [];
  stream.add(bytes, (message) => all.push({ ...message, body: message.body.slice() }));
  return all;
}

function part(identifier: number, goesOn: boolean, size: number): Message {
  return { kind: Kind.reply, goesOn, priority: 0, identifier, body: new Uint8Array(size) };
}

test("Messages have their golden bytes", () => {
  const body = unhex("df 99 e2 66 00 00 00 3f 00 00 80 be");
  assert.equal(hex(encode(Kind.command, 7, 3, body)), kCommand);
  const control = { code: Code.noSuchOperation, type: 2, recipient: 3, operation: 0x12345678, text: "no" };
  assert.equal(hex(encodeControl(9, control)), kControl);
  assert.deepEqual(decodeControl(unhex(kControl).subarray(16)), control);
});

test("Messages are found however the stream is divided", () => {
  const bytes = unhex(`${kCommand} ${kControl} ${kCommand}`);
  for (let size = 1; size <= bytes.length; ++size) {
    const stream = new Stream();
    const all: Message[] = [];
    for (let at = 0; at < bytes.length; at += size) all.push(...messagesOf(stream, bytes.slice(at, at + size)));
    assert.deepEqual(all.map((each) => [each.kind, each.identifier, each.body.length]), [
      [Kind.command, 3, 12],
      [Kind.control, 9, 22],
      [Kind.command, 3, 12],
    ]);
  }
});

test("A large body goes on in messages of the same type and identifier, and comes back whole", () => {
  const body = new Uint8Array(2 * kMostBodyBytes + 5).map((_, i) => i % 251);
  const parts = messagesOf(new Stream(), encode(Kind.request, 1, 8, body));
  assert.deepEqual(parts.map((each) => [each.goesOn, each.body.length]), [
    [true, kMostBodyBytes],
    [true, kMostBodyBytes],
    [false, 5],
  ]);
  const assembler = new Assembler(1 << 20);
  const found = parts.map((each) => assembler.add(each));
  assert.deepEqual(found.slice(0, 2), [undefined, undefined]);
  assert.deepEqual((found[2] as { message: Message }).message.body, body);
});

test("Bytes without RIDE, an impossible length and priority end the stream", () => {
  for (const [bytes, code] of [
    ["00 00 00 00 00 00 00 00 01 00 10 00 00 00 00 00", Code.badMagic],
    ["52 49 44 45 00 00 00 00 01 00 0f 00 00 00 00 00", Code.malformed],
    ["52 49 44 45 00 01 00 00 01 00 10 00 00 00 00 00", Code.malformed],
  ] as const) {
    assert.throws(() => messagesOf(new Stream(), unhex(bytes)), (error: RideError) => error.code === code);
  }
});

test("Bodies that go on keep to the limit, and the next ones are taken", () => {
  const assembler = new Assembler(100);
  assert.equal(assembler.add(part(1, true, 60)), undefined);
  assert.equal(assembler.add(part(2, true, 60)), undefined); // dropped: both together are too large
  assert.equal(assembler.add(part(2, true, 60)), undefined);
  assert.ok("tooLarge" in assembler.add(part(2, false, 0))!);
  assert.equal((assembler.add(part(1, false, 40)) as { message: Message }).message.body.length, 100);
  assert.equal(assembler.add(part(3, true, 100)), undefined);
  assert.equal((assembler.add(part(3, false, 0)) as { message: Message }).message.body.length, 100);
});

test("More than sixteen bodies that go on end the connection", () => {
  const assembler = new Assembler(100);
  for (let i = 0; i < 16; ++i) assembler.add(part(i, true, 1));
  assert.throws(() => assembler.add(part(16, true, 1)), (error: RideError) => error.code === Code.tooLarge);
});

test("A million parts of a byte each take the memory of a million bytes", () => {
  const assembler = new Assembler(1 << 20);
  const one = part(1, true, 1);
  const before = process.memoryUsage().arrayBuffers + process.memoryUsage().heapUsed;
  for (let i = 0; i < 1_000_000; ++i) assembler.add(one);
  const after = process.memoryUsage().arrayBuffers + process.memoryUsage().heapUsed;
  assert.ok(after - before < 40e6, `${after - before} bytes`);
});
