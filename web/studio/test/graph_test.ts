// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { type Graph, graph_of } from "../src/graph.ts";
import { check } from "./mock/checker.ts";
import { kModels } from "./mock/models.ts";
import { kDeployments } from "./mock/texts.ts";

function graph(texts: Record<string, string>, path: string[] = []): Graph {
  const all = new Map(Object.entries(texts));
  return graph_of(check(Object.keys(texts)[0]!, all, kModels), all, path);
}

const arm = kDeployments["arm"]!;
const box = (all: Graph, id: string) => all.boxes.find((one) => one.id === id)!;
const wires = (all: Graph) => all.wires.map((one) => one.written.join(" -> "));

test("a range is one box under the name as it is written", () => {
  const joints = box(graph(arm), "Joint{1..7}");
  assert.equal(joints.names.length, 7);
  assert.equal(joints.outputs[0]!.written, "Joint{i}.Position");
  assert.equal(joints.outputs[0]!.ends.length, 7);
});

test("the connections that one entry writes are one wire", () => {
  const all = graph(arm);
  assert.ok(wires(all).includes("Joint{i}.Position -> Sensor.Position{i}"));
  const wire = all.wires.find((one) => one.written[1] === "Sensor.Position{i}")!;
  assert.equal(wire.connections.length, 7);
});

test("an array of ports that one entry connects is one port", () => {
  const sensor = box(graph(arm), "Sensor");
  assert.deepEqual(sensor.inputs.map((one) => [one.name, one.count]), [["Position1…7", 7]]);
});

test("a composite is one box with what it exports", () => {
  const rover = box(graph(arm), "Rover");
  assert.equal(rover.composite, true);
  assert.equal(rover.model, "Chassis");
  assert.deepEqual(rover.outputs.map((one) => one.written), ["Rover.LeftAngle", "Rover.RightAngle"]);
  assert.ok(wires(graph(arm)).includes("Driver.Forward -> Rover.Forward"));
});

test("an open composite shows its parts, which edits name by its definition", () => {
  const inside = graph(arm, ["Rover"]);
  assert.deepEqual(inside.boxes.map((one) => one.title).sort(), ["left", "mixer", "right"]);
  assert.equal(box(inside, "Rover.left").edited, "Chassis.left");
  assert.deepEqual(wires(inside), ["mixer.Left -> left.Speed", "mixer.Right -> right.Speed"]);
});

test("a port of an open composite tells where the wires lead that leave it", () => {
  const inside = graph(arm, ["Rover"]);
  const outside = (id: string, port: string) => [...box(inside, id).inputs, ...box(inside, id).outputs].find((one) => one.name === port)!.outside;
  assert.deepEqual(outside("Rover.mixer", "Forward"), ["Driver.Forward"]);
  assert.deepEqual(outside("Rover.left", "Angle"), ["Driver.Left"]);
  assert.equal(outside("Rover.mixer", "Left"), undefined, "its wire is drawn");
  assert.ok(graph(arm).boxes.every((one) => one.inputs.every((port) => port.outside === undefined)));
});

test("an event that commands is a wire from the event to the command", () => {
  const all = graph(arm);
  const wire = all.wires.find((one) => one.kind === "command")!;
  assert.deepEqual(wire.written, ["Go.Pressed", "Generator.hold"]);
  assert.equal(box(all, "Hold"), undefined);
});

test("a range of composites is one box, too", () => {
  const text = `components:
  Rover{1..3}: {model: Chassis}
composites:
  Chassis:
    components:
      left: {model: Wheel}
    exports:
      ports:
        Speed: left.Speed
`;
  const all = graph({ "a.yaml": text });
  assert.deepEqual(all.boxes.map((one) => [one.title, one.names.length]), [["Rover{1..3}", 3]]);
  assert.equal(box(all, "Rover{1..3}").inputs[0]!.written, "Rover{i}.Speed");
  assert.deepEqual(graph({ "a.yaml": text }, ["Rover{1..3}"]).boxes.map((one) => [one.edited, one.names.length]), [["Chassis.left", 3]]);
});

test("a text that does not have the key any more shows names", () => {
  const texts = new Map(Object.entries(arm));
  const checked = check("arm.yaml", texts, kModels);
  const all = graph_of(checked, new Map(), []);
  assert.ok(all.boxes.some((one) => one.id === "Joint3"));
});

test("an entry of which the check says nothing has a box, too", () => {
  const texts = new Map(Object.entries(kDeployments["wrong"]!));
  const graph = graph_of(check("wrong.yaml", texts, kModels), texts, []);
  const filter = graph.boxes.find((box) => box.title === "Filter")!;
  assert.equal(filter.model, "LowPas");
  assert.equal(filter.components[0]!.unknown, true);
  assert.equal(filter.line, 5);
  assert.deepEqual(graph.boxes.filter((box) => box.components[0]!.unknown).map((box) => box.title), ["Filter"]);
});
