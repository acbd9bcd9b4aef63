// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { laid_in_lanes } from "../src/lanes.ts";

const node = (id: string) => ({ id, width: 152, height: 88 });
const kThreads: Record<string, string> = { A: "fast", B: "fast", C: "slow", D: "" };
const laid = () => laid_in_lanes(["A", "B", "C", "D"].map(node), [["A", "B"], ["B", "C"]], ["fast", "idle", "slow"], (id) => kThreads[id]!);

test("each thread with boxes has a lane, in the order of the threads, the others below", () => {
  assert.deepEqual(laid().lanes.map(({ title, number }) => [title, number]), [["fast", 0], ["slow", 2], ["several threads, or none", -1]]);
});

test("boxes are within their lane, and lanes do not meet", () => {
  const { places, lanes } = laid();
  const lane_of: Record<string, number> = { A: 0, B: 0, C: 1, D: 2 };
  for (const [id, [x, y]] of places) {
    const lane = lanes[lane_of[id]!]!;
    assert.ok(x >= lane.x && x + 152 <= lane.x + lane.width, id);
    assert.ok(y >= lane.y && y + 88 <= lane.y + lane.height, id);
  }
  for (let i = 1; i < lanes.length; ++i) assert.ok(lanes[i]!.y >= lanes[i - 1]!.y + lanes[i - 1]!.height);
});

test("within a lane data flows to the right", () => {
  const { places } = laid();
  assert.ok(places.get("B")![0] > places.get("A")![0]);
});
