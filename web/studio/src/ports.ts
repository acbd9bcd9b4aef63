// SPDX-License-Identifier: Apache-2.0
// The ports that a box shows.
import { type Component, type Connection, type Port, split_member } from "./checked.ts";
import type { BoxPort, EndKind } from "./graph.ts";

type Ports = { inputs: BoxPort[]; outputs: BoxPort[] };

/** An array of ports that nothing uses, or one entry does, is one port on the canvas. */
const kMostLoosePorts = 4;

interface Member {
  name: string;
  kind: EndKind;
  type: string;
  unit: string;
  size?: number;
  doc: string;
  triggers: boolean;
  may_stay_open: boolean;
}

const of_port = (kind: EndKind) => (port: Port): Member => ({
  name: port.name, kind, type: port.type, unit: port.unit, size: port.size, doc: port.doc, triggers: port.triggers ?? false,
  may_stay_open: port.may_stay_open ?? false,
});

function members_of(component: Component): { inputs: Member[]; outputs: Member[] } {
  const commands = (component.operations ?? []).filter((one) => one.command);
  const events = component.events ?? [];
  const plain = (kind: EndKind) => (one: { name: string; signature: string; doc: string }): Member => ({
    name: one.name, kind, type: one.signature, unit: "", doc: one.doc, triggers: false, may_stay_open: true,
  });
  return {
    inputs: [...(component.inputs ?? []).map(of_port("input")), ...commands.map(plain("command"))],
    outputs: [...(component.outputs ?? []).map(of_port("output")), ...events.map(plain("event"))],
  };
}

/** @param written  the box's name as an edit has it: `Joint{i}` */
export function ports_of_component(components: Component[], written: string, connections: Connection[]): Ports {
  const first = components[0]!;
  const members = members_of(first);
  const arrays = arrays_shown_as_one(first, connections);
  const port = (member: Member): BoxPort => ({
    ...member,
    id: `${member.kind}:${member.name}`,
    count: 1,
    ends: components.map((one) => `${one.name}.${member.name}`),
    written: `${written}.${member.name}`,
  });
  const side = (all: Member[]): BoxPort[] => {
    const shown: BoxPort[] = [];
    for (const member of all) {
      const array = arrays.find((one) => one.members.includes(member.name));
      if (!array) shown.push(port(member));
      else if (array.members[0] === member.name) shown.push(as_one(port(member), array, components, written));
    }
    return shown;
  };
  return { inputs: side(members.inputs), outputs: side(members.outputs) };
}

interface PortArray {
  name: string;
  members: string[];
}

function as_one(first: BoxPort, array: PortArray, components: Component[], written: string): BoxPort {
  const count = array.members.length;
  return {
    ...first,
    id: `${first.kind}:${array.name}`,
    name: `${array.name}1…${count}`,
    count,
    ends: components.flatMap((one) => array.members.map((member) => `${one.name}.${member}`)),
    written: `${written}.${array.name}{i}`,
  };
}

/** `Ref1`, `Ref2` of the array `Ref`. */
export function array_members(component: Component, array: string): string[] {
  const names = [...(component.inputs ?? []), ...(component.outputs ?? [])].map((port) => port.name);
  return names.filter((one) => one.startsWith(array) && /^\d+$/.test(one.slice(array.length)));
}

function arrays_shown_as_one(component: Component, connections: Connection[]): PortArray[] {
  return (component.port_arrays ?? [])
    .map(({ name }) => ({ name, members: array_members(component, name) }))
    .filter((array) => array.members.length > 1 && is_used_as_one(component.name, array, connections));
}

function is_used_as_one(component: string, array: PortArray, connections: Connection[]): boolean {
  const places: Map<string, Set<string>> = new Map();
  for (const one of connections) {
    for (const [owner, member] of [split_member(one.from), split_member(one.to)]) {
      if (owner !== component || !array.members.includes(member)) continue;
      const place = `${one.file}:${one.line}:${one.column}`;
      places.set(place, (places.get(place) ?? new Set()).add(member));
    }
  }
  if (places.size === 0) return array.members.length > kMostLoosePorts;
  return [...places.values()].every((members) => members.size === array.members.length);
}

/** Of a composite: what it exports, and what a connection leads to from outside. */
export function ports_of_parts(
  parts: { component: Component; path: string }[], instances: string[], written: string, exported: Map<string, string>,
  connections: Connection[],
): Ports {
  const outside = crossing(new Set(parts.map((one) => one.component.name)), instances, connections);
  const ports: Ports = { inputs: [], outputs: [] };
  const first = parts.filter((one) => one.component.name.startsWith(`${instances[0]}.`));
  for (const { component, path } of first) {
    const members = members_of(component);
    for (const side of ["inputs", "outputs"] as const) {
      for (const member of members[side]) {
        const inner = `${path}.${member.name}`;
        const ends = instances.map((one) => `${one}.${inner}`);
        const name = exported.get(inner);
        if (!name && !ends.some((end) => outside.has(end))) continue;
        ports[side].push({
          ...member, id: `${member.kind}:${inner}`, name: name ?? inner, count: 1, ends, written: `${written}.${name ?? inner}`,
        });
      }
    }
  }
  return ports;
}

/** Ends inside that are connected with something outside of their own instance. */
function crossing(inside: Set<string>, instances: string[], connections: Connection[]): Set<string> {
  const found = new Set<string>();
  const instance_of = (component: string) =>
    inside.has(component) ? instances.find((one) => component.startsWith(`${one}.`)) : undefined;
  for (const { kind, from, to } of connections) {
    if (kind !== "data") continue;
    const begin = instance_of(split_member(from)[0]);
    const end = instance_of(split_member(to)[0]);
    if (begin === end) continue;
    if (begin) found.add(from);
    if (end) found.add(to);
  }
  return found;
}
