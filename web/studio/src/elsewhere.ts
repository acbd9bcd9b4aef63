// SPDX-License-Identifier: Apache-2.0
// An application that runs elsewhere: it is watched and operated, and nothing of it is edited.
import type { Change } from "./backend.ts";
import { project } from "./project.ts";

/** Its address; empty: a deployment's file is open. */
export const useElsewhere = (): string => project.use((all) => all.state.elsewhere);

export const is_elsewhere = (): boolean => Boolean(project.get().state.elsewhere);

export const why_fixed = (address: string): string => `This application runs at ${address}: open its file to change it.`;

/** Where boxes are, and what moves robots, is this page's own there. @return whether that is all that was to change */
export function keep_here(changes: Change[]): boolean {
  if (!changes.every(({ edit }) => edit === "place" || edit === "robot")) return false;
  const places = new Map(project.get().places);
  const robots = new Map(project.get().robots);
  for (const { edit, words: [name, first, second] } of changes) {
    if (edit === "place") places.set(name!, [Number(first), Number(second)]);
    else if (first) robots.set(name!, first);
    else robots.delete(name!);
  }
  project.set({ places, robots });
  return true;
}
