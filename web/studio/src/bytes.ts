// SPDX-License-Identifier: Apache-2.0
// Places are counted in bytes of UTF-8, strings here in units of UTF-16.
import type { Fix } from "./checked.ts";

function bytes_of(point: number): number {
  if (point < 0x80) return 1;
  if (point < 0x800) return 2;
  return point < 0x10000 ? 3 : 4;
}

/** Where a place (from 1, column in bytes) is in `text`; its end if the text is shorter. */
export function offset_of(text: string, line: number, column: number): number {
  let begin = 0;
  for (let i = 1; i < line; ++i) {
    const end = text.indexOf("\n", begin);
    if (end < 0) return text.length;
    begin = end + 1;
  }
  let bytes = 1;
  let at = begin;
  while (at < text.length && bytes < column && text[at] !== "\n") {
    const point = text.codePointAt(at) ?? 0;
    bytes += bytes_of(point);
    at += point > 0xffff ? 2 : 1;
  }
  return at;
}

/** The text with the fix made; undefined if what it replaces does not stand there any more. */
export function with_fix(text: string, fix: Fix): string | undefined {
  const at = offset_of(text, fix.line, fix.column);
  if (!text.startsWith(fix.found, at)) return undefined;
  return text.slice(0, at) + fix.by + text.slice(at + fix.found.length);
}
