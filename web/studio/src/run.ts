// SPDX-License-Identifier: Apache-2.0
// The application that runs: how it is started, its state, its log.
import {
  type ApplicationStatus, type Backend, type ComponentStatus, kPatient, message_of, type Pace, type RunState,
} from "./backend.ts";
import { is_saved, project, save, write_typed } from "./project.ts";
import { selection, tell } from "./selection.ts";
import { Store } from "./store.ts";

export interface Run {
  state: RunState;
  simulated: boolean;      ///< of the next run
  pace: number;            ///< likewise
  mode: string;            ///< likewise; empty: the deployment's first
  settings: Setting[];     ///< likewise
  now?: Pace;
  application?: ApplicationStatus;
  components: ReadonlyMap<string, ComponentStatus>;
  log: readonly string[];
  logBegin: number;        ///< number of the first line in `log`
}

/** A parameter or property that a run has otherwise than the file says; without a name it is none yet. */
export interface Setting {
  name: string;
  value: string;
}

const kNone: RunState = { number: 0, state: "none", simulated: true, version: 0, exit_code: 0, log_begin: 0, log_end: 0 };
const kMostLines = 5000;
const kStatusInterval = 250;
const kComponentsInterval = 1000;

export const run = new Store<Run>({ state: kNone, simulated: true, pace: 1, mode: "", settings: [], components: new Map(), log: [], logBegin: 0 });

let backend: Backend;

export const inspector = (): Backend["run"] => backend.run;
export const is_up = (state: RunState): boolean => state.state === "running";
export const is_going = (state: RunState): boolean => ["starting", "running", "stopping"].includes(state.state);

export function open_run(from: Backend): void {
  backend = from;
  backend.workbench.on_RunChanged(() => void look());
  backend.on_connection(({ connected }) => connected && void look());
  void look();
  poll(read_status, kStatusInterval);
  poll(read_components, kComponentsInterval);
}

/** Does it again and again, each time an interval after it has ended. */
function poll(what: () => Promise<void>, interval: number): void {
  const next = () => what().catch(() => undefined).finally(() => setTimeout(next, interval));
  setTimeout(next, interval);
}

let looking = false;
let again = false;

async function look(): Promise<void> {
  again = true;
  if (looking) return;
  looking = true;
  while (again) {
    again = false;
    await read_run().catch(() => undefined);
  }
  looking = false;
}

async function read_run(): Promise<void> {
  const state = await backend.workbench.run(kPatient);
  const other = state.number !== run.get().state.number;
  const kept = other ? { log: [], logBegin: state.log_begin } : {};
  const past = is_up(state) ? {} : { components: new Map(), application: undefined, now: undefined };
  run.set({ state, ...kept, ...past });
  await read_log(state);
}

async function read_log(state: RunState): Promise<void> {
  const { log, logBegin } = run.get();
  let from = Math.max(logBegin + log.length, state.log_begin);
  if (log.length === 0) run.set({ logBegin: from });
  while (from < state.log_end) {
    const lines = await backend.workbench.log(from, kPatient);
    if (lines.length === 0) return;
    from += lines.length;
    const all = [...run.get().log, ...lines].slice(-kMostLines);
    run.set({ log: all, logBegin: from - all.length });
  }
}

async function read_status(): Promise<void> {
  const { state } = run.get();
  if (!is_up(state)) return;
  const application = await backend.run.application();
  const now = state.simulated ? await backend.run.pace() : undefined;
  if (is_up(run.get().state)) run.set({ application, now });
}

async function read_components(): Promise<void> {
  if (!is_up(run.get().state)) return;
  const all = await backend.run.components();
  if (is_up(run.get().state)) run.set({ components: new Map(all.map((one) => [one.name, one])) });
}

async function told<Result>(done: Promise<Result>): Promise<Result | undefined> {
  return done.catch((error: unknown) => {
    tell(message_of(error));
    return undefined;
  });
}

export const named_settings = (settings: Setting[]): Setting[] => settings.filter(({ name }) => name.trim() !== "");

/** The mode that was chosen, as long as the deployment has it. */
export function mode_of_next(): string {
  const { mode } = run.get();
  return project.get().shown?.modes.some((one) => one.name === mode) ? mode : "";
}

export async function start(): Promise<void> {
  await write_typed();
  if (!is_saved(project.get().state) && !(await save())) return;
  const { simulated, pace } = run.get();
  const overrides = named_settings(run.get().settings).map(({ name, value }) => `${name.trim()}=${value.trim()}`);
  const state = await told(backend.workbench.start({ simulated, pace, mode: mode_of_next(), overrides }, kPatient));
  if (!state) return;
  run.set({ state, log: [], logBegin: state.log_begin });
  if (selection.get().tab === "problems") selection.set({ tab: "log" });
  await look();
}

export async function stop(): Promise<void> {
  const state = await told(backend.workbench.stop(kPatient));
  if (state) run.set({ state });
}

export async function set_pace(pace: number): Promise<void> {
  run.set({ pace });
  const { state, now } = run.get();
  if (is_up(state) && now) await change_pace({ rate: pace, paused: now.paused });
}

export async function pause(paused: boolean): Promise<void> {
  const { now, pace } = run.get();
  await change_pace({ rate: now?.rate ?? pace, paused });
}

async function change_pace(pace: Pace): Promise<void> {
  const now = await told(backend.run.set_pace(pace));
  if (now) run.set({ now });
}

export async function step(): Promise<void> {
  const now = await told(backend.run.step());
  if (now) run.set({ now });
}

export async function change_component(component: string, change: string): Promise<void> {
  if (await told(backend.run.change(component, change))) await read_components().catch(() => undefined);
}
