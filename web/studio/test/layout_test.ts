// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { layout, type LayoutNode, type Point } from "../src/layout.ts";

const node = (id: string): LayoutNode => ({ id, width: 160, height: 80 });
const nodes = (ids: string): LayoutNode[] => [...ids].map(node);
const edges = (text: string): [string, string][] => text.split(" ").map((one) => [one[0]!, one[1]!]);

function overlaps(all: LayoutNode[], places: Map<string, Point>): boolean {
  return all.some((a, i) => all.slice(i + 1).some((b) => {
    const [[ax, ay], [bx, by]] = [places.get(a.id)!, places.get(b.id)!];
    return ax < bx + b.width && bx < ax + a.width && ay < by + b.height && by < ay + a.height;
  }));
}

test("data flows from left to right", () => {
  const places = layout(nodes("abc"), edges("ab bc ac"));
  assert.ok(places.get("a")![0] < places.get("b")![0] && places.get("b")![0] < places.get("c")![0]);
});

test("a circle does not stop it", () => {
  const places = layout(nodes("abc"), edges("ab bc ca cc"));
  assert.equal(places.size, 3);
  assert.ok(places.get("a")![0] < places.get("c")![0]);
});

test("boxes do not cover each other, connected or not", () => {
  const all = nodes("abcdefghij");
  assert.ok(!overlaps(all, layout(all, edges("ab ac ad be ce de ef"))));
});

test("places are on a grid of 8", () => {
  const places = layout([node("a"), { id: "b", width: 157, height: 61 }, node("c")], edges("ab ac"));
  for (const [x, y] of places.values()) assert.ok(x % 8 === 0 && y % 8 === 0);
});

test("crossings are avoided where order alone does it", () => {
  const places = layout(nodes("abxy"), edges("ay bx"));
  const above = (a: string, b: string) => places.get(a)![1] < places.get(b)![1];
  assert.equal(above("a", "b"), above("y", "x"));
});

test("a box with a place keeps it, and no other is laid over it", () => {
  const all = nodes("abc");
  const free = layout(all, edges("ab bc"));
  const places = layout(all, edges("ab bc"), new Map([["c", free.get("b")!]]));
  assert.deepEqual(places.get("c"), free.get("b"));
  assert.ok(!overlaps(all, places));
});

test("a long chain is continued below", () => {
  const all = Array.from({ length: 60 }, (_, i) => node(`n${i}`));
  const places = layout(all, all.slice(1).map((one, i) => [`n${i}`, one.id]));
  const width = Math.max(...[...places.values()].map(([x]) => x));
  const height = Math.max(...[...places.values()].map(([, y]) => y));
  assert.ok(width < 3 * height, `${width} x ${height}`);
});

test("1000 boxes and 2000 wires take less than half a second", () => {
  const all = Array.from({ length: 1000 }, (_, i) => node(`n${i}`));
  const wires = all.slice(3).flatMap((one, i): [string, string][] => [[`n${i}`, one.id], [`n${i + 1}`, one.id]]);
  const begin = performance.now();
  layout(all, wires);
  assert.ok(performance.now() - begin < 500);
});
