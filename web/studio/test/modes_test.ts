// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { graph_of } from "../src/graph.ts";
import { is_off, modes_of, names_entry, rows_of } from "../src/modes.ts";
import { check } from "./mock/checker.ts";
import { kModels } from "./mock/models.ts";
import { kDeployments } from "./mock/texts.ts";

const off_in = (name: string, mode: string, of: Record<string, string>) => {
  const texts = new Map(Object.entries(of));
  const checked = check([...texts.keys()][0]!, texts, kModels);
  return graph_of(checked, texts, []).boxes.filter((box) => is_off(box, modes_of(texts), mode)).map((box) => box.title).includes(name);
};

test("modes are read with their components", () => {
  const texts = new Map(Object.entries(kDeployments["vision"]!));
  assert.deepEqual(modes_of(texts), [
    { name: "look", file: "vision.yaml", components: ["Vision", "Prepare"] }, { name: "rest", file: "vision.yaml", components: ["Dial"] },
  ]);
  assert.deepEqual(rows_of(texts, modes_of(texts)), ["Vision", "Prepare", "Dial", "Ask", "Lamp"]);
  assert.ok(names_entry(modes_of(texts)[1]!, "Dial"));
});

test("off is what another mode names and this one does not", () => {
  const vision = kDeployments["vision"]!;
  assert.ok(off_in("Dial", "look", vision) && !off_in("Dial", "rest", vision));
  assert.ok(!off_in("Ask", "look", vision), "what no mode names runs in all");
  assert.ok(!off_in("Dial", "", vision), "no mode is shown");
});

test("the deployment's own file has the last word on a mode", () => {
  const texts = new Map([["own.yaml", "include: part.yaml\nmodes: {work: [B]}\n"], ["part.yaml", "modes:\n  work: [A]\n  rest: [A]\n"]]);
  assert.deepEqual(modes_of(texts).map(({ name, file, components }) => [name, file, ...components]), [["work", "own.yaml", "B"], ["rest", "part.yaml", "A"]]);
});

test("a range and the parts of a composite stand in a mode by their entry", () => {
  const text = `${kDeployments["arm"]!["arm.yaml"]!.replace("work: [Generator]", "work: [Rover, \"Joint{1..7}\"]")}`;
  const arm = { "arm.yaml": text, "control.yaml": kDeployments["arm"]!["control.yaml"]! };
  for (const box of ["Rover", "Joint{1..7}"]) assert.ok(off_in(box, "rest", arm) && !off_in(box, "work", arm), box);
});
