// SPDX-License-Identifier: Apache-2.0
// What a component calls that calls what it is told (docs/controls.md).
import type { Checked, Component, Operation } from "./checked.ts";
import { type Parameter, parameters_of_command } from "./event_command.ts";
import { flow_of, items_of, map_of, said_in, unquoted } from "./flow_text.ts";
import type { Box } from "./graph.ts";
import type { Texts } from "./written.ts";

export interface Call {
  to: string;    ///< as written: `Vision.start`
  with: string;  ///< its parameters, as written: `{low: 10}`; empty: none
}

export function calls_of(texts: Texts, { file, line, title }: Box): Call[] {
  if (!file || !line) return [];
  return items_of(said_in(texts, { name: title, file, line }, "calls")).map(call_of);
}

function call_of(text: string): Call {
  if (!text.startsWith("{")) return { to: unquoted(text), with: "" };
  const map = map_of(text);
  return { to: unquoted(map.get("call") ?? ""), with: map.get("with") ?? "" };
}

/** As an edit takes them: `[Vision.initialize, {call: Vision.setThreshold, with: {low: 10}}]`. */
export function calls_text(calls: readonly Call[]): string {
  const texts = calls.map((one) => (one.with ? `{call: ${one.to}, with: ${flow_of(one.with)}}` : one.to));
  return `[${texts.join(", ")}]`;
}

/** With the call at `index` moved by so many places. */
export function moved<Item>(items: readonly Item[], index: number, by: number): Item[] {
  const rest = items.filter((_, i) => i !== index);
  return [...rest.slice(0, index + by), items[index]!, ...rest.slice(index + by)];
}

/** Of components beside those of the box; a part of a composite calls its neighbours by their own names. */
export function callable(checked: Checked, box: Box): string[] {
  const scope = scope_of(box);
  const others = checked.components.filter((one) => one.name.startsWith(scope) && !box.names.includes(one.name));
  return others.flatMap((one) => plain(one).map(({ name }) => `${one.name.slice(scope.length)}.${name}`));
}

/** Acts of the operator are none that another component may do. */
const plain = ({ operations }: Component): Operation[] => (operations ?? []).filter((one) => !one.by_operator);

const scope_of = ({ names }: Box): string => names[0]!.slice(0, names[0]!.lastIndexOf(".") + 1);

export const parameters_of_call = (checked: Checked, box: Box, call: Call): Parameter[] =>
  parameters_of_command(checked, scope_of(box) + call.to, call.with ? `with: ${call.with}` : "");
