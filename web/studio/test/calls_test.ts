// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { callable, calls_of, calls_text, moved, parameters_of_call } from "../src/calls.ts";
import { graph_of } from "../src/graph.ts";
import { check } from "./mock/checker.ts";
import { kModels } from "./mock/models.ts";
import { kDeployments } from "./mock/texts.ts";

const texts = new Map(Object.entries(kDeployments["vision"]!));
const checked = check("vision.yaml", texts, kModels);
const box = graph_of(checked, texts, []).boxes.find((one) => one.title === "Prepare")!;
const calls = calls_of(texts, box);

test("calls are read in their order, with their parameters", () => {
  assert.deepEqual(calls, [{ to: "Vision.initialize", with: "" }, { to: "Vision.setThreshold", with: "{low: 10, far: Dial.Out}" }]);
  assert.deepEqual(parameters_of_call(checked, box, calls[1]!).map(({ name, unit, given }) => [name, unit, given]), [["low", "", "10"], ["far", "m", "Dial.Out"]]);
});

test("they are written as an edit takes them", () => {
  assert.equal(calls_text(calls), "[Vision.initialize, {call: Vision.setThreshold, with: {low: 10, far: Dial.Out}}]");
  assert.equal(calls_text([]), "[]");
  assert.deepEqual(moved(["a", "b", "c"], 2, -1), ["a", "c", "b"]);
  assert.deepEqual(moved(["a", "b", "c"], 0, 1), ["b", "a", "c"]);
});

test("acts of the operator, and what it has itself, are not offered", () => {
  const offers = callable(checked, box);
  assert.ok(offers.includes("Vision.start") && offers.includes("Dial.move"));
  assert.ok(!offers.includes("Vision.arm") && !offers.includes("Prepare.run"));
});
