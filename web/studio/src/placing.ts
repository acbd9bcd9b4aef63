// SPDX-License-Identifier: Apache-2.0
// Where boxes are on the canvas: where somebody put them, laid out, or in lanes of their threads.
import { size_of } from "./geometry.ts";
import type { Graph } from "./graph.ts";
import { type LaidLanes, laid_in_lanes } from "./lanes.ts";
import { first_free, layout, type LayoutNode, on_grid, type Point } from "./layout.ts";
import { project } from "./project.ts";
import { known_places, remember } from "./remembered.ts";

export const kMostWithPorts = 300;
const kBehind = 48;  ///< between an event and what is opened of it

const nodes_of = (graph: Graph): LayoutNode[] => graph.boxes.map((box) => ({ id: box.id, ...size_of(box, graph.boxes.length <= kMostWithPorts) }));

/** Data first, so that it is that which flows to the right. */
function flow_of(graph: Graph): (readonly [string, string])[] {
  const leading = (data: boolean) => graph.wires.filter((wire) => (wire.kind === "data") === data).map((wire) => [wire.from.box, wire.to.box] as const);
  return [...leading(true), ...leading(false)];
}

export function places_of(graph: Graph, places: ReadonlyMap<string, Point>): Map<string, Point> {
  const known = known_places(graph.boxes, places);
  const opened = graph.boxes.filter((box) => box.opened && !known.has(box.id)).map(({ id }) => id);
  const nodes = nodes_of(graph);
  const laid = layout(nodes.filter(({ id }) => !opened.includes(id)), flow_of(graph), known);
  for (const id of opened) place_opened(id, nodes, graph, laid);
  remember(graph.boxes, laid);
  return laid;
}

/** Behind the event that commands, without another place for anything else. */
function place_opened(id: string, nodes: LayoutNode[], graph: Graph, laid: Map<string, Point>): void {
  const node = nodes.find((one) => one.id === id)!;
  const event = graph.wires.find((wire) => wire.kind === "command" && wire.to.box === id)?.from.box ?? "";
  const [x, y] = laid.get(event) ?? [0, 0];
  const width = nodes.find((one) => one.id === event)?.width ?? 0;
  const taken = nodes.flatMap((one) => (laid.has(one.id) ? { node: one, at: laid.get(one.id)! } : []));
  laid.set(id, first_free(node, [on_grid(x + width + kBehind), y], taken));
}

export function lanes_of(graph: Graph): LaidLanes {
  const threads = (project.get().shown?.threads ?? []).map(({ name }) => name);
  return laid_in_lanes(nodes_of(graph), flow_of(graph), threads, (id) => graph.boxes.find((box) => box.id === id)?.thread ?? "");
}
