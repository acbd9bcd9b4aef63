// SPDX-License-Identifier: Apache-2.0
// What fits by its name alone, where there is only one of that name: wires of open inputs, and peers that have
// what a component hears or calls.
import type { Component, Requirement } from "./checked.ts";
import type { Box, BoxPort, Graph } from "./graph.ts";
import { array_members } from "./ports.ts";

/** Two ends as an edit names them. */
export type Pair = [string, string];

/** A port of a box, or an array of them: all that one written connection can lead to. */
interface Socket {
  box: string;
  name: string;
  written: string;
  first: BoxPort;
  ends: string[];
}

function sockets_of(box: Box, ports: BoxPort[]): Socket[] {
  const found = new Map<string, Socket>();
  for (const port of ports) {
    if (port.kind !== "input" && port.kind !== "output") continue;
    const array = array_of(box, port);
    const name = array ?? port.name;
    const known = found.get(name);
    if (known) known.ends.push(...port.ends);
    else found.set(name, { box: box.id, name, written: array ? in_array(port, array) : port.written, first: port, ends: [...port.ends] });
  }
  return [...found.values()];
}

/** The array that a port of a single component is one of, or stands for. */
export function array_of(box: Box, port: BoxPort): string | undefined {
  if (box.components.length !== 1) return undefined;
  const member = port.ends[0]!.slice(port.ends[0]!.lastIndexOf(".") + 1);
  return box.components[0]!.port_arrays.find((array) => array_members(box.components[0]!, array.name).includes(member))?.name;
}

/** All of an array, as a connection of a range names them. */
export const in_array = (port: BoxPort, array: string): string => port.written.replace(/[^.]*$/, `${array}{i}`);

/** @param wanted  the boxes whose inputs or outputs are connected; all if it is empty */
export function wires_by_name(graph: Graph, wanted: readonly string[] = []): Pair[] {
  const taken = new Set(graph.wires.flatMap((wire) => wire.connections.map((one) => one.to)));
  const is_wanted = (one: Socket) => wanted.length === 0 || wanted.includes(one.box);
  const outputs = graph.boxes.flatMap((box) => sockets_of(box, box.outputs));
  const needed = (box: Box) => sockets_of(box, box.inputs.filter((port) => !port.may_stay_open));
  const open = graph.boxes.flatMap(needed).filter((one) => !one.ends.some((end) => taken.has(end)));
  return open.flatMap((input): Pair[] => {
    const [output, ...others] = outputs.filter((one) => fits(one, input));
    return output && others.length === 0 && (is_wanted(input) || is_wanted(output)) ? [[output.written, input.written]] : [];
  });
}

function fits(output: Socket, input: Socket): boolean {
  const [from, to] = [output.first, input.first];
  return output.box !== input.box && output.name === input.name && output.ends.length === input.ends.length && from.type === to.type &&
    from.unit === to.unit && (from.size === undefined || to.size === undefined || from.size === to.size);
}

/** Of the boxes of one file: which component each of them should know, as `[box, peer]`. */
export function peers_by_name(graph: Graph, served: ReadonlySet<string>, file: string, wanted: readonly string[] = []): Pair[] {
  const pairs = new Map<string, Pair>();
  for (const box of graph.boxes) {
    if (box.composite || box.file !== file || (wanted.length > 0 && !wanted.includes(box.id))) continue;
    for (const requirement of box.components[0]!.requirements) {
      if (served.has(`${box.names[0]}.${requirement.name}`)) continue;
      const peer = the_only_one(graph, box, requirement);
      if (peer) pairs.set(`${box.edited} ${peer}`, [box.edited, peer]);
    }
  }
  return [...pairs.values()];
}

function the_only_one(graph: Graph, box: Box, requirement: Requirement): string | undefined {
  const all = graph.boxes.filter((one) => one !== box && !one.composite).flatMap((one) => one.components);
  const [peer, ...others] = all.filter((one) => has(one, requirement));
  return others.length === 0 ? peer?.name : undefined;
}

function has(component: Component, { kind, name, signature }: Requirement): boolean {
  const same = (one: { name: string; signature: string }) => one.name === name && one.signature === signature;
  return kind === "event" ? component.events.some(same) : component.operations.some((one) => same(one) && one.command === (kind === "command"));
}
