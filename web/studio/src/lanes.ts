// SPDX-License-Identifier: Apache-2.0
// Boxes in lanes, one below the other: a lane for each thread.
import { layout, type LayoutNode, on_grid, type Point } from "./layout.ts";

export interface Lane {
  title: string;
  number: number;   ///< of the thread's colour; -1: boxes of several threads, or of none
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface LaidLanes {
  places: Map<string, Point>;
  lanes: Lane[];
}

const kRoom = 24;     ///< between the boxes and their lane's edge
const kTitle = 32;
const kGap = 16;
const kColumn = 64;   ///< between columns of boxes that are alone
const kRow = 24;
type Edges = readonly (readonly [string, string])[];
const kOthers = "several threads, or none";

/** @param thread_of  the thread of a box; empty: several, or none */
export function laid_in_lanes(
  nodes: LayoutNode[], edges: Edges, threads: readonly string[], thread_of: (id: string) => string,
): LaidLanes {
  const places = new Map<string, Point>();
  const lanes: Lane[] = [];
  for (const thread of [...threads, ""]) {
    const own = nodes.filter((node) => lane_of(thread_of(node.id), threads) === thread);
    if (own.length === 0) continue;
    const y = lanes.length === 0 ? 0 : lanes.at(-1)!.y + lanes.at(-1)!.height + kGap;
    lanes.push({ title: thread || kOthers, number: threads.indexOf(thread), x: 0, y, ...place(own, edges, y, places) });
  }
  const width = Math.max(0, ...lanes.map((lane) => lane.width));
  return { places, lanes: lanes.map((lane) => ({ ...lane, width })) };
}

const lane_of = (thread: string, threads: readonly string[]): string => (threads.includes(thread) ? thread : "");

/** Lays out the boxes of a lane that begins at `y`. @return the lane's size */
function place(own: LayoutNode[], edges: Edges, y: number, places: Map<string, Point>): { width: number; height: number } {
  const ids = new Set(own.map((node) => node.id));
  const inner = edges.filter(([from, to]) => from !== to && ids.has(from) && ids.has(to));
  const flowing = own.filter(({ id }) => inner.some((edge) => edge.includes(id)));
  const laid = layout(flowing, inner);
  place_beside(own.filter((node) => !flowing.includes(node)), extent(flowing, laid), laid);
  const { left, top, right, bottom } = extent(own, laid);
  for (const [id, [x, at]] of laid) places.set(id, [on_grid(x - left + kRoom), on_grid(y + at - top + kTitle)]);
  return { width: right - left + 2 * kRoom, height: bottom - top + kTitle + kRoom };
}

interface Extent {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

function extent(nodes: LayoutNode[], places: ReadonlyMap<string, Point>): Extent {
  if (nodes.length === 0) return { left: 0, top: 0, right: -kColumn, bottom: 0 };
  const all = nodes.map(({ id, width, height }) => ({ at: places.get(id)!, width, height }));
  return {
    left: Math.min(...all.map(({ at }) => at[0])), top: Math.min(...all.map(({ at }) => at[1])),
    right: Math.max(...all.map(({ at, width }) => at[0] + width)), bottom: Math.max(...all.map(({ at, height }) => at[1] + height)),
  };
}

/** Boxes that nothing in their lane leads to, in columns no higher than the others. */
function place_beside(alone: LayoutNode[], { top, right, bottom }: Extent, places: Map<string, Point>): void {
  let [x, y, widest] = [right + kColumn, top, 0];
  for (const { id, width, height } of alone) {
    if (y > top && y + height > bottom) [x, y, widest] = [x + widest + kColumn, top, 0];
    places.set(id, [x, y]);
    y += height + kRow;
    widest = Math.max(widest, width);
  }
}
