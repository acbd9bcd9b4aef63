// SPDX-License-Identifier: Apache-2.0
// Places for boxes without one: layers by the longest way of the data, each ordered by the mean of
// its neighbours.

export interface LayoutNode {
  id: string;
  width: number;
  height: number;
}

export type Point = [number, number];
type Edge = readonly [string, string];

const kGrid = 8;
const kGapX = 88;
const kGapY = 32;
const kGapBand = 72;
const kShape = 1.6;       ///< width by height that is wanted
const kMostWidth = 1400;  ///< of a row; it is easier to read than several
const kSweeps = 8;

export const on_grid = (value: number): number => Math.round(value / kGrid) * kGrid;

/** A place for each node; those in `fixed` keep theirs, and nothing is laid over them. */
export function layout(nodes: LayoutNode[], edges: Edge[], fixed: ReadonlyMap<string, Point> = new Map()): Map<string, Point> {
  const connected = new Set(edges.filter(([from, to]) => from !== to).flat());
  const flowing = nodes.filter((node) => connected.has(node.id));
  const alone = nodes.filter((node) => !connected.has(node.id));
  const places = new Map<string, Point>();
  const bottom = place_bands(ordered(layers_of(flowing, edges), edges), edges, places);
  place_rows(alone, flowing.length > 0 ? bottom + 2 * kGapY : 0, places);
  return keep_fixed(nodes, places, fixed);
}

/** Edges without those that close a circle, found by a walk along them. */
function without_circles(nodes: LayoutNode[], edges: Edge[]): Edge[] {
  const after = followers(nodes, edges);
  const state = new Map<string, "open" | "done">();
  const kept: Edge[] = [];
  for (const { id: root } of by_entry(nodes, edges)) {
    if (state.has(root)) continue;
    const walk: { id: string; next: number }[] = [{ id: root, next: 0 }];
    state.set(root, "open");
    while (walk.length > 0) {
      const here = walk[walk.length - 1]!;
      const to = after.get(here.id)![here.next++];
      if (to === undefined) {
        state.set(here.id, "done");
        walk.pop();
      } else if (state.get(to) !== "open") {
        kept.push([here.id, to]);
        if (!state.has(to)) {
          state.set(to, "open");
          walk.push({ id: to, next: 0 });
        }
      }
    }
  }
  return kept;
}

/** Those first into which nothing leads. */
function by_entry(nodes: LayoutNode[], edges: Edge[]): LayoutNode[] {
  const entered = new Set(edges.map(([, to]) => to));
  return [...nodes.filter((node) => !entered.has(node.id)), ...nodes.filter((node) => entered.has(node.id))];
}

function followers(nodes: LayoutNode[], edges: Edge[]): Map<string, string[]> {
  const after = new Map<string, string[]>(nodes.map((node) => [node.id, []]));
  for (const [from, to] of edges) {
    if (from !== to && after.has(to)) after.get(from)?.push(to);
  }
  return after;
}

function layers_of(nodes: LayoutNode[], edges: Edge[]): LayoutNode[][] {
  const kept = without_circles(nodes, edges);
  const after = followers(nodes, kept);
  const open = new Map<string, number>(nodes.map((node) => [node.id, 0]));
  for (const [, to] of kept) open.set(to, open.get(to)! + 1);
  const layer = new Map<string, number>(nodes.map((node) => [node.id, 0]));
  const ready = nodes.filter((node) => open.get(node.id) === 0).map((node) => node.id);
  for (let id = ready.pop(); id !== undefined; id = ready.pop()) {
    for (const to of after.get(id)!) {
      layer.set(to, Math.max(layer.get(to)!, layer.get(id)! + 1));
      open.set(to, open.get(to)! - 1);
      if (open.get(to) === 0) ready.push(to);
    }
  }
  const layers: LayoutNode[][] = [];
  for (const node of nodes) (layers[layer.get(node.id)!] ??= []).push(node);
  return layers;
}

function neighbours(edges: Edge[]): Map<string, string[]> {
  const found = new Map<string, string[]>();
  const add = (a: string, b: string) => found.set(a, [...(found.get(a) ?? []), b]);
  for (const [from, to] of edges) {
    add(from, to);
    add(to, from);
  }
  return found;
}

