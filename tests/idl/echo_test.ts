// SPDX-License-Identifier: Apache-2.0
// What rcidl --typescript writes beside what it writes in C++, and beside itself: every type of the
// language there and back.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { after, before, test } from "node:test";
import { Code, connect, type Peer, RideError } from "@armature/ride/tcp";
import * as everything from "./everything.js";

const server = spawn(process.env["ECHO_SERVER"]!, (process.env["ECHO_ARGUMENTS"] ?? "").split(" ").filter(Boolean), { stdio: ["pipe", "pipe", "inherit"] });
let peer: Peer;
let echo: everything.EchoPlaceholder;

before(async () => {
  const [address] = (await once(server.stdout, "data")) as [Buffer];
  peer = await connect(String(address).trim(), { log: (line) => assert.fail(line) });
  echo = new everything.EchoPlaceholder(peer, "echo");
});
after(() => {
  peer.close();
  server.stdin.end();
});

const inner: everything.Inner = { flag: true, value: -0.5 };
const singles: everything.Singles = {
  b: true, c: -128, o: 255, s: -32768, us: 65535, i: -2147483648, ui: 4294967295,
  l: -(2n ** 63n), ul: 2n ** 64n - 1n, f: Math.fround(0.1), d: 0.1, text: "grüße 😀\0", inner,
};
const lists: everything.Lists = {
  b: [true, false], c: [-1, 1], o: Uint8Array.of(0, 255), s: [], us: [1], i: [-5, 7], ui: [8], l: [1n, -1n],
  ul: [2n], f: [0.5, Infinity], d: [1e300, -0], text: ["", "ü", "abc"], inner: [inner, { flag: false, value: 2 }],
};
const fixed: everything.Fixed = {
  b: [true, false, true], c: [1, 2, 3], o: [1, 2, 3], s: [-1, 0, 1], us: [1, 2, 3], i: [1, 2, 3], ui: [1, 2, 3],
  l: [1n, 2n, 3n], ul: [1n, 2n, 3n], f: [1, 2, 3], d: [1, 2, 3], text: ["a", "bc"], inner: [inner, inner],
};
const ranges: everything.Ranges = {
  whole: -128, c: 5, o: 1, s: -32768, us: 0, i: 7, ui: 3, l: -1n, ul: 2n ** 63n, f: -0.1, d: 0.5,
  list: [0, 9], fixed: [9, 0], later: [{ bit: 1 }],
};

test("Every single type comes back", async () => {
  assert.equal(await echo.echo_bool(true), true);
  assert.equal(await echo.echo_char(-128), -128);
  assert.equal(await echo.echo_byte(255), 255);
  assert.equal(await echo.echo_short(-32768), -32768);
  assert.equal(await echo.echo_unsigned_short(65535), 65535);
  assert.equal(await echo.echo_int(-2147483648), -2147483648);
  assert.equal(await echo.echo_unsigned_int(4294967295), 4294967295);
  assert.equal(await echo.echo_long(-(2n ** 63n)), -(2n ** 63n));
  assert.equal(await echo.echo_unsigned_long(2n ** 64n - 1n), 2n ** 64n - 1n);
  assert.equal(await echo.echo_float(0.1), Math.fround(0.1));
  assert.ok(Number.isNaN(await echo.echo_double(NaN)));
  assert.equal(await echo.echo_string(singles.text), singles.text);
});

test("Structs, arrays and enums come back", async () => {
  assert.deepEqual(await echo.echo_singles(singles), singles);
  assert.deepEqual(await echo.echo_lists(lists), lists);
  assert.deepEqual(await echo.echo_fixed(fixed), fixed);
  assert.deepEqual((await echo.echo_ranges(ranges)).f, Math.fround(-0.1));
  assert.deepEqual(await echo.echo_flags([true, false, true]), [true, false, true]);
  assert.deepEqual(await echo.echo_two_flags([true, false]), [true, false]);
  assert.deepEqual(await echo.echo_inners([inner, inner]), [inner, inner]);
  assert.deepEqual(await echo.echo_ranged([ranges], Uint8Array.of(3)), [{ ...ranges, f: Math.fround(-0.1) }]);
  assert.equal(await echo.echo_mode("hold_position"), "hold_position");
  assert.equal(await echo.echo_frame("floor"), "floor");
  assert.deepEqual(await echo.echo_two(["least", "greatest"]), ["least", "greatest"]);
  const choices: everything.Choices = {
    mode: "position", c: "least", s: "least", us: "mode_2", i: "class", ui: "greatest", l: "after_least",
    modes: ["idle", "hold_position"], two: ["least", "class"], frame: "dock",
  };
  assert.deepEqual(await echo.echo_choices(choices), choices);
});

test("A body of many messages goes there and comes back", async () => {
  const text = "x".repeat(700_000);
  assert.equal(await echo.echo_string(text, { deadline: 20_000 }), text);
  await assert.rejects(echo.echo_string("x".repeat(1_100_000), { deadline: 20_000 }), { code: Code.tooLarge });
  assert.equal(await echo.echo_string("next"), "next");
});

test("What is out of its range is refused here, by its name, and there when it comes", async () => {
  const refused = (text: RegExp) => (error: unknown) => error instanceof RideError && error.code === Code.malformed && text.test(error.message);
  await assert.rejects(echo.echo_ranges({ ...ranges, ui: 2 }), refused(/parameter value Ranges.ui is 2, expected 3 to 4294967295/));
  await assert.rejects(echo.echo_ranges({ ...ranges, l: 0n }), refused(/Ranges.l is 0, expected -9223372036854775808 to -1/));
  await assert.rejects(echo.echo_ranged([], Uint8Array.of(4)), refused(/parameter small is 4, expected 0 to 3/));
  await assert.rejects(echo.echo_fixed({ ...fixed, d: [1, 2] }), refused(/Fixed.d has 2 elements, expected 3/));
  await assert.rejects(echo.echo_mode("asleep" as "idle"), refused(/expected one of idle, position, hold_position/));
});

test("Events come with all their members, and names with another spelling are found", async () => {
  const changed = new Promise((resolve) => void echo.on_ModeChanged(resolve));
  const all = new Promise<everything.Everything>((resolve) => void echo.on_Everything(resolve));
  await echo.change_mode("position");
  assert.deepEqual(await changed, { mode: "position", before: [] });
  await echo.nothing();
  assert.deepEqual((await all).fixed.text, ["", ""]);
  assert.equal(await echo.delete(1, 2, 3, 4, 5, 6), 123456);
  await echo.request_("part", 0.5);
});
