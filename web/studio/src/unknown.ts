// SPDX-License-Identifier: Apache-2.0
// Entries of the files of which the check says nothing, because of a mistake: they stand on the canvas, too.
import type { Checked, Component } from "./checked.ts";
import { said_in } from "./flow_text.ts";
import { entries_of, is_made_by, model_of, type Texts, type WrittenEntry } from "./written.ts";

/** Of a deployment with errors, what stands for entries without a component. */
export function unknown_components(checked: Checked, texts: Texts): Component[] {
  if (checked.errors === 0) return [];
  const tops = [...new Set(checked.components.map(({ name }) => name.split(".")[0]!))];
  const known = new Set(tops);
  const is_known = ({ name }: WrittenEntry) => known.has(name) || (name.includes("{") && tops.some((one) => is_made_by(name, one)));
  return entries_of(texts).filter((entry) => !is_known(entry) && makes_one(texts, entry)).map((entry) => unknown_one(texts, entry));
}

const makes_one = (texts: Texts, entry: WrittenEntry): boolean =>
  said_in(texts, entry, "override") !== "true" && said_in(texts, entry, "remove") !== "true";

function unknown_one(texts: Texts, entry: WrittenEntry): Component {
  const { name, file, line } = entry;
  const column = /^ */.exec((texts.get(file) ?? "").split("\n")[line - 1] ?? "")![0].length + 1;
  return {
    name, file, line, column, model: model_of(texts, entry), activity: { kind: "sequential" }, unknown: true,
    properties: [], inputs: [], outputs: [], port_arrays: [], operations: [], events: [], requirements: [],
  };
}
