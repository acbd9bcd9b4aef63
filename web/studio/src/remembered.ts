// SPDX-License-Identifier: Apache-2.0
// Where boxes without a place were laid out: they stay there while the page is open, whatever is
// added beside them or connected.
import type { Box } from "./graph.ts";
import type { Point } from "./layout.ts";
import { Store } from "./store.ts";

const by_name = new Map<string, Point>();
const by_entry = new Map<string, Point>();

/** Counts how often all was forgotten. */
export const arrangements = new Store({ count: 0 });

const entry_of = (box: Box): string => `${box.file}:${box.line}:${box.column}`;

/** The places that are known: those of the project, then those from before. A renamed box is found by its entry. */
export function known_places(boxes: Box[], places: ReadonlyMap<string, Point>): Map<string, Point> {
  const known = new Map<string, Point>();
  for (const box of boxes) {
    const at = places.get(box.id) ?? by_name.get(box.id);
    if (at) known.set(box.id, at);
  }
  const taken = new Set([...known.values()].map(String));
  for (const box of boxes) {
    const at = by_entry.get(entry_of(box));
    if (!known.has(box.id) && box.line && at && !taken.has(String(at))) known.set(box.id, at);
  }
  return known;
}

export function remember(boxes: Box[], laid: ReadonlyMap<string, Point>): void {
  by_entry.clear();
  for (const box of boxes) {
    const at = laid.get(box.id)!;
    by_name.set(box.id, at);
    by_entry.set(entry_of(box), at);
  }
}

/** All boxes without a place are laid out anew. */
export function arrange(): void {
  by_name.clear();
  by_entry.clear();
  arrangements.set({ count: arrangements.get().count + 1 });
}
