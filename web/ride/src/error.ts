// SPDX-License-Identifier: Apache-2.0

/** Why there is no answer: the codes of the wire, and those of this side (from 100). */
export const Code = {
  noSuchComponent: 1,
  noSuchOperation: 2,
  malformed: 3,
  badMagic: 4,
  tooLarge: 5,
  notAllowed: 6,
  busy: 7,
  failed: 8,
  shuttingDown: 9,
  hello: 16,
  ping: 17,
  pong: 18,
  notConnected: 100,
  lost: 101,
  timeout: 102,
  queueFull: 103,
  wrongInterface: 104,
} as const;
export type Code = (typeof Code)[keyof typeof Code];

/** The code's name, or its number if it is unknown. */
export function nameOf(code: number): string {
  const found = Object.entries(Code).find(([, value]) => value === code);
  return found === undefined ? `code ${code}` : found[0];
}

/** What went wrong with a call, a value or a connection. The text names the object. */
export class RideError extends Error {
  override readonly name = "RideError";
  readonly code: number;
  constructor(code: number, text: string) {
    super(text);
    this.code = code;
  }
}
