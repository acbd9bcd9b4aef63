// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { offset_of, with_fix } from "../src/bytes.ts";

const kText = "# größe: 🤖 Sorce\n  - Sorce.Out -> Sink.In\nlast";

test("a column counts bytes of UTF-8", () => {
  assert.equal(kText.slice(offset_of(kText, 1, 17), offset_of(kText, 1, 22)), "Sorce");
  assert.equal(offset_of(kText, 2, 5), kText.indexOf("Sorce.Out"));
});

test("a place behind the end is the end", () => {
  assert.equal(offset_of(kText, 9, 1), kText.length);
  assert.equal(offset_of(kText, 3, 99), kText.length);
  assert.equal(offset_of("ab\ncd", 1, 99), 2);
});

test("a fix replaces what stands at its place and nothing else", () => {
  const fix = { file: "a", line: 2, column: 5, found: "Sorce", by: "Source" };
  assert.equal(with_fix(kText, fix), kText.replace("- Sorce.", "- Source."));
});

test("a fix of a text that has changed is not made", () => {
  assert.equal(with_fix(`new\n${kText}`, { file: "a", line: 2, column: 5, found: "Sorce", by: "Source" }), undefined);
});
