// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { type Replacement, replacements } from "../src/merge.ts";

function applied(text: string, all: Replacement[]): string {
  return [...all].reverse().reduce((now, { from, to, insert }) => now.slice(0, from) + insert + now.slice(to), text);
}

test("equal texts need no replacement", () => assert.deepEqual(replacements("a\nb\n", "a\nb\n"), []));

test("a changed word is replaced alone", () => {
  assert.deepEqual(replacements("a\nKp: 400\nc\n", "a\nKp: 500\nc\n"), [{ from: 6, to: 7, insert: "5" }]);
});

test("changes far apart are two replacements, so that a cursor between them stays", () => {
  const all = replacements("one\ntwo\nthree\nfour\n", "One\ntwo\nthree\nfour five\n");
  assert.equal(all.length, 2);
  assert.equal(applied("one\ntwo\nthree\nfour\n", all), "One\ntwo\nthree\nfour five\n");
});

test("replacements make the one text of the other", () => {
  const words = ["a", "b", "c: 1", "", "  - x -> y", "a"];
  let seed = 7;
  const random = (below: number) => (seed = (seed * 48271) % 2147483647) % below;
  const text = () => Array.from({ length: random(9) }, () => words[random(words.length)]).join("\n");
  for (let i = 0; i < 2000; ++i) {
    const [old, now] = [text(), text()];
    const all = replacements(old, now);
    assert.equal(applied(old, all), now);
    all.forEach((one, k) => assert.ok(k === 0 || all[k - 1]!.to <= one.from, "they are in order"));
  }
});
