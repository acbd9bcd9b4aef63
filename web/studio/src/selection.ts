// SPDX-License-Identifier: Apache-2.0
// What the user looks at: the open composite, what is selected, the panels that are open.
import type { Argument, End, Fitting } from "./checked.ts";
import { Store } from "./store.ts";

export type Tab = "problems" | "log" | "threads" | "cycle" | "plot" | "modes" | "operate";

export type Beside = "" | "text" | "robot";

/** Where a wire could lead from a port. */
export interface Reach {
  box: string;
  port: string;
  /** `Component.member` to why it does not fit; empty: it fits. */
  ends: Map<string, string>;
  /** `Component.member` to what its component has to be told with the connection. */
  names: Map<string, { property: string; unit: string }>;
  models: End[];
}

/** The list of what fits, opened at a point of the window. */
export interface FitMenu {
  box: string;
  port: string;
  x: number;
  y: number;
  /** Where a new box is put on the canvas. */
  place?: [number, number];
}

/** A wire from an event to a command, as it is to be written once its parameters are given. */
export interface Commanding {
  from: string;
  to: string;
  parameters: Argument[];
}

/** A port whose curves are drawn: one of each component that it stands for. */
export interface Plotted {
  name: string;
  items: string[];  ///< of the run: `Joint1.Position`
}

export interface Selection {
  path: string[];       ///< composites that are open
  boxes: string[];
  wires: string[];
  port?: { box: string; port: string };
  reach?: Reach;
  menu?: FitMenu;
  beside: Beside;       ///< what stands beside the canvas
  opened: string[];     ///< connections from events to commands that are shown with their parameters
  mode: string;         ///< that the canvas shows; empty: the one that runs, or all
  lanes: boolean;       ///< boxes are in lanes of their threads
  commanding?: Commanding;
  textPlace?: { file: string; line: number; column: number; ask: number };
  tab: Tab;
  reveal?: { box: string; ask: number };  ///< the canvas moves there
  plotted: Plotted[];
  told: string;         ///< a short message; empty: none
}

export const selection = new Store<Selection>({
  path: [], boxes: [], wires: [], beside: "", opened: [], mode: "", lanes: false, tab: "problems", plotted: [], told: "",
});

let asks = 0;

export function select_box(box: string, reveal = false): void {
  selection.set({ boxes: [box], wires: [], port: undefined, commanding: undefined, ...(reveal ? { reveal: { box, ask: ++asks } } : {}) });
}

export const select_wire = (wire: string): void => selection.set({ boxes: [], wires: [wire], port: undefined, commanding: undefined });

export function select_port(box: string, port: string): void {
  selection.set({ boxes: [box], wires: [], port: { box, port }, commanding: undefined });
}

export const open_composite = (path: string[]): void => selection.set({ path, boxes: [], wires: [], port: undefined });

export function show_text(file: string, line = 1, column = 1): void {
  selection.set({ beside: "text", textPlace: { file, line, column, ask: ++asks } });
}

export function reach_of(box: string, port: string, { ends, models }: Fitting): Reach {
  const all = new Map(ends.map((end) => [`${end.component}.${end.member}`, end.why_not ?? ""]));
  const names = new Map(ends.flatMap((end) => (end.names ? [[`${end.component}.${end.member}`, end.names] as const] : [])));
  return { box, port, ends: all, names, models: models ?? [] };
}

let telling: ReturnType<typeof setTimeout> | undefined;

export function tell(told: string): void {
  clearTimeout(telling);
  selection.set({ told });
  telling = setTimeout(() => selection.set({ told: "" }), 6000);
}

export function toggle_plotted(name: string, items: string[] = [name]): void {
  const { plotted } = selection.get();
  const without = plotted.filter((one) => one.name !== name);
  selection.set({ plotted: without.length < plotted.length ? without : [...plotted, { name, items }], tab: "plot" });
}

/** Shows the parameters of a connection from an event to a command as pins of a box, or no more. */
export function toggle_opened(between: string): void {
  const { opened } = selection.get();
  const without = opened.filter((one) => one !== between);
  const opens = without.length === opened.length;
  selection.set({ opened: opens ? [...opened, between] : without, boxes: opens ? [between] : [], wires: [], port: undefined });
}
