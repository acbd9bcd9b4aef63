// SPDX-License-Identifier: Apache-2.0
// The deployment that is edited, as the server has it, and how it is edited.
import { type Backend, type Change, kPatient, message_of, type Outcome, type ProjectState } from "./backend.ts";
import { with_fix } from "./bytes.ts";
import type { Checked, Diagnostic, Fix, Model } from "./checked.ts";
import { keep_here } from "./elsewhere.ts";
import type { Point } from "./layout.ts";
import { Store } from "./store.ts";
import { entries_of, type Texts } from "./written.ts";

/** What the user is asked before an included file changes. */
export interface Question {
  file: string;
  answer(choice: Inclusion | undefined): void;
}

/** Changes the included file, or overrides what it says in the deployment's own. */
export type Inclusion = "there" | "here";

export interface Refusal {
  /** What was to be edited, as fields name it: `Joint1.Kp`. */
  about: string;
  diagnostics: Diagnostic[];
}

export interface Project {
  loaded: boolean;
  connected: boolean;
  trouble: string;          ///< of the connection
  state: ProjectState;
  texts: Texts;
  textsVersion: number;     ///< that `texts` are of
  checked?: Checked;        ///< the newest
  shown?: Checked;          ///< the newest that has components
  shownTexts: Texts;        ///< that `shown` is about
  stale: boolean;           ///< `shown` is older than `checked`
  models: Model[];
  places: ReadonlyMap<string, Point>;
  robots: ReadonlyMap<string, string>;  ///< the port that was chosen for a robot, by the component that describes it
  refusal?: Refusal;
  question?: Question;
}

const kNothing: ProjectState = { file: "", version: 0, files: [], undo: "", redo: "", checked: 0, elsewhere: "", notice: "" };

export const project = new Store<Project>({
  loaded: false, connected: true, trouble: "", state: kNothing, texts: new Map(), textsVersion: 0, shownTexts: new Map(),
  stale: false, models: [], places: new Map(), robots: new Map(),
});

let backend: Backend;
const inclusions = new Map<string, Inclusion>();

export function open_project(from: Backend): void {
  backend = from;
  backend.on_connection(({ connected, text }) => {
    project.set({ connected, trouble: text });
    if (!connected) return;
    void refresh();
    void load_models();
  });
  backend.workbench.on_ProjectChanged(() => void refresh());
  void refresh();
  void load_models();
}

let again = false;
let reading: Promise<void> | undefined;

/** Reads what has changed. Those that ask meanwhile are served by one more round. */
export function refresh(): Promise<void> {
  again = true;
  reading ??= read_until_done().finally(() => (reading = undefined));
  return reading;
}

async function read_until_done(): Promise<void> {
  while (again) {
    again = false;
    await read_all().catch((error: unknown) => project.set({ trouble: message_of(error) }));
  }
}

async function read_all(): Promise<void> {
  const { workbench } = backend;
  const state = await workbench.project(kPatient);
  const before = project.get();
  const fresh = state.version !== before.textsVersion;
  const texts = fresh ? await read_texts(state) : before.texts;
  const { boxes, robots } = JSON.parse(await workbench.places(kPatient)) as { boxes?: Record<string, Point>; robots?: Record<string, string> };
  const checked = state.checked > 0 && (state.checked !== before.state.checked || !before.checked)
    ? (JSON.parse(await workbench.check(kPatient)) as Checked)
    : before.checked;
  const then = await workbench.project(kPatient);
  if (then.version !== state.version) again = true;
  project.set({
    loaded: true, state, texts, textsVersion: state.version, trouble: "",
    ...(state.elsewhere ? {} : { places: new Map(Object.entries(boxes ?? {})), robots: new Map(Object.entries(robots ?? {})) }),
    ...what_is_shown(checked, texts, before),
  });
}

async function read_texts(state: ProjectState): Promise<Texts> {
  const pairs = state.files.map(async ({ path }) => [path, await backend.workbench.text(path, kPatient)] as const);
  return new Map(await Promise.all(pairs));
}

/** The canvas keeps what was there before a mistake that leaves nothing to show. */
function what_is_shown(checked: Checked | undefined, texts: Texts, before: Project): Partial<Project> {
  if (!checked || checked === before.checked) return { checked };
  const unreadable = checked.errors > 0 && checked.components.length === 0 && (before.shown?.components.length ?? 0) > 0;
  if (unreadable && entries_of(texts).length > 0) return { checked, stale: true };
  return { checked, shown: checked, shownTexts: texts, stale: false };
}

