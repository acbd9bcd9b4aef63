// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { given_in, with_parameter } from "../src/event_command.ts";
import { graph_of } from "../src/graph.ts";
import { check } from "./mock/checker.ts";
import { kModels } from "./mock/models.ts";
import { kDeployments } from "./mock/texts.ts";

test("parameters are those of with, whatever stands around it", () => {
  assert.deepEqual([...given_in("name: Go, with: {at: [1, 2], for: 500 ms}, max_age: 1 s")], [["at", "[1, 2]"], ["for", "500 ms"]]);
  assert.deepEqual([...given_in("name: Go")], []);
});

test("a parameter is given, given otherwise, and left to the event", () => {
  assert.equal(with_parameter("", "left", "Left.Out"), "with: {left: Left.Out}");
  assert.equal(with_parameter("name: Go, with: {left: 1}, max_age: 1 s", "right", "2"), "name: Go, max_age: 1 s, with: {left: 1, right: 2}");
  assert.equal(with_parameter("with: {left: 1, right: 2}", "left", "[3, 4]"), "with: {left: [3, 4], right: 2}");
  assert.equal(with_parameter("name: Go, with: {left: 1}", "left", " "), "name: Go");
});

function arm(opened: string[]) {
  const texts = new Map(Object.entries(kDeployments["arm"]!));
  return graph_of(check("arm.yaml", texts, kModels), texts, [], opened);
}

test("opened it is a box between the event and the command, with a pin for each parameter", () => {
  const { boxes, wires } = arm(["Move"]);
  const box = boxes.find((one) => one.id === "Move")!;
  assert.deepEqual(box.inputs.map(({ name, outside }) => [name, outside?.[0]]), [["On", undefined], ["target", undefined], ["time", "2 s"]]);
  assert.equal(box.inputs[2]!.unit, "s");
  assert.deepEqual(box.outputs.map((one) => one.name), ["Do", "Done", "Failed"]);
  const at = wires.filter((one) => one.between === "Move").map(({ from, to, parameter }) => [from.box, from.port, to.box, to.port, parameter]);
  assert.deepEqual(at.sort(), [
    ["Move", "event:Do", "Generator", "command:moveTo", undefined], ["Power", "event:TurnedOn", "Move", "command:On", undefined],
    ["Sensor", "output:sensor", "Move", "input:target", "target"],
  ]);
  assert.deepEqual(wires.find((one) => one.between === "Move")!.written, ["Power.TurnedOn", "Generator.moveTo"]);
});

test("closed it is one wire, and its values have none", () => {
  const { boxes, wires } = arm([]);
  assert.equal(boxes.find((one) => one.id === "Move"), undefined);
  assert.deepEqual(wires.filter((one) => one.between === "Move").map((one) => one.kind), ["command"]);
});
