// SPDX-License-Identifier: Apache-2.0
// Modes of the deployment: which components run together. What no mode names runs in all.
import type { Box } from "./graph.ts";
import { items_of, map_of, section_of, unquoted } from "./flow_text.ts";
import { entries_of, is_made_by, type Texts } from "./written.ts";

export interface Mode {
  name: string;
  file: string;          ///< that has the last word on it
  components: string[];  ///< as written
}

/** In the order in which the files are read: included ones first. @param texts  the deployment's own file is the first */
export function modes_of(texts: Texts): Mode[] {
  const found = new Map<string, Mode>();
  for (const [file, text] of [...texts].reverse()) {
    for (const [name, list] of map_of(section_of(text, "modes"))) found.set(name, { name, file, components: items_of(list).map(unquoted) });
  }
  return [...found.values()];
}

const has = (mode: Mode, component: string): boolean =>
  mode.components.some((one) => is_made_by(one, component) || component.startsWith(`${one}.`));

/** Whether none of the box's components runs in the mode; never if it is empty. */
export function is_off(box: Box, modes: readonly Mode[], shown: string): boolean {
  const mode = modes.find((one) => one.name === shown);
  if (!mode || box.opened) return false;
  return box.components.every(({ name }) => !has(mode, name) && modes.some((one) => has(one, name)));
}

/** Whether an entry, as it is written, stands in the mode. */
export const names_entry = (mode: Mode, entry: string): boolean => mode.components.includes(entry);

/** Entries of the files, and whatever modes name beside them; those that modes name come first. */
export function rows_of(texts: Texts, modes: readonly Mode[]): string[] {
  const named = new Set(modes.flatMap((one) => one.components));
  return [...new Set([...named, ...entries_of(texts).map((one) => one.name)])];
}