async function load_models(): Promise<void> {
  const text = await backend.workbench.models(kPatient).catch(() => undefined);
  if (text !== undefined) project.set({ models: JSON.parse(text) as Model[] });
}

/** The deployment's own file, as diagnostics name it. */
export const own_file = (): string => project.get().state.files[0]?.path ?? "";

export const is_saved = (state: ProjectState): boolean => state.files.every((file) => !file.changed);

/** What an edit is about: the field that shows a refusal, and the file that says it now. */
export interface About {
  field?: string;
  file?: string;
}

/** Makes all changes, or none. @return whether they were made */
export async function edit(changes: Change[], about: About = {}): Promise<boolean> {
  if (project.get().state.elsewhere && keep_here(changes)) return true;
  const inclusion = await how_to_change(about.file);
  if (inclusion === "no") return false;
  const files = inclusion === "there" ? [about.file!] : [];
  const asked = { changes, files, overrides: inclusion === "here" };
  return settle(backend.workbench.edit(asked, kPatient), about.field ?? "");
}

export const change = (edit: string, ...words: string[]): Change => ({ edit, words });

/** Asks once for each included file. */
async function how_to_change(file: string | undefined): Promise<Inclusion | "own" | "no"> {
  if (!file || file === own_file()) return "own";
  const known = inclusions.get(file);
  if (known) return known;
  const choice = await ask_where(file);
  if (choice) inclusions.set(file, choice);
  return choice ?? "no";
}

/** A question that is still open is answered by the next one: no. */
async function ask_where(file: string): Promise<Inclusion | undefined> {
  project.get().question?.answer(undefined);
  const { promise, resolve } = Promise.withResolvers<Inclusion | undefined>();
  const question: Question = { file, answer: resolve };
  project.set({ question });
  const choice = await promise;
  if (project.get().question === question) project.set({ question: undefined });
  return choice;
}

async function settle(outcome: Promise<Outcome>, field: string): Promise<boolean> {
  const done = await outcome.catch((error: unknown) => failed(message_of(error)));
  const diagnostics = JSON.parse(done.diagnostics || "[]") as Diagnostic[];
  project.set({ refusal: diagnostics.length > 0 ? { about: field, diagnostics } : undefined });
  await refresh();
  return done.done;
}

const failed = (message: string): Outcome => ({
  done: false, version: 0, diagnostics: JSON.stringify([{ severity: "error", message }]),
});

/** Of the editors, for what was typed and is not written yet. */
export const unwritten = new Set<() => Promise<void>>();

export async function write_typed(): Promise<void> {
  for (const write_now of unwritten) await write_now();
}

/** Does something about the texts once all that was typed is in them. */
async function with_all_typed(what: () => Promise<Outcome>): Promise<boolean> {
  await write_typed();
  return settle(what(), "");
}

export const undo = (): Promise<boolean> => with_all_typed(() => backend.workbench.undo(kPatient));
export const redo = (): Promise<boolean> => with_all_typed(() => backend.workbench.redo(kPatient));
export const save = (): Promise<boolean> => with_all_typed(() => backend.workbench.save(kPatient));

/** Takes what the disk has, component libraries that were built anew among it. */
export async function reload(): Promise<void> {
  await with_all_typed(() => backend.workbench.reload(kPatient));
  await load_models();
}

/** Writes a text that was made from the one of `version`. */
export async function write(version: number, path: string, text: string): Promise<boolean> {
  return settle(backend.workbench.write(version, path, text, kPatient), `text:${path}`);
}

export async function apply_fix(fix: Fix): Promise<void> {
  const { texts, textsVersion } = project.get();
  const text = with_fix(texts.get(fix.file) ?? "", fix);
  if (text !== undefined) await write(textsVersion, fix.file, text);
}

export const clear_refusal = (): void => project.set({ refusal: undefined });

export async function fitting(component: string, member: string): Promise<string> {
  return backend.workbench.fitting(component, member, kPatient);
}

/** The text of a robot's description (URDF). */
export const describe_robot = (path: string): Promise<string> => backend.workbench.description(path, kPatient);

/** Has the robot that a component describes moved by a port; empty: by the one that is found. */
export const set_robot_source = (owner: string, port: string): Promise<boolean> => edit([change("robot", owner, port)], { field: "robot" });
