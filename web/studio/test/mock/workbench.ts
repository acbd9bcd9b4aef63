// SPDX-License-Identifier: Apache-2.0
// Stands for `armature studio` in tests: texts in memory, edits by the package yaml.
import { Document, parseDocument } from "yaml";
import type { Change, EmergencyStop, Outcome, ProjectState, RunSettings, RunState, SeatState, Workbench } from "../../src/backend.ts";
import { type Checked, type End, type Model, split_member } from "../../src/checked.ts";
import { check } from "./checker.ts";
import { kModels } from "./models.ts";
import wam7 from "../../../../robots/wam/wam7.urdf";

type Texts = Map<string, string>;
type Snapshot = { texts: Texts; what: string };

export interface Captured {
  check: Checked;
  models: Model[];
  descriptions?: Record<string, string>;
}

const copy = (texts: Texts): Texts => new Map(texts);

export class MockWorkbench implements Workbench {
  readonly edits: Change[] = [];
  readonly orders: RunSettings[] = [];
  private readonly saved: Texts;
  private texts: Texts;
  private version = 1;
  private past: Snapshot[] = [];
  private future: Snapshot[] = [];
  private readonly boxes: Record<string, [number, number]> = {};
  private readonly robots: Record<string, string> = {};
  private readonly project_handlers: ((change: { version: number; checked: number }) => void)[] = [];
  private readonly run_handlers: ((change: { number: number; log_end: number }) => void)[] = [];
  private lines: string[] = [];
  private runs: RunState = { number: 0, state: "none", simulated: true, version: 0, exit_code: 0, log_begin: 0, log_end: 0 };
  private readonly seat_handlers: ((change: { holder: number }) => void)[] = [];
  private seated: SeatState = { you: 1, holder: 0, guests: [1, 2].map((number) => ({ number, who: "page@web", may_operate: true })) };
  private pressed = 0;  ///< when; 0: the key is up
  started = 0;
  emergencies = 0;
  on_state: (state: string, simulated: boolean) => void = () => undefined;

  /** @param captured  what the real check said of these texts, in place of the mock's */
  constructor(private readonly file: string, texts: Record<string, string>, private readonly captured?: Captured) {
    this.texts = new Map(Object.entries(texts));
    this.saved = copy(this.texts);
  }

  on_ProjectChanged(handler: (change: { version: number; checked: number }) => void): void {
    this.project_handlers.push(handler);
  }

  on_RunChanged(handler: (change: { number: number; log_end: number }) => void): void {
    this.run_handlers.push(handler);
  }

  on_SeatChanged(handler: (change: { holder: number }) => void): void {
    this.seat_handlers.push(handler);
  }

  async emergency_stop(): Promise<EmergencyStop> {
    ++this.emergencies;
    return { disarmed: ["Arming"], stopped: "" };
  }

  seat = async (): Promise<SeatState> => this.seated;
  take_seat = async (): Promise<SeatState> => this.sit(this.seated.you);
  leave_seat = async (): Promise<SeatState> => this.sit(0);
  hand_over = async (guest: number): Promise<SeatState> => this.sit(guest);

  sit(holder: number): SeatState {
    this.seated = { ...this.seated, holder };
    for (const handler of this.seat_handlers) handler({ holder });
    return this.seated;
  }

  async hold_key(down: boolean): Promise<number> {
    if (!down) this.pressed = 0;
    else if (this.pressed === 0) this.pressed = Date.now();
    return down ? (Date.now() - this.pressed) / 1000 : 0;
  }

  async project(): Promise<ProjectState> {
    const files = [...this.texts].map(([path, text]) => ({ path, changed: this.saved.get(path) !== text }));
    const undo = this.past.at(-1)?.what ?? "";
    const redo = this.future.at(-1)?.what ?? "";
    return { file: this.file, version: this.version, files, undo, redo, checked: this.version, elsewhere: "", notice: "" };
  }

  text = async (path: string): Promise<string> => this.texts.get(path) ?? "";
  places = async (): Promise<string> => JSON.stringify({ boxes: this.boxes, robots: this.robots });
  models = async (): Promise<string> => JSON.stringify(this.captured?.models ?? kModels);
  check = async (): Promise<string> => JSON.stringify(this.checked());

