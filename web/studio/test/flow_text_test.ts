// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { flow_of, items_of, map_of, said_in, section_of } from "../src/flow_text.ts";
import { entries_of } from "../src/written.ts";

const kText = `# What it is for.
include: [part.yaml, "more.yaml"]  # two
modes:
  rest: [Lamp]
  work:
    - Joint{1..7}  # all
    - Generator
components:
  Joint{1..7}:
    model: Joint  # of the arm
    peers: ["card{i}",
            Sampler]
    superiors: Generator
    properties:
      Gains: {Kp: 1, calls: 2}
  Short: Wave
  Go:
    model: Sequence
    calls:
      - Vision.start
      - call: Vision.set
        with:
          low: 10
          high: Dial.Out
      - {call: Vision.stop}
connections:
  - A.Out -> B.In
`;
const texts = new Map([["a.yaml", kText]]);
const [joint, short, go] = entries_of(texts);

test("lists and maps of lines stand on one line", () => {
  assert.equal(flow_of("- a\n- b: 1\n  c: [x,\n      y]\n"), "[a, {b: 1, c: [x, y]}]");
  assert.equal(flow_of("a:\n  b:\n  - 1\n  - 2\nc: d # e\n"), "{a: {b: [1, 2]}, c: d}");
  assert.equal(flow_of(""), "");
});

test("what an entry says is found under its key alone", () => {
  assert.deepEqual(items_of(said_in(texts, joint!, "peers")), ['"card{i}"', "Sampler"]);
  assert.deepEqual(items_of(said_in(texts, joint!, "superiors")), ["Generator"]);
  assert.equal(said_in(texts, joint!, "calls"), "", "a property of that name is none of its calls");
  assert.equal(said_in(texts, short!, "calls"), "");
  assert.equal(said_in(texts, go!, "calls"), "[Vision.start, {call: Vision.set, with: {low: 10, high: Dial.Out}}, {call: Vision.stop}]");
});

test("so is what a file says", () => {
  assert.deepEqual(items_of(section_of(kText, "include")), ["part.yaml", '"more.yaml"']);
  assert.deepEqual([...map_of(section_of(kText, "modes"))], [["rest", "[Lamp]"], ["work", "[Joint{1..7}, Generator]"]]);
  assert.equal(section_of(kText, "libraries"), "");
});
