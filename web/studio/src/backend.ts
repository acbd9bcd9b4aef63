// SPDX-License-Identifier: Apache-2.0
// What the page needs of the other side, so that tests can stand in for it.
import type { InspectorPlaceholder } from "@armature/placeholders/inspection";
import type { ProjectChanged, RunChanged, SeatChanged, WorkbenchPlaceholder } from "@armature/placeholders/workbench";

export type {
  ApplicationStatus, CommandStatus, Cycle, ComponentDetails, ComponentStatus, OperationDetails, Pace, ThreadStatus,
} from "@armature/placeholders/inspection";
export type { Change, EmergencyStop, Guest, Outcome, ProjectState, RunSettings, RunState, SeatState } from "@armature/placeholders/workbench";

type WorkbenchCalls =
  | "project" | "text" | "edit" | "write" | "undo" | "redo" | "save" | "reload" | "check" | "fitting" | "models" | "places"
  | "start" | "stop" | "run" | "log" | "description"
  | "emergency_stop" | "seat" | "take_seat" | "hand_over" | "leave_seat" | "hold_key";
type InspectorCalls =
  | "application" | "components" | "faults" | "describe" | "read" | "write" | "call" | "begin" | "follow" | "cancel" | "change"
  | "watch" | "watched" | "end_watch" | "cycle" | "pace" | "set_pace" | "step";

export interface Workbench extends Pick<WorkbenchPlaceholder, WorkbenchCalls> {
  on_ProjectChanged(handler: (change: ProjectChanged) => void): unknown;
  on_RunChanged(handler: (change: RunChanged) => void): unknown;
  on_SeatChanged(handler: (change: SeatChanged) => void): unknown;
}

export type Inspector = Pick<InspectorPlaceholder, InspectorCalls>;

export interface Backend {
  workbench: Workbench;
  /** Of what runs; its calls fail while nothing does. */
  run: Inspector;
  /** Told at each loss and recovery of the connection. */
  on_connection(handler: (change: { connected: boolean; text: string }) => void): unknown;
}

/** For calls that read files or load libraries [ms]. */
export const kPatient = { deadline: 30_000 };

/** What went wrong, without whom it was asked of. */
export const message_of = (error: unknown): string =>
  (error instanceof Error ? error.message : String(error)).replace(/^'[^']*' at ws\S*, \w+: /, "");
