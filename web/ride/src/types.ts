// SPDX-License-Identifier: Apache-2.0
import { Code, RideError } from "./error.ts";
import { Reader, Writer } from "./fields.ts";

/** How values of a type of the interface language go to the wire and come from it. */
export interface Type<T> {
  /** Throws a RideError that says what was expected if `value` is none of the type. */
  put(to: Writer, value: T): void;
  take(from: Reader): T;
}

/** The value of what a description describes. */
export type ValueOf<D> = D extends Type<infer T> ? T : never;

function unfit(value: unknown, expected: string): RideError {
  const shown = typeof value === "string" ? JSON.stringify(value.slice(0, 40)) : String(value);
  return new RideError(Code.malformed, `is ${shown}, expected ${expected}`);
}

/** The same, with the name of what has the value in front. */
function of(name: string, error: unknown): unknown {
  return error instanceof RideError ? new RideError(error.code, `${name} ${error.message}`) : error;
}

function whole(size: 1 | 2 | 4, low: number, high: number): Type<number> {
  const bits = (8 * size) as 8 | 16 | 32;
  const set = `set${low < 0 ? "Int" : "Uint"}${bits}` as const;
  const get = `get${low < 0 ? "Int" : "Uint"}${bits}` as const;
  return {
    put(to, value) {
      if (!Number.isInteger(value) || value < low || value > high) {
        throw unfit(value, `a whole number from ${low} to ${high}`);
      }
      const at = to.place(size, size);
      to.view[set](at, value, true);
    },
    take: (from) => from.view[get](from.place(size, size), true),
  };
}

function wide(low: bigint, high: bigint): Type<bigint> {
  return {
    put(to, value) {
      if (typeof value !== "bigint" || value < low || value > high) {
        throw unfit(value, `a bigint from ${low} to ${high}`);
      }
      const at = to.place(8, 4);
      to.view.setBigUint64(at, BigInt.asUintN(64, value), true);
    },
    take(from) {
      const bits = from.view.getBigUint64(from.place(8, 4), true);
      return low < 0n ? BigInt.asIntN(64, bits) : bits;
    },
  };
}

function real(size: 4 | 8): Type<number> {
  const set = size === 4 ? "setFloat32" : "setFloat64";
  const get = size === 4 ? "getFloat32" : "getFloat64";
  return {
    put(to, value) {
      if (typeof value !== "number") throw unfit(value, "a number");
      const at = to.place(size, 4);
      to.view[set](at, value, true);
    },
    take: (from) => from.view[get](from.place(size, 4), true),
  };
}

export const char = whole(1, -128, 127);
export const byte = whole(1, 0, 255);
export const short = whole(2, -32768, 32767);
export const unsignedShort = whole(2, 0, 65535);
export const int = whole(4, -2147483648, 2147483647);
export const unsignedInt = whole(4, 0, 4294967295);
export const long = wide(-(1n << 63n), (1n << 63n) - 1n);
export const unsignedLong = wide(0n, (1n << 64n) - 1n);
export const float = real(4);
export const double = real(8);

export const bool: Type<boolean> = {
  put(to, value) {
    if (typeof value !== "boolean") throw unfit(value, "true or false");
    const at = to.place(1, 1);
    to.view.setUint8(at, value ? 1 : 0);
  },
  take(from) {
    const value = from.view.getUint8(from.place(1, 1));
    if (value > 1) throw unfit(value, "a bool, 0 or 1");
    return value === 1;
  },
};

/** Half of a pair of UTF-16, which UTF-8 has no bytes for. */
const kHalfLetter = /\p{Surrogate}/u;

export const string: Type<string> = {
  put(to, value) {
    if (typeof value !== "string" || kHalfLetter.test(value)) throw unfit(value, "a text");
    to.text(value);
  },
  take: (from) => from.text(),
};

/** Nothing: the result of an operation that returns `void`. */
export const nothing: Type<void> = { put() {}, take() {} };

/** Refuses what is outside of `low` to `high`, and NaN. */
export function within<T extends number | bigint>(type: Type<T>, low: T, high: T): Type<T> {
  const round = (value: T): T => (type === (float as Type<unknown>) ? (Math.fround(value as number) as T) : value);
  const check = (value: T): void => {
    if (!(round(value) >= round(low) && round(value) <= round(high))) throw unfit(value, `${low} to ${high}`);
  };
  return {
    put(to, value) {
      check(value);
      type.put(to, value);
    },
    take(from) {
      const value = type.take(from);
      check(value);
      return value;
    },
  };
}

