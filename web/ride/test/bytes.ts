// SPDX-License-Identifier: Apache-2.0
import { Reader, type Type, Writer } from "../src/ride.ts";

export function hex(bytes: Uint8Array): string {
  return [...bytes].map((each) => each.toString(16).padStart(2, "0")).join(" ");
}

export function unhex(text: string): Uint8Array {
  return Uint8Array.from(text.trim().split(/\s+/), (each) => parseInt(each, 16));
}

export function encoded<T>(type: Type<T>, value: T): Uint8Array {
  const to = new Writer();
  type.put(to, value);
  return to.body().slice();
}

export function decoded<T>(type: Type<T>, body: Uint8Array): T {
  const from = new Reader(body);
  const value = type.take(from);
  from.end();
  return value;
}
