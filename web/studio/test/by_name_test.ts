// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { peers_by_name, wires_by_name } from "../src/by_name.ts";
import type { Checked, Component, Connection, Port } from "../src/checked.ts";
import { graph_of } from "../src/graph.ts";

const kFile = "a.yaml";

const port = (name: string, more: Partial<Port> = {}): Port => ({ name, type: "double", unit: "", doc: "", ...more });

function component(name: string, line: number, more: Partial<Component>): Component {
  return {
    name, model: "M", file: kFile, line, column: 3, activity: { kind: "sequential" },
    properties: [], inputs: [], outputs: [], port_arrays: [], operations: [], events: [], requirements: [], ...more,
  };
}

function graph(text: string, components: Component[], connections: Connection[] = []) {
  const checked: Checked = { file: kFile, application: "a", ok: true, errors: 0, diagnostics: [], components, connections, threads: [], modes: [] };
  return graph_of(checked, new Map([[kFile, text]]), []);
}

const kTwo = "components:\n  A: {model: M}\n  B: {model: M}\n";
const kThree = `${kTwo}  C: {model: M}\n`;

test("an input that needs a writer is connected with the only output of its name", () => {
  const a = component("A", 2, { outputs: [port("x"), port("other")] });
  const b = component("B", 3, { inputs: [port("x"), port("y"), port("other", { may_stay_open: true })] });
  assert.deepEqual(wires_by_name(graph(kTwo, [a, b])), [["A.x", "B.x"]]);
});

test("of two of a name, another type, unit or size, or a writer that is there, nothing comes", () => {
  const a = component("A", 2, { outputs: [port("x")] });
  const input = component("B", 3, { inputs: [port("x")] });
  assert.deepEqual(wires_by_name(graph(kThree, [a, input, component("C", 4, { outputs: [port("x")] })])), []);
  for (const other of [{ type: "bool" }, { unit: "rad" }]) {
    assert.deepEqual(wires_by_name(graph(kTwo, [a, component("B", 3, { inputs: [port("x", other)] })])), []);
  }
  const sized = (size: number) => [port("x", { size })];
  assert.deepEqual(wires_by_name(graph(kTwo, [component("A", 2, { outputs: sized(2) }), component("B", 3, { inputs: sized(3) })])), []);
  const there: Connection = { kind: "data", from: "A.x", to: "B.x", file: kFile, line: 5, column: 5 };
  assert.deepEqual(wires_by_name(graph(kTwo, [a, input], [there])), []);
});

test("a range meets an array of as many ports", () => {
  const text = "components:\n  J{1..2}: {model: M}\n  B: {model: M}\n";
  const joints = ["J1", "J2"].map((name) => component(name, 2, { outputs: [port("Armed")] }));
  const array = component("B", 3, { inputs: [port("Armed1"), port("Armed2")], port_arrays: [{ name: "Armed", count: "joints" }] });
  assert.deepEqual(wires_by_name(graph(text, [...joints, array])), [["J{i}.Armed", "B.Armed{i}"]]);
  const longer = component("B", 3, { ...array, inputs: [port("Armed1"), port("Armed2"), port("Armed3")] });
  assert.deepEqual(wires_by_name(graph(text, [...joints, longer])), []);
});

test("only wires of the boxes that are asked for", () => {
  const all = graph(kThree, [
    component("A", 2, { outputs: [port("x"), port("y")] }), component("B", 3, { inputs: [port("x")] }), component("C", 4, { inputs: [port("y")] }),
  ]);
  assert.deepEqual(wires_by_name(all, ["B"]), [["A.x", "B.x"]]);
  assert.deepEqual(wires_by_name(all, ["A"]), [["A.x", "B.x"], ["A.y", "C.y"]]);
});

test("a peer is the only component that has what another one hears or calls, unless it is served", () => {
  const arm = { name: "Arm", signature: "void()", doc: "" };
  const hears = component("B", 3, { requirements: [{ ...arm, kind: "event", optional: true }] });
  const arming = component("A", 2, { events: [{ ...arm, arguments: [] }] });
  const one = graph(kTwo, [arming, hears]);
  assert.deepEqual(peers_by_name(one, new Set(), kFile), [["B", "A"]]);
  assert.deepEqual(peers_by_name(one, new Set(["B.Arm"]), kFile), []);
  assert.deepEqual(peers_by_name(one, new Set(), "another.yaml"), []);
  assert.deepEqual(peers_by_name(graph(kThree, [arming, hears, component("C", 4, { events: arming.events })]), new Set(), kFile), []);
});