function ordered(layers: LayoutNode[][], edges: Edge[]): LayoutNode[][] {
  const near = neighbours(edges);
  const rank = new Map<string, number>();
  const number_layer = (layer: LayoutNode[]) => layer.forEach((node, i) => rank.set(node.id, (i + 0.5) / layer.length));
  layers.forEach(number_layer);
  const mean = (node: LayoutNode) => {
    const ranks = (near.get(node.id) ?? []).map((id) => rank.get(id) ?? 0);
    return ranks.reduce((sum, one) => sum + one, 0) / Math.max(1, ranks.length);
  };
  for (let sweep = 0; sweep < kSweeps; ++sweep) {
    for (const layer of sweep % 2 === 0 ? layers : [...layers].reverse()) {
      const means = new Map(layer.map((node) => [node.id, mean(node)]));
      layer.sort((a, b) => means.get(a.id)! - means.get(b.id)!);
      number_layer(layer);
    }
  }
  return layers;
}

const height_of = (layer: LayoutNode[]): number => layer.reduce((sum, node) => sum + node.height + kGapY, -kGapY);
const width_of = (layer: LayoutNode[]): number => Math.max(0, ...layer.map((node) => node.width)) + kGapX;

/** A series of layers that is far wider than high is continued below; returns where the lowest ends. */
function place_bands(layers: LayoutNode[][], edges: Edge[], places: Map<string, Point>): number {
  const near = neighbours(edges);
  const width = layers.reduce((sum, layer) => sum + width_of(layer), 0);
  const height = Math.max(1, ...layers.map(height_of));
  const bands = Math.sqrt(width / (kShape * (height + kGapBand)));
  const length = Math.ceil(layers.length / (width < kMostWidth ? 1 : Math.max(1, Math.round(bands))));
  let top = 0;
  for (let begin = 0; begin < layers.length; begin += length) {
    top = place_layers(layers.slice(begin, begin + length), near, top, places) + kGapBand;
  }
  return Math.max(0, top - kGapBand);
}

/** Places the layers beside each other, each centred; returns where the lowest box ends. */
function place_layers(layers: LayoutNode[][], near: Map<string, string[]>, top: number, places: Map<string, Point>): number {
  const tallest = Math.max(0, ...layers.map(height_of));
  let x = 0;
  for (const layer of layers) {
    let y = top + (tallest - height_of(layer)) / 2;
    let left = height_of(layer);
    for (const node of layer) {
      const lowest = top + tallest - left;
      y = Math.max(y, Math.min(wanted_y(node, near, places), lowest));
      places.set(node.id, [on_grid(x), on_grid(y)]);
      y += node.height + kGapY;
      left -= node.height + kGapY;
    }
    x += width_of(layer);
  }
  return top + tallest;
}

/** The mean height of those neighbours that have a place already. */
function wanted_y(node: LayoutNode, near: Map<string, string[]>, places: Map<string, Point>): number {
  const known = (near.get(node.id) ?? []).flatMap((id) => places.get(id)?.[1] ?? []);
  return known.length === 0 ? 0 : known.reduce((sum, one) => sum + one, 0) / known.length;
}

function place_rows(nodes: LayoutNode[], top: number, places: Map<string, Point>): void {
  const columns = Math.max(1, Math.ceil(Math.sqrt(nodes.length * 1.5)));
  let y = top;
  for (let begin = 0; begin < nodes.length; begin += columns) {
    const row = nodes.slice(begin, begin + columns);
    let x = 0;
    for (const node of row) {
      places.set(node.id, [on_grid(x), on_grid(y)]);
      x += node.width + kGapX;
    }
    y += Math.max(...row.map((node) => node.height)) + kGapY;
  }
}

function keep_fixed(nodes: LayoutNode[], places: Map<string, Point>, fixed: ReadonlyMap<string, Point>): Map<string, Point> {
  const taken: { node: LayoutNode; at: Point }[] = [];
  for (const node of nodes) {
    const at = fixed.get(node.id);
    if (at) taken.push({ node, at });
  }
  if (taken.length === 0) return places;
  const found = new Map<string, Point>(taken.map(({ node, at }) => [node.id, at]));
  for (const node of nodes) {
    if (found.has(node.id)) continue;
    const at = first_free(node, places.get(node.id)!, taken);
    found.set(node.id, at);
    taken.push({ node, at });
  }
  return found;
}

/** The place, or the first below it where the node covers none of the others. */
export function first_free(node: LayoutNode, [x, wanted]: Point, taken: { node: LayoutNode; at: Point }[]): Point {
  let y = wanted;
  const covered = () => taken.find(({ node: other, at }) =>
    x < at[0] + other.width && at[0] < x + node.width && y < at[1] + other.height && at[1] < y + node.height);
  for (let other = covered(); other; other = covered()) y = on_grid(other.at[1] + other.node.height + kGapY);
  return [x, y];
}
