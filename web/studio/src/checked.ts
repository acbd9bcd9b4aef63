// SPDX-License-Identifier: Apache-2.0
// What `armature check --json` and `armature models --json` print (docs/check_json.md).

export type Severity = "error" | "warning" | "note";

/** A place in a file; lines and columns from 1, columns in bytes. */
export interface Place {
  file?: string;
  line?: number;
  column?: number;
}

/** The bytes of `found`, which stand at that place, become `by`. */
export interface Fix {
  file: string;
  line: number;
  column: number;
  found: string;
  by: string;
}

export interface Diagnostic extends Place {
  severity: Severity;
  message: string;
  hint?: string;
  name?: string;
  likewise?: { count: number; first: string; last: string };
  not_shown?: number;
  fix?: Fix;
}

export interface Property {
  name: string;
  type: string;
  unit: string;
  unit_property?: string;   ///< which names the unit, where one does
  doc: string;
  value?: string;
  default?: string;
  values?: string[];
  range?: [number | null, number | null];
  persistent: boolean;
  mandatory: boolean;
  changeable_while_running: boolean;
  by_operator?: boolean;   ///< a word of the operator
}

export interface Port {
  name: string;
  type: string;
  unit: string;
  doc: string;
  size?: number;
  triggers?: boolean;
  may_stay_open?: boolean;
}

export interface Argument {
  name: string;
  type: string;
}

export interface Operation {
  name: string;
  signature: string;
  arguments: Argument[];
  result: string;
  doc: string;
  command: boolean;
  by_operator: boolean;
}

export interface EventMember {
  name: string;
  signature: string;
  arguments: Argument[];
  doc: string;
}

export interface Requirement {
  name: string;
  kind: "event" | "command" | "operation";
  signature: string;
  doc: string;
  optional: boolean;
}

export interface Members {
  properties: Property[];
  inputs: Port[];
  outputs: Port[];
  port_arrays: { name: string; count: string }[];
  operations: Operation[];
  events: EventMember[];
  requirements: Requirement[];
}

export interface Activity {
  kind: string;
  period_ns?: number;
  scheduler?: string;
  priority?: number;
}

export interface Component extends Place, Members {
  name: string;
  model: string;
  activity: Activity;
  thread?: string;
  unknown?: boolean;   ///< the check says nothing of it: its model is not known, or the entry has a mistake
}

export interface Connection extends Place {
  kind: "data" | "event" | "operation" | "command";
  from: string;
  to: string;
  triggers?: boolean;
  delayed?: boolean;
  crosses_threads?: boolean;
}

export interface Checked {
  file: string;
  application: string;
  ok: boolean;
  errors: number;
  diagnostics: Diagnostic[];
  components: Component[];
  connections: Connection[];
  threads: { name: string; activity: Activity; order: string[] }[];
  modes: { name: string; initial: boolean }[];
}

/** What the check says of a file that has no components yet, and of nothing else. */
export const has_nothing_yet = ({ components, errors, diagnostics }: Checked): boolean =>
  components.length === 0 && errors === 1 && diagnostics.some(({ severity, message }) => severity === "error" && message === "the file has no components");

/** How large a part of an application a model is (paper 4, II.A). */
export type Granularity = "application" | "composite" | "algorithm" | "atomic";

export interface Model extends Members {
  name: string;
  library: string;
  doc: string;
  granularity: Granularity;
  face: string;         ///< how it is drawn while it runs; empty: as its box
  most_calls?: number;  ///< that it takes under `calls`; absent: none
}

/** An end that a connection could lead to. */
export interface End {
  component: string;
  member: string;
  kind: "input" | "output" | "event" | "command";
  why_not?: string;
}

export interface Fitting {
  ends: End[];
  models?: End[];
}

/** The model that connections which turn an event into a command are built as. */
export const kEventCommand = "EventCommand";

/** `Joint1.act` as ["Joint1", "act"]; the component may have dots itself. */
export function split_member(path: string): [string, string] {
  const dot = path.lastIndexOf(".");
  return [path.slice(0, dot), path.slice(dot + 1)];
}

/** `every 10 ms, priority 70`. */
export function activity_text(activity: Activity): string {
  if (activity.kind !== "periodic") return activity.kind;
  const period = `every ${duration_text(activity.period_ns ?? 0)}`;
  return activity.scheduler === "realtime" ? `${period}, priority ${activity.priority}` : period;
}

export function duration_text(nanoseconds: number): string {
  if (nanoseconds >= 1e9) return `${nanoseconds / 1e9} s`;
  if (nanoseconds >= 1e6) return `${nanoseconds / 1e6} ms`;
  return `${nanoseconds / 1e3} us`;
}
