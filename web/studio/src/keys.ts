// SPDX-License-Identifier: Apache-2.0
// Keys that work everywhere on the page.
import { emergency_stop } from "./emergency.ts";
import { dissolve_selected, group_selected } from "./grouping.ts";
import { redo, save, undo } from "./project.ts";
import { go_to_region } from "./regions.ts";
import { stop } from "./run.ts";
import { selection } from "./selection.ts";

/** Fields keep their own undo while somebody types in them. */
function is_typing(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && target.matches("input, textarea, select");
}

export function listen_to_keys(): () => void {
  document.addEventListener("keydown", on_key, true);
  return () => document.removeEventListener("keydown", on_key, true);
}

function on_key(event: KeyboardEvent): void {
  if (event.repeat && (event.key === "F8" || event.key === "Escape")) return; // one press is one stop
  const action = action_of(event);
  if (!action) return;
  event.preventDefault();
  event.stopPropagation();
  action();
}

function action_of(event: KeyboardEvent): (() => void) | undefined {
  if (event.key === "F8") return () => void emergency_stop();
  if (event.key === "F6") return () => go_to_region(event.shiftKey ? -1 : 1);
  if (event.key === "Escape") return event.shiftKey ? () => void stop() : close_menu();
  if (!event.ctrlKey && !event.metaKey) return undefined;
  const key = event.key.toLowerCase();
  if (key === "s") return () => void save();
  if (!["g", "y", "z"].includes(key) || is_typing(event.target)) return undefined;
  if (key === "g") return () => void (event.shiftKey ? dissolve_selected() : group_selected());
  return key === "y" || event.shiftKey ? () => void redo() : () => void undo();
}

function close_menu(): (() => void) | undefined {
  const { menu, reach } = selection.get();
  return menu || reach ? () => selection.set({ menu: undefined, reach: undefined }) : undefined;
}
