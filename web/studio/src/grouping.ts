// SPDX-License-Identifier: Apache-2.0
// Several boxes as the parts of one, and back.
import type { Box } from "./graph.ts";
import { free_name } from "./free_name.ts";
import { on_grid } from "./layout.ts";
import { change, edit, project } from "./project.ts";
import { known_places } from "./remembered.ts";
import { scene, taken_names } from "./scene.ts";
import { selection } from "./selection.ts";

const selected = (): Box[] => scene().boxes.filter((box) => selection.get().boxes.includes(box.id));

/** Parts of a composite belong to its definition: only boxes of the application are grouped. */
export const may_group = (): boolean => selection.get().path.length === 0 && selected().length > 1;

/** The selected boxes become the parts of a composite, whose box stands in the middle of them. */
export async function group_selected(): Promise<void> {
  if (!may_group()) return;
  const boxes = selected();
  const name = free_name("Group", taken_names());
  const changes = [change("group", name, ...boxes.map((box) => box.edited)), ...placed_in_the_middle(name, boxes)];
  if (!(await edit(changes, { field: "canvas", file: boxes.find((box) => box.file)?.file }))) return;
  selection.set({ boxes: [name], wires: [], port: undefined });
}

function placed_in_the_middle(name: string, boxes: Box[]): ReturnType<typeof change>[] {
  const places = known_places(boxes, project.get().places);
  const known = boxes.flatMap((box) => places.get(box.id) ?? []);
  const count = known.length / 2;
  if (count === 0) return [];
  const middle = (offset: number) => on_grid(known.filter((_, i) => i % 2 === offset).reduce((sum, one) => sum + one, 0) / count);
  return [change("place", name, String(middle(0)), String(middle(1)))];
}

export const may_dissolve = (box: Box): boolean => box.composite && selection.get().path.length === 0 && box.names.length === 1;

/** The parts of a composite become boxes beside it. */
export async function dissolve(box: Box): Promise<void> {
  if (await edit([change("dissolve", box.edited)], { field: "canvas", file: box.file })) selection.set({ boxes: [], wires: [], port: undefined });
}

export async function dissolve_selected(): Promise<void> {
  const [box, ...others] = selected();
  if (box && others.length === 0 && may_dissolve(box)) await dissolve(box);
}

/** `3` or `3..5` of a stacked box gets a box of its own. */
export async function split(box: Box, part: string, field: string): Promise<boolean> {
  const done = await edit([change("split", box.edited, part)], { field, file: box.file });
  if (done) selection.set({ boxes: [], wires: [], port: undefined });
  return done;
}
