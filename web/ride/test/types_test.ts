// SPDX-License-Identifier: Apache-2.0
// The fields of docs/ride.md, byte for byte, and what is refused.
import assert from "node:assert/strict";
import { test } from "node:test";
import * as ride from "../src/ride.ts";
import { decoded, encoded, hex, unhex } from "./bytes.ts";

const Pose = ride.struct<{ on: boolean; x: number; name: string }>("Pose", {
  on: ride.bool,
  x: ride.double,
  name: ride.string,
});
const Mode = ride.enumeration<"idle" | "follow_route", number>("Mode", ride.byte, { idle: 0, follow_route: 5 });

function golden<T>(type: ride.Type<T>, value: T, bytes: string): void {
  assert.equal(hex(encoded(type, value)), bytes);
  assert.deepEqual(decoded(type, unhex(bytes)), value);
}

function refuses(code: () => unknown, text: RegExp): void {
  assert.throws(code, (error: unknown) => {
    assert.ok(error instanceof ride.RideError, String(error));
    assert.equal(error.code, ride.Code.malformed);
    assert.match(error.message, text);
    return true;
  });
}

test("Every type of field has its golden bytes, both ways", () => {
  golden(ride.short, -2, "fe ff");
  golden(ride.long, -(2n ** 63n), "00 00 00 00 00 00 00 80");
  golden(ride.unsignedLong, 2n ** 64n - 1n, "ff ff ff ff ff ff ff ff");
  golden(ride.float, 0.5, "00 00 00 3f");
  golden(ride.double, -0.25, "00 00 00 00 00 00 d0 bf");
  golden(ride.string, "hü", "03 00 00 00 68 c3 bc");
  golden(ride.array(ride.short), [1, -1], "02 00 00 00 01 00 ff ff");
  golden(ride.array(ride.string), ["a", "bc"], "02 00 00 00 01 00 00 00 61 00 00 00 02 00 00 00 62 63");
  golden(ride.fixed(ride.byte, 3), [1, 2, 3], "01 02 03");
  golden(ride.bytes, Uint8Array.of(1, 255), "02 00 00 00 01 ff");
  golden(Mode, "follow_route", "05");
});

test("Fields are aligned relative to the body's start, 8 bytes on 4", () => {
  golden(Pose, { on: true, x: 1, name: "" }, "01 00 00 00 00 00 00 00 00 00 f0 3f 00 00 00 00");
  golden(ride.array(Pose), [], "00 00 00 00");
});

test("A value that is none of the type is refused by its name, and nothing is guessed", () => {
  refuses(() => encoded(ride.int, 1.5), /is 1.5, expected a whole number from -2147483648 to 2147483647/);
  refuses(() => encoded(ride.byte, 256), /is 256/);
  refuses(() => encoded(ride.double, undefined as unknown as number), /is undefined, expected a number/);
  refuses(() => encoded(ride.double, "1" as unknown as number), /is "1", expected a number/);
  refuses(() => encoded(ride.long, 1 as unknown as bigint), /expected a bigint/);
  refuses(() => encoded(ride.bool, 1 as unknown as boolean), /true or false/);
  refuses(() => encoded(ride.string, "\ud800"), /expected a text/);
  refuses(() => encoded(ride.fixed(ride.int, 3), [1, 2]), /has 2 elements, expected 3/);
  refuses(() => encoded(Mode, "velocity" as "idle"), /Mode is "velocity", expected one of idle, follow_route/);
  refuses(() => encoded(Pose, { on: true } as never), /Pose.x is undefined, expected a number/);
});

test("A range is checked, NaN is outside, and the bounds of a float are floats", () => {
  const level = ride.within(ride.float, 0, 0.1);
  assert.equal(encoded(level, 0.1).length, 4);
  refuses(() => encoded(level, 0.2), /is 0.2, expected 0 to 0.1/);
  refuses(() => encoded(level, NaN), /is NaN/);
  refuses(() => encoded(ride.within(ride.long, -1n, 1n), 2n), /is 2, expected -1 to 1/);
});

test("A body that is too short, too long or counts what is not there is malformed", () => {
  refuses(() => decoded(ride.int, unhex("01 02 03")), /ends at byte 3, expected 4/);
  refuses(() => decoded(ride.int, unhex("01 02 03 04 05")), /has 1 bytes left over/);
  refuses(() => decoded(ride.array(ride.int), unhex("ff ff ff ff 00")), /counts 4294967295, and 1 bytes are left/);
  refuses(() => decoded(ride.string, unhex("02 00 00 00 61")), /counts 2/);
  refuses(() => decoded(ride.bytes, unhex("ff ff ff 7f")), /counts/);
});

test("A bool above 1, a number that no enumerator has and a text that is no UTF-8 are malformed", () => {
  refuses(() => decoded(ride.bool, unhex("02")), /is 2, expected a bool/);
  refuses(() => decoded(Mode, unhex("03")), /Mode is 3, expected one of idle, follow_route/);
  for (const bad of ["ff", "c0 80", "ed a0 80", "f4 90 80 80"]) {
    const count = bad.split(" ").length;
    refuses(() => decoded(ride.string, unhex(`0${count} 00 00 00 ${bad}`)), /no UTF-8/);
  }
});

test("Numbers are those of the canonical declarations", () => {
  assert.equal(ride.numberOf("void setVelocity(float,float)"), 0x66e299df);
  assert.equal(ride.numberOf("event ObjectPosition{int,int}"), 0x714c2b59);
  assert.equal(ride.Failed.number, ride.numberOf("event Failed{String,String}"));
});

test("A body grows in the middle of any field", () => {
  for (let length = 240; length < 280; ++length) {
    const values = { texts: Array.from({ length: 100 }, (_, i) => "x".repeat((i * 7) % 30)), flags: Array<boolean>(length).fill(true) };
    const Both = ride.struct<typeof values>("Both", { flags: ride.array(ride.bool), texts: ride.array(ride.string) });
    assert.deepEqual(decoded(Both, encoded(Both, values)), values);
  }
});
