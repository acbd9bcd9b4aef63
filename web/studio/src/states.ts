// SPDX-License-Identifier: Apache-2.0
// The states of the components that a box stands for.
import type { ComponentStatus } from "./backend.ts";
import type { Box } from "./graph.ts";

/** Their common state, or the worst of them; empty while nothing runs. */
export function boxes_state(box: Box, components: ReadonlyMap<string, ComponentStatus>): string {
  const states = box.components.flatMap((one) => components.get(one.name)?.state ?? []);
  return states.sort((a, b) => rank(b) - rank(a))[0] ?? "";
}

const kRanks = ["Running", "Stopped", "PreOperational"];

/** States that are not known are faults of some kind. */
const rank = (state: string): number => (kRanks.indexOf(state) < 0 ? kRanks.length : kRanks.indexOf(state));

/** What the state itself says already is left out: `exception: the lens is dirty`. */
export const reason_text = (state: string, reason: string): string =>
  reason.toLowerCase().startsWith(`${state.toLowerCase()}: `) ? reason.slice(state.length + 2) : reason;

/** Whether starting, stopping or a reset does something for a component in that state. */
export function acts_of(state: string): { start: boolean; stop: boolean; reset: boolean } {
  const faulty = state_class(state) === "is-faulty";
  return { start: state_class(state) === "is-stopped", stop: state === "Running" || state === "RunTimeError", reset: faulty };
}

export function state_class(state: string): string {
  if (!state) return "";
  if (state === "Running") return "is-running";
  return rank(state) < kRanks.length ? "is-stopped" : "is-faulty";
}