  async description(path: string): Promise<string> {
    const text = this.captured?.descriptions?.[path] ?? (path.endsWith("wam7.urdf") ? wam7 : undefined);
    if (text === undefined) throw new Error(`'${path}' is no robot's description of this deployment`);
    return text;
  }

  checked(): Checked {
    return this.captured?.check ?? check(this.file, this.texts, kModels);
  }

  async edit({ changes, files, overrides }: { changes: Change[]; files: string[]; overrides: boolean }): Promise<Outcome> {
    const texts = copy(this.texts);
    for (const one of changes) {
      this.edits.push(one);
      const refused = this.make(one, texts, files, overrides);
      if (refused) return this.refused(refused);
    }
    const written = changes.filter((one) => one.edit !== "place" && one.edit !== "robot");
    const what = written.map((one) => `${one.edit} ${one.words.join(" ")}`).join(", ");
    if (written.length > 0) this.become(texts, what);
    else this.tell();
    return { done: true, version: this.version, diagnostics: "[]" };
  }

  private refused(message: string): Outcome {
    return { done: false, version: this.version, diagnostics: JSON.stringify([{ severity: "error", message, hint: "choose another" }]) };
  }

  private become(texts: Texts, what: string): void {
    this.past.push({ texts: this.texts, what });
    this.future = [];
    this.texts = texts;
    ++this.version;
    this.tell();
  }

  private tell(): void {
    for (const handler of this.project_handlers) handler({ version: this.version, checked: this.version });
  }

  private make({ edit, words }: Change, texts: Texts, files: string[], overrides: boolean): string {
    const [a = "", b = "", c = ""] = words;
    if (edit === "place") {
      this.boxes[a] = [Number(b), Number(c)];
      return "";
    }
    if (edit === "robot") {
      if (b) this.robots[a] = b;
      else delete this.robots[a];
      return "";
    }
    const path = overrides ? this.file : files[0] ?? this.file_of(a, texts);
    const document = parseDocument(texts.get(path) ?? "");
    if (overrides) document.setIn(["components", a.split(".")[0], "override"], true);
    const refused = this.change_document(document, edit, a, b, c, words.slice(2));
    if (!refused) texts.set(path, document.toString({ lineWidth: 0, flowCollectionPadding: false }));
    return refused;
  }

  /** The file that has the component. */
  private file_of(name: string, texts: Texts): string {
    const found = [...texts].find(([, text]) => parseDocument(text).hasIn(["components", name.split(".")[0]]));
    return found?.[0] ?? this.file;
  }

  private change_document(document: Document, edit: string, a: string, b: string, c: string, rest: string[]): string {
    const [owner, member] = split_member(a);
    if (edit === "add") {
      if (document.hasIn(["components", a])) return `'${a}' is there already`;
      document.setIn(["components", a], document.createNode({ model: b }, { flow: true }));
    } else if (edit === "remove") document.deleteIn(["components", a]);
    else if (edit === "rename") return this.rename(document, a, b);
    else if (edit === "set") return set(document, owner, member, b);
    else if (edit === "unset") document.deleteIn(["components", owner, "properties", member]);
    else if (edit === "connect") add_to(document, ["connections"], c ? document.createNode({ from: a, to: b }) : `${a} -> ${b}`);
    else if (edit === "connection") set_connection(document, a, b, c);
    else if (edit === "disconnect") remove_connection(document, `${a} -> ${b}`);
    else if (edit === "library") add_to(document, ["libraries"], a);
    else if (edit === "group") return this.group(document, a, [b, ...rest]);
    else if (edit === "dissolve") document.deleteIn(["components", a]);
    else if (edit === "split") return this.split(document, a, b);
    else if (edit === "peer") add_to(document, ["components", a, "peers"], b);
    else if (edit === "superior") add_to(document, ["components", a, "superiors"], b);
    else if (edit === "no_superior") remove_from(document, ["components", a, "superiors"], b);
    else if (edit === "calls") document.setIn(["components", a, "calls"], parseDocument(b).contents);
    else if (edit === "include") add_to(document, ["include"], a);
    else if (edit === "no_include") document.deleteIn(["include"]);
    else return change_modes(document, edit, a, b);
    return "";
  }