function putElements<T>(to: Writer, element: Type<T>, values: readonly T[]): void {
  values.forEach((value, i) => {
    try {
      element.put(to, value);
    } catch (error) {
      throw of(`element ${i}`, error);
    }
  });
}

function takeElements<T>(from: Reader, element: Type<T>, count: number): T[] {
  const values: T[] = [];
  for (let i = 0; i < count; ++i) values.push(element.take(from));
  return values;
}

/** `Array<T>`. */
export function array<T>(element: Type<T>): Type<T[]> {
  return {
    put(to, values) {
      if (!Array.isArray(values)) throw unfit(values, "an array");
      to.count(values.length);
      putElements(to, element, values);
    },
    take: (from) => takeElements(from, element, from.count()),
  };
}

/** `Array<T, count>`. */
export function fixed<T>(element: Type<T>, count: number): Type<T[]> {
  return {
    put(to, values) {
      if (!Array.isArray(values)) throw unfit(values, `an array of ${count}`);
      if (values.length !== count) {
        throw new RideError(Code.malformed, `has ${values.length} elements, expected ${count}`);
      }
      putElements(to, element, values);
    },
    take: (from) => takeElements(from, element, count),
  };
}

/** `Array<byte>`, which is one piece of memory here. */
export const bytes: Type<Uint8Array> = {
  put(to, value) {
    if (!(value instanceof Uint8Array)) throw unfit(value, "a Uint8Array");
    to.count(value.length);
    to.bytes(value);
  },
  take: (from) => from.bytes(from.count()),
};

/** The same; refuses a byte outside of `low` to `high`. */
export function bytesWithin(low: number, high: number): Type<Uint8Array> {
  const check = (value: Uint8Array): void => {
    const outside = value.find((each) => each < low || each > high);
    if (outside !== undefined) throw unfit(outside, `${low} to ${high}`);
  };
  return {
    put(to, value) {
      bytes.put(to, value);
      check(value);
    },
    take(from) {
      const value = bytes.take(from);
      check(value);
      return value;
    },
  };
}

/** An `enum`: its values are the names of its enumerators. */
export function enumeration<Name extends string, N extends number | bigint>(
  name: string,
  underlying: Type<N>,
  numbers: Readonly<Record<Name, N>>,
): Type<Name> {
  const numberOf = new Map<string, N>(Object.entries(numbers) as [Name, N][]);
  const names = new Map<N, Name>((Object.entries(numbers) as [Name, N][]).map(([each, number]) => [number, each]));
  const expected = `one of ${[...numberOf.keys()].slice(0, 20).join(", ")}`;
  return {
    put(to, value) {
      const number = numberOf.get(value);
      if (number === undefined) throw of(name, unfit(value, expected));
      underlying.put(to, number);
    },
    take(from) {
      const number = underlying.take(from);
      const found = names.get(number);
      if (found === undefined) throw of(name, unfit(number, expected));
      return found;
    },
  };
}

export type Members<T> = { readonly [K in keyof T]: Type<T[K]> };

/** A `struct`: an object with these members, in this order on the wire. */
export function struct<T extends object>(name: string, members: Members<T>): Type<T> {
  const all = Object.entries(members) as [keyof T, Type<T[keyof T]>][];
  return {
    put(to, value) {
      if (typeof value !== "object" || value === null) throw unfit(value, `a ${name}`);
      for (const [member, type] of all) {
        try {
          type.put(to, value[member]);
        } catch (error) {
          throw of(`${name}.${String(member)}`, error);
        }
      }
    },
    take(from) {
      const value = {} as T;
      for (const [member, type] of all) {
        try {
          value[member] = type.take(from);
        } catch (error) {
          throw of(`${name}.${String(member)}`, error);
        }
      }
      return value;
    },
  };
}

/** An event: its members, and the number by which it is known on the wire. */
export interface EventType<T> extends Type<T> {
  readonly event: string;
  readonly number: number;
}

export function event<T extends object>(name: string, number: number, members: Members<T>): EventType<T> {
  return { ...struct<T>(name, members), event: name, number };
}

/** A parameter that has come; throws a RideError that names it if it is none of the type. */
export function taken<T>(name: string, type: Type<T>, from: Reader): T {
  try {
    return type.take(from);
  } catch (error) {
    throw of(`parameter ${name}`, error);
  }
}

/** A parameter with its value, which is checked when it is written. */
export type Parameter = (to: Writer) => void;

export function parameter<T>(name: string, type: Type<T>, value: T): Parameter {
  return (to) => {
    try {
      type.put(to, value);
    } catch (error) {
      throw of(`parameter ${name}`, error);
    }
  };
}
