// SPDX-License-Identifier: Apache-2.0
// What the canvas shows: a box per entry as written, a wire per written connection.
import { type Checked, type Component, type Connection, kEventCommand, type Place, split_member } from "./checked.ts";
import { ports_of_opened } from "./event_command.ts";
import { unknown_components } from "./unknown.ts";
import { ports_of_component, ports_of_parts } from "./ports.ts";
import {
  type Composite, composites_of, ends_at, entries_of, indexed, is_made_by, key_at, model_of, type Texts, type WrittenEntry,
} from "./written.ts";

export type EndKind = "input" | "output" | "event" | "command";

export interface BoxPort {
  id: string;  ///< unique in its box
  name: string;
  kind: EndKind;
  type: string;
  unit: string;
  size?: number;
  doc: string;
  triggers: boolean;
  may_stay_open: boolean;
  count: number;   ///< of an array that is shown as one
  ends: string[];  ///< `Component.member` of all that it stands for
  written: string; ///< as an edit names it
  /** Ends outside of the composite that is open, to which it is connected. */
  outside?: string[];
  /** Of a command, that an opened connection from an event gives. */
  parameter?: string;
}

export interface Box extends Place {
  id: string;       ///< as written, with the composites around it: `Joint{1..7}`, `Rover.left`
  edited: string;   ///< as edits name it: a part by its composite's definition, `Chassis.left`
  title: string;
  model: string;
  composite: boolean;
  names: string[];  ///< of its components, or of the composite's instances
  components: Component[];
  inputs: BoxPort[];
  outputs: BoxPort[];
  thread: string;
  /** Of an opened connection from an event to a command: its ends as written. */
  opened?: [string, string];
}

export interface Wire extends Place {
  id: string;
  between?: string;    ///< the component that stands for a connection from an event to a command
  parameter?: string;  ///< of the command, that the wire gives a value
  kind: "data" | "command";
  from: { box: string; port: string };
  to: { box: string; port: string };
  triggers: boolean;
  delayed: boolean;
  crosses_threads: boolean;
  written: [string, string];
  connections: Connection[];
}

export interface Graph {
  boxes: Box[];
  wires: Wire[];
  /** `Component.member` to its port. */
  ends: Map<string, { box: Box; port: BoxPort }>;
}

export const kNoGraph: Graph = { boxes: [], wires: [], ends: new Map() };

/** A component with what is left of its name below the composites that are open. */
interface Located {
  component: Component;
  outer: string;  ///< `Rover.`
  rest: string;   ///< `left`
}

/** What is below the composites `path`; all if it is empty. @param opened  connections from events to commands that are boxes */
export function graph_of(checked: Checked, texts: Texts, path: readonly string[], opened: readonly string[] = []): Graph {
  const builder = new Builder(checked, texts, opened);
  return builder.graph(path);
}

class Builder {
  private readonly entries: WrittenEntry[];
  private readonly composites: Composite[];

  private readonly checked: Checked;

  constructor(checked: Checked, private readonly texts: Texts, private readonly opened: readonly string[]) {
    this.checked = { ...checked, components: [...checked.components, ...unknown_components(checked, texts)] };
    this.entries = entries_of(texts);
    this.composites = composites_of(texts);
  }

  graph(path: readonly string[]): Graph {
    const boxes = this.boxes(this.below(path), path);
    const ends: Graph["ends"] = new Map();
    for (const box of boxes) {
      for (const port of [...box.inputs, ...box.outputs]) {
        for (const end of port.ends) ends.set(end, { box, port });
      }
    }
    if (path.length > 0) this.note_outside(ends);
    return { boxes, wires: this.wires(ends), ends };
  }

  /** Of wires that leave the composite the inner port tells where they lead. */
  private note_outside(ends: Graph["ends"]): void {
    for (const { connection: { from, to } } of this.with_event_commands()) {
      const port = (ends.get(from) ?? ends.get(to))?.port;
      if (port && ends.has(from) !== ends.has(to)) port.outside = [...new Set([...(port.outside ?? []), ends.has(from) ? to : from])];
    }
  }