  /** The parts go, and a composite of none stands for them. */
  private group(document: Document, name: string, parts: string[]): string {
    document.setIn(["composites", name], document.createNode({ components: {} }));
    document.setIn(["components", name], document.createNode({ model: name }, { flow: true }));
    for (const part of parts) document.deleteIn(["components", part]);
    return "";
  }

  /** The last of a range. */
  private split(document: Document, name: string, part: string): string {
    const [, stem, first, last] = /^(.*)\{(\d+)\.\.(\d+)\}$/.exec(name)!;
    if (part !== last) return `'${part}' is no number and no part of {${first}..${last}}`;
    const body = document.getIn(["components", name]);
    document.deleteIn(["components", name]);
    document.setIn(["components", `${stem}{${first}..${Number(last) - 1}}`], body);
    document.setIn(["components", `${stem}${last}`], body);
    return "";
  }

  private rename(document: Document, from: string, to: string): string {
    if (document.hasIn(["components", to])) return `'${to}' is there already`;
    const map = document.get("components") as unknown as { items: { key: { value: string } }[] };
    const pair = map.items.find((one) => one.key.value === from);
    if (!pair) return `there is no '${from}'`;
    pair.key.value = to;
    const text = document.toString().replaceAll(`${from}.`, `${to}.`);
    document.contents = parseDocument(text).contents as never;
    return "";
  }

  async write(version: number, path: string, text: string): Promise<Outcome> {
    if (version !== this.version) return this.refused("somebody changed the same lines");
    this.become(copy(this.texts).set(path, text), `change of ${path}`);
    return { done: true, version: this.version, diagnostics: "[]" };
  }

  /** What another person does in the meantime. */
  change_elsewhere(path: string, text: string): void {
    this.become(copy(this.texts).set(path, text), `change of ${path}`);
  }

  undo = async (): Promise<Outcome> => this.step(this.past, this.future);
  redo = async (): Promise<Outcome> => this.step(this.future, this.past);

  private step(from: Snapshot[], to: Snapshot[]): Outcome {
    const last = from.pop();
    if (!last) return this.refused("there is nothing to take back");
    to.push({ texts: this.texts, what: last.what });
    this.texts = last.texts;
    ++this.version;
    this.tell();
    return { done: true, version: this.version, diagnostics: "[]" };
  }

  async save(): Promise<Outcome> {
    for (const [path, text] of this.texts) this.saved.set(path, text);
    this.tell();
    return { done: true, version: this.version, diagnostics: "[]" };
  }

  async reload(): Promise<Outcome> {
    this.become(copy(this.saved), "reload");
    return { done: true, version: this.version, diagnostics: "[]" };
  }

  async fitting(component: string, member: string): Promise<string> {
    const { components, connections } = this.checked();
    const own = components.find((one) => one.name === component)!;
    const output = own.outputs.find((one) => one.name === member);
    const input = own.inputs.find((one) => one.name === member);
    const port = output ?? input;
    if (!port) return JSON.stringify({ ends: this.commands(own.events.some((one) => one.name === member), components), models: [] });
    const side = output ? "inputs" : "outputs";
    const why_not = (owner: string, other: { name: string; type: string; unit: string }) => {
      if (other.type !== port.type) return `it is a ${other.type}, this is a ${port.type}`;
      if (other.unit !== port.unit && other.unit && port.unit) return `it is in ${other.unit}, this is in ${port.unit}`;
      const written = connections.find((one) => one.to === `${owner}.${other.name}`);
      return output && written ? `it is written by '${written.from}' already` : "";
    };
    const kind: End["kind"] = output ? "input" : "output";
    const ends = components.flatMap((one) => one[side].map((other): End => ({ component: one.name, member: other.name, kind, why_not: why_not(one.name, other) })));
    const models = (this.captured?.models ?? kModels).flatMap((one) => one[side].filter((other) => why_not("", other) === "").map((other): End => ({ component: one.name, member: other.name, kind })));
    return JSON.stringify({ ends, models });
  }

