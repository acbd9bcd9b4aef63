// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Component, Port } from "../src/checked.ts";
import { binding_of, moving_joints, robots_of, sources_of } from "../src/robots.ts";

const port = (name: string, doc: string, type = "vector<double>", size?: number, unit = "rad"): Port => ({ name, doc, type, unit, ...(size === undefined ? {} : { size }) });
const component = (name: string, outputs: Port[], properties: Record<string, string> = {}): Component => ({
  name, model: "M", activity: { kind: "sequential" }, inputs: [], outputs, port_arrays: [], operations: [], events: [], requirements: [],
  properties: Object.entries(properties).map(([key, value]) => ({ name: key, value, type: "text", unit: "", doc: "", persistent: true, mandatory: false, changeable_while_running: false })),
});

/** As Janus and the WAM have them. */
const kBridge = component("BridgeRef", [port("nAxesSensorPosition", "measured position of each joint", undefined, 2), port("reference", "desired [q1..qN, qd1..qdN]", undefined, 6, "")]);
const kSensor = component("Sensor", [port("sensor", "measured [q1..qN, d1..dN]: positions, then displacements", undefined, 4)]);
const kGenerator = component("Generator", [port("nAxesDesiredPosition", "desired position of each axis", undefined, 2)]);
const kJoints = [1, 2].map((i) => component(`Joint${i}`, [port("Position", "of the joint", "double"), port("Armed", "efforts are passed", "bool", undefined, "")]));
const kController = component("Controller", [1, 2].map((i) => port(`Sen${i}`, "measured position, for each PID", "double")));
const kAll = [kGenerator, ...kJoints, kController, kSensor, kBridge];

const found = (components: Component[], chosen?: string) => binding_of(sources_of(components, "Robot", 2), chosen);

test("components that name one description are one robot, however they name it", () => {
  const robots = robots_of([
    component("Robot", [], { robot_description: "robots/janus/deployments/../janus.urdf", tip_link: "hand" }),
    component("Cards", [], { robot_description: "robots/janus/janus.urdf" }),
    component("Other", [], { robot_description: "" }),
    component("Second", [], { robot_description: "../../b.urdf" }),
  ]);
  assert.deepEqual(robots.map(({ owner, tip }) => [owner, tip]), [["Robot", "hand"], ["Second", ""]]);
  assert.equal(robots[0]!.path, "robots/janus/deployments/../janus.urdf", "the server knows it as the component has it");
});

test("measured positions of so many joints are found, and nothing that is desired", () => {
  assert.equal(found(kAll).source?.port, "BridgeRef.nAxesSensorPosition");
  assert.deepEqual(found([kGenerator, ...kJoints, kSensor]).source?.items, ["Sensor.sensor"]);
  assert.deepEqual(found([kGenerator]).source, undefined);
  assert.match(found([kGenerator]).trouble, /no port looks like/);
});

test("ports of components that are counted are joints in their order", () => {
  const { source } = found([...kJoints].reverse());
  assert.equal(source, undefined, "a position of something need not have been measured");
  const chosen = found([...kJoints].reverse(), "Joint{1..2}.Position");
  assert.deepEqual(chosen.source?.items, ["Joint1.Position", "Joint2.Position"]);
  assert.equal(chosen.chosen, true);
  assert.equal(sources_of(kJoints, "Robot", 3).length, 0, "there are fewer than joints");
});

test("two that look alike are the user's choice", () => {
  const twin = component("Twin", kBridge.outputs);
  assert.match(found([kBridge, twin]).trouble, /'BridgeRef.nAxesSensorPosition' and 'Twin.nAxesSensorPosition' look alike/);
  assert.equal(found([kBridge, twin], "Twin.nAxesSensorPosition").source?.port, "Twin.nAxesSensorPosition");
  assert.match(found([kBridge], "Twin.nAxesSensorPosition").trouble, /is there no more/);
});

test("a robot of a composite is moved from within it", () => {
  const inside = ["Left", "Right"].map((side) => component(`${side}.Bridge`, kBridge.outputs));
  const { source } = binding_of(sources_of(inside, "Right.Robot", 2), undefined);
  assert.equal(source?.port, "Right.Bridge.nAxesSensorPosition");
});

const joint = (name: string, parent: string, child: string, type = "revolute") => ({ name, parent, child, type });

test("joints are counted from the base to the tip, those that do not move left out", () => {
  const joints = [joint("wrist", "arm", "hand"), joint("mount", "hand", "camera", "fixed"), joint("shoulder", "base", "arm"), joint("finger", "base", "finger", "prismatic")];
  const names = (base: string, tip: string) => moving_joints(joints, base, tip).map((one) => one.name);
  assert.deepEqual(names("", ""), ["shoulder", "wrist", "finger"]);
  assert.deepEqual(names("base", "camera"), ["shoulder", "wrist"]);
  assert.deepEqual(names("", "nobody"), []);
});

test("a description that goes round ends all the same", () => {
  const round = [joint("a", "x", "y"), joint("b", "y", "x")];
  assert.deepEqual(moving_joints(round, "", ""), []);
  assert.ok(moving_joints(round, "x", "").length <= 2);
  assert.ok(moving_joints(round, "z", "y").length <= 2);
});