  private below(path: readonly string[]): Located[] {
    let all: Located[] = this.checked.components
      .filter((component) => component.model !== kEventCommand || this.opened.includes(component.name))
      .map((component) => ({ component, outer: "", rest: component.name }));
    for (const step of path) all = all.filter((one) => this.instance_key(one) === step).map(descend);
    return all;
  }

  /** The written name of the composite that the component is in; empty if it is in none. */
  private instance_key({ rest, outer }: Located): string {
    const dot = rest.indexOf(".");
    if (dot < 0) return "";
    const name = rest.slice(0, dot);
    return outer ? name : this.entry_of(name)?.name ?? name;
  }

  private entry_of(name: string): WrittenEntry | undefined {
    const made = this.entries.filter((entry) => is_made_by(entry.name, name));
    return made.find((entry) => entry.name !== name) ?? made[0];
  }

  private own_key({ component, rest }: Located): string {
    const { file, line, column } = component;
    const key = file && line ? key_at(this.texts, file, line, column ?? 1) : "";
    return key && is_made_by(key, rest) ? key : rest;
  }

  private boxes(all: Located[], path: readonly string[]): Box[] {
    const groups = new Map<string, Located[]>();
    for (const one of all) {
      const key = this.instance_key(one) || this.own_key(one);
      const group = groups.get(key);
      if (group) group.push(one);
      else groups.set(key, [one]);
    }
    return [...groups].map(([key, group]) => this.box(key, group, path));
  }

  private box(key: string, group: Located[], path: readonly string[]): Box {
    const id = [...path, key].join(".");
    const composite = group[0]!.rest.includes(".");
    const edited = path.length > 0 ? this.edited(id, path) : id;
    return composite ? this.composite_box(id, edited, key, group) : this.component_box(id, edited, key, group);
  }

  /** A part belongs to the definition of its composite. */
  private edited(id: string, path: readonly string[]): string {
    const entry = this.entries.find((one) => one.name === path[0]);
    const model = entry ? model_of(this.texts, entry) : "";
    return model ? [model, ...path.slice(1), id.slice(path.join(".").length + 1)].join(".") : id;
  }

  private component_box(id: string, edited: string, title: string, group: Located[]): Box {
    const components = group.map((one) => one.component);
    const first = components[0]!;
    const { file, line, column, model } = first;
    const place = { file, line, column };
    if (model === kEventCommand) return this.opened_box(id, title, first);
    const ports = ports_of_component(components, indexed(edited), this.checked.connections);
    return {
      id, edited, title, model, composite: false, components, ...place, ...ports,
      names: components.map((one) => one.name), thread: first.thread ?? "",
    };
  }

  private opened_box(id: string, title: string, component: Component): Box {
    const { file, line, column, name, thread } = component;
    const { from, to } = this.event_command(component) ?? { from: "", to: "" };
    return {
      id, edited: id, title, model: kEventCommand, composite: false, components: [component], names: [name], file, line, column, thread: thread ?? "",
      opened: (file && line && ends_at(this.texts, file, line, column ?? 1)) || [from, to], ...ports_of_opened(component, this.checked, to, this.texts),
    };
  }

  private composite_box(id: string, edited: string, title: string, group: Located[]): Box {
    const entry = this.entries.find((one) => one.name === title);
    const model = entry ? model_of(this.texts, entry) : "";
    const names = [...new Set(group.map(({ outer, rest }) => outer + rest.slice(0, rest.indexOf("."))))];
    const parts = group.map(({ component, rest }) => ({ component, path: rest.slice(rest.indexOf(".") + 1) }));
    const exported = this.composites.find((one) => one.name === model)?.exports ?? new Map<string, string>();
    const ports = ports_of_parts(parts, names, indexed(edited), exported, this.checked.connections);
    const threads = new Set(group.map((one) => one.component.thread ?? ""));
    return {
      id, edited, title, model: model || "composite", composite: true, components: group.map((one) => one.component), names,
      file: entry?.file, line: entry?.line, thread: threads.size === 1 ? [...threads][0]! : "", ...ports,
    };
  }