  private commands(event: boolean, components: Checked["components"]): End[] {
    return components.flatMap((one) => event
      ? one.operations.filter(({ command }) => command).map(({ name }): End => ({ component: one.name, member: name, kind: "command" }))
      : one.events.map(({ name }): End => ({ component: one.name, member: name, kind: "event" })));
  }

  async start(settings: RunSettings): Promise<RunState> {
    const { simulated } = settings;
    this.orders.push(settings);
    this.lines = [];
    this.started = Date.now();
    this.runs = { ...this.runs, number: this.runs.number + 1, state: "running", simulated, version: this.version, log_begin: 0, log_end: 0 };
    this.on_state("running", simulated);
    this.say(`note: '${this.checked().application}' runs`);
    this.say("warning: Watcher: the first value is 0.4 s old");
    return this.runs;
  }

  async stop(): Promise<RunState> {
    if (this.runs.state === "running") {
      this.runs = { ...this.runs, state: "ended" };
      this.on_state("ended", false);
      this.say("note: it has stopped");
    }
    return this.runs;
  }

  say(line: string): void {
    this.lines.push(`[${((Date.now() - this.started) / 1000).toFixed(3)}] ${line}`);
    this.runs = { ...this.runs, log_end: this.lines.length };
    for (const handler of this.run_handlers) handler({ number: this.runs.number, log_end: this.runs.log_end });
  }

  run = async (): Promise<RunState> => this.runs;
  log = async (from: number): Promise<string[]> => this.lines.slice(from, from + 500);
}

function set(document: Document, owner: string, member: string, value: string): string {
  const parsed: unknown = parseDocument(value).toJS();
  if (member === "activity") document.setIn(["components", owner, "activity"], parsed);
  else {
    const model = document.getIn(["components", owner, "model"]);
    const property = kModels.find((one) => one.name === model)?.properties.find((one) => one.name === member);
    const number = Number.parseFloat(value);
    if (property?.type === "double" && Number.isNaN(number)) return `'${value}' is no number`;
    document.setIn(["components", owner, "properties", member], /deg$/.test(value) ? (number * Math.PI) / 180 : parsed);
  }
  return "";
}

function add_to(document: Document, path: string[], item: unknown): void {
  if (document.hasIn(path)) document.addIn(path, item);
  else document.setIn(path, document.createNode([item]));
}

function remove_from(document: Document, path: string[], item: string): void {
  const rest = (document.getIn(path) as { toJSON(): string[] }).toJSON().filter((one) => one !== item);
  if (rest.length > 0) document.setIn(path, document.createNode(rest, { flow: true }));
  else document.deleteIn(path);
}

/** @return why it is refused; empty: it is made */
function change_modes(document: Document, edit: string, a: string, b: string): string {
  const modes = document.get("modes") as unknown as { items: { key: { value: string } }[] } | undefined;
  if (edit === "to_mode") add_to(document, ["modes", a], b);
  else if (edit === "no_mode") document.deleteIn(["modes", a]);
  else if (edit === "rename_mode") modes!.items.find((one) => one.key.value === a)!.key.value = b;
  else if (edit === "initial_mode") document.set("mode", a);
  else if (edit === "from_mode") {
    if ((document.getIn(["modes", a]) as { items: unknown[] }).items.length === 1) return "the mode would have no component";
    remove_from(document, ["modes", a], b);
  }
  return "";
}

type Items = { items: { value?: string; get?(key: string): unknown }[] };

const ends_of = (item: Items["items"][number]): string => item.value ?? `${String(item.get?.("on") ?? item.get?.("from"))} -> ${String(item.get?.("do") ?? item.get?.("to"))}`;

function remove_connection(document: Document, written: string): void {
  const list = document.get("connections") as unknown as Items;
  list.items = list.items.filter((one) => ends_of(one) !== written);
}

/** Of a connection from an event to a command. */
function set_connection(document: Document, on: string, to: string, settings: string): void {
  const list = document.get("connections") as unknown as Items;
  const at = list.items.findIndex((one) => ends_of(one) === `${on} -> ${to}`);
  const text = `{on: ${on}, do: ${to}${settings ? `, ${settings}` : ""}}`;
  list.items[at] = parseDocument(text).contents as never;
}
