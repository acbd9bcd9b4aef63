// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { composites_of, ends_at, entries_of, is_made_by, key_at, model_of, parameters_of, settings_at } from "../src/written.ts";

const kText = `libraries: [a]
components:
  Joint{1..\${joints}}:  # the joints
    model: Joint
    peers: ["card{i}", Sampler]
  "Quoted": {model: Card}
  Short: Wave
composites:
  Chassis:
    components:
      left: {model: Wheel}
    exports:
      ports: {LeftAngle: left.Angle}
      operations:
        stop: left.stop
connections:
  - Joint{i}.Position -> Sensor.Position{i+1}
  - {from: A.Out, to: B.In, policy: {fifo: 8}, max_age: 30 ms}
  - on: Go.Pressed
    do: Lift.travel
`;
const texts = new Map([["a.yaml", kText]]);
const line_of = (word: string) => kText.split("\n").findIndex((line) => line.includes(word)) + 1;

test("keys are read as they are written", () => {
  assert.equal(key_at(texts, "a.yaml", 3, 3), "Joint{1..${joints}}");
  assert.equal(key_at(texts, "a.yaml", line_of("Quoted"), 3), "Quoted");
  assert.equal(key_at(texts, "a.yaml", line_of("model: Joint"), 1), "");
  assert.equal(key_at(texts, "other.yaml", 1, 1), "");
});

test("a range makes its numbers and no other names", () => {
  assert.ok(is_made_by("Joint{1..7}", "Joint3"));
  assert.ok(is_made_by("Joint{1..${joints}}", "Joint12"));
  assert.ok(!is_made_by("Joint{1..7}", "JointX"));
  assert.ok(!is_made_by("Joint{1..7}", "Joints3"));
  assert.ok(is_made_by("Arm", "Arm"));
});

test("the ends of a connection are read in each form", () => {
  assert.deepEqual(ends_at(texts, "a.yaml", line_of("Joint{i}.Pos"), 5), ["Joint{i}.Position", "Sensor.Position{i+1}"]);
  assert.deepEqual(ends_at(texts, "a.yaml", line_of("from: A"), 5), ["A.Out", "B.In"]);
  assert.deepEqual(ends_at(texts, "a.yaml", line_of("on: Go"), 5), ["Go.Pressed", "Lift.travel"]);
});

test("settings are what else a connection says", () => {
  assert.equal(settings_at(texts, "a.yaml", line_of("from: A"), 5), "policy: {fifo: 8}, max_age: 30 ms");
  assert.equal(settings_at(texts, "a.yaml", line_of("Joint{i}.Pos"), 5), "");
});

test("entries have their names and models", () => {
  const entries = entries_of(texts);
  assert.deepEqual(entries.map((one) => one.name), ["Joint{1..${joints}}", "Quoted", "Short"]);
  assert.deepEqual(entries.map((one) => model_of(texts, one)), ["Joint", "Card", "Wave"]);
});

test("composites have their exports, by the path inside", () => {
  const [chassis] = composites_of(texts);
  assert.equal(chassis!.name, "Chassis");
  assert.deepEqual([...chassis!.exports], [["left.Angle", "LeftAngle"], ["left.stop", "stop"]]);
});

test("parameters are those at the top of a file, with what they are if nobody sets them", () => {
  const found = parameters_of(new Map([["a.yaml", "parameters:\n  period: 10 ms\n  description: \"${here}/a.urdf\"  # of the robot\ncomponents:\n  A: {model: B}\n"], ["b.yaml", "application: b\n"]]));
  assert.deepEqual([...found], [["period", "10 ms"], ["description", "${here}/a.urdf"]]);
});
