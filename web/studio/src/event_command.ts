// SPDX-License-Identifier: Apache-2.0
// A connection by which an event commands, opened: a box with a pin for each parameter of the command.
import { type Checked, type Component, split_member } from "./checked.ts";
import type { BoxPort } from "./graph.ts";
import { is_flow_at, settings_at, split_flow, type Texts } from "./written.ts";

/** What `with:` in a connection's settings says, by parameter. */
export function given_in(settings: string): Map<string, string> {
  const found = new Map<string, string>();
  const list = /^with:\s*\{([\s\S]*)\}$/.exec(split_flow(settings).map((part) => part.trim()).find((part) => part.startsWith("with:")) ?? "")?.[1];
  for (const part of split_flow(list ?? "")) {
    const colon = part.indexOf(":");
    if (colon > 0) found.set(part.slice(0, colon).trim(), part.slice(colon + 1).trim());
  }
  return found;
}

/** The settings with another value of a parameter; without one it is the event's again. */
export function with_parameter(settings: string, name: string, value: string): string {
  const given = given_in(settings);
  if (value.trim()) given.set(name, value.trim());
  else given.delete(name);
  const others = split_flow(settings).map((part) => part.trim()).filter((part) => !part.startsWith("with:"));
  const list = [...given].map(([key, text]) => `${key}: ${text}`).join(", ");
  return [...others, ...(list ? [`with: {${list}}`] : [])].join(", ");
}

/** A parameter of the command, and where its value comes from. */
export interface Parameter {
  name: string;
  type: string;
  unit: string;
  given: string;  ///< a constant, a port, or a member of the event; empty: the event's of this name, or at its place
}

/** The parameters of the command `to`, as the entry at a place gives them. */
export function parameters_of_command(checked: Checked, to: string, settings: string): Parameter[] {
  const [owner, name] = split_member(to);
  const operation = checked.components.find((one) => one.name === owner)?.operations.find((one) => one.name === name);
  const given = given_in(settings);
  return (operation?.arguments ?? []).map(({ name: named, type }) => {
    const [, plain = named, unit = ""] = /^(\S+)(?:\s+\[(.*)\])?$/.exec(named) ?? [];
    return { name: plain, type, unit, given: given.get(plain) ?? "" };
  });
}

/** Whether the entry at a place is written so that its settings can be read and changed here. */
export const can_be_opened = (texts: Texts, { file, line, column }: { file?: string; line?: number; column?: number }): boolean =>
  file !== undefined && line !== undefined && is_flow_at(texts, file, line, column ?? 1);

/** The pins of an opened one. @param commanded  the command as `Component.name` */
export function ports_of_opened(between: Component, checked: Checked, commanded: string, texts: Texts): { inputs: BoxPort[]; outputs: BoxPort[] } {
  const { name, file = "", line = 0, column = 1 } = between;
  const settings = settings_at(texts, file, line, column);
  const pin = (kind: BoxPort["kind"], member: string, type: string, doc: string): BoxPort => ({
    id: `${kind}:${member}`, name: member, kind, type, unit: "", doc, triggers: false, may_stay_open: true, count: 1, ends: [`${name}.${member}`], written: `${name}.${member}`,
  });
  const fed = new Set(between.inputs.map((one) => one.name));
  const parameters = parameters_of_command(checked, commanded, settings).map((one): BoxPort => ({
    ...pin("input", one.name, one.type, "a parameter of the command"), unit: one.unit, parameter: one.name,
    ...(fed.has(one.name) ? {} : { outside: [one.given || "of the event"] }),
  }));
  return {
    inputs: [pin("command", "On", "", "the event that commands"), ...parameters],
    outputs: [pin("event", "Do", "", "the command that is given"), ...between.events.map((one) => pin("event", one.name, one.signature, one.doc))],
  };
}