  private wires(ends: Graph["ends"]): Wire[] {
    const wires = new Map<string, Wire>();
    for (const one of this.with_event_commands()) {
      const from = ends.get(one.connection.from);
      const to = ends.get(one.connection.to);
      if (!from || !to || (from.box === to.box && from.box.composite)) continue;
      this.add(one.connection, one.kind, from, to, wires);
    }
    return [...wires.values()];
  }

  private add(
    connection: Connection & { between?: string }, kind: Wire["kind"], from: { box: Box; port: BoxPort }, to: { box: Box; port: BoxPort },
    wires: Map<string, Wire>,
  ): void {
    const { file, line, column } = connection;
    const id = `${from.box.id}.${from.port.id} -> ${to.box.id}.${to.port.id} @${file ?? ""}:${line ?? 0}:${column ?? 0}`;
    const known = wires.get(id);
    if (known) {
      known.connections.push(connection);
      return;
    }
    const written = file && line ? ends_at(this.texts, file, line, column ?? 1) : undefined;
    wires.set(id, {
      id, kind, file, line, column,
      from: { box: from.box.id, port: from.port.id },
      to: { box: to.box.id, port: to.port.id },
      ...this.in_between(connection),
      triggers: connection.triggers ?? false,
      delayed: connection.delayed ?? false,
      crosses_threads: connection.crosses_threads ?? false,
      written: written ?? [from.port.written, to.port.written],
      connections: [connection],
    });
  }

  /** The component that stands for a connection from an event to a command, of the wires at it. */
  private in_between({ kind, from, to, between }: Connection & { between?: string }): Pick<Wire, "between" | "parameter"> {
    if (between) return { between };
    const [owner, member] = split_member(to);
    if (kind === "data" && this.opened.includes(owner)) return { between: owner, parameter: member };
    const of_event = this.opened.find((one) => owner === one || split_member(from)[0] === one);
    return of_event ? { between: of_event } : {};
  }

  /** Data connections, and those from an event to a command, which stand as components of their own. */
  private with_event_commands(): { connection: Connection & { between?: string }; kind: Wire["kind"] }[] {
    const found: { connection: Connection & { between?: string }; kind: Wire["kind"] }[] = [];
    const between = new Map(this.checked.components.filter((one) => one.model === kEventCommand).map((one) => [one.name, one]));
    for (const connection of this.checked.connections) {
      const owner = split_member(connection.to)[0];
      if (connection.kind === "data" && (!between.has(owner) || this.opened.includes(owner))) found.push({ connection, kind: "data" });
    }
    for (const one of between.values()) {
      const connection = this.event_command(one);
      if (!connection) continue;
      const { from, to } = connection;
      const ways = this.opened.includes(one.name) ? [{ from, to: `${one.name}.On` }, { from: `${one.name}.Do`, to }] : [{ from, to }];
      for (const way of ways) found.push({ connection: { ...connection, ...way }, kind: "command" });
    }
    return found;
  }

  private event_command(between: Component): (Connection & { between: string }) | undefined {
    const { name, file, line, column } = between;
    const all = this.checked.connections;
    const event = all.find((one) => one.kind === "event" && split_member(one.to)[0] === name);
    const command = all.find((one) => one.kind === "command" && split_member(one.from)[0] === name);
    const written = file && line ? ends_at(this.texts, file, line, column ?? 1) : undefined;
    const from = event?.from ?? written?.[0];
    const to = command?.to ?? written?.[1];
    if (!from || !to) return undefined;
    return { kind: "command", from, to, file, line, column, crosses_threads: command?.crosses_threads, between: name };
  }
}

function descend({ component, outer, rest }: Located): Located {
  const dot = rest.indexOf(".") + 1;
  return { component, outer: outer + rest.slice(0, dot), rest: rest.slice(dot) };
}
