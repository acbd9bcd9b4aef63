// SPDX-License-Identifier: Apache-2.0
// The graph of what is open now, made once for all views.
import type { Change } from "./backend.ts";
import type { Argument, Checked, End, Fitting, Place } from "./checked.ts";
import { array_of, in_array, peers_by_name, wires_by_name } from "./by_name.ts";
import { with_parameter } from "./event_command.ts";
import { type Box, type BoxPort, type Graph, graph_of, kNoGraph, type Wire } from "./graph.ts";
import { array_members } from "./ports.ts";
import { change, edit, fitting, own_file, project } from "./project.ts";
import { type Commanding, type FitMenu, reach_of, selection, tell } from "./selection.ts";
import { free_name } from "./free_name.ts";
import { message_of } from "./backend.ts";
import { split_member } from "./checked.ts";
import type { Texts } from "./written.ts";
import { entries_of, settings_at } from "./written.ts";
import type { Point } from "./layout.ts";

let made: { checked?: Checked; texts?: Texts; path?: string[]; opened?: string[]; graph: Graph } = { graph: kNoGraph };

/** The graph at this moment; the same object while nothing has changed. */
export function scene(): Graph {
  const { shown, shownTexts } = project.get();
  const { path, opened } = selection.get();
  if (made.checked !== shown || made.texts !== shownTexts || made.path !== path || made.opened !== opened) {
    const graph = shown ? graph_of(shown, shownTexts, path, opened) : kNoGraph;
    made = { checked: shown, texts: shownTexts, path, opened, graph };
  }
  return made.graph;
}

/** For views: the graph, again whenever the project or the open composite changes. */
export function useScene(): Graph {
  project.use((state) => state.shown);
  project.use((state) => state.shownTexts);
  selection.use((state) => state.path);
  selection.use((state) => state.opened);
  return scene();
}

export const box_called = (id: string): Box | undefined => scene().boxes.find((box) => box.id === id);

export const port_of = (box: Box, id: string): BoxPort | undefined => [...box.inputs, ...box.outputs].find((port) => port.id === id);

export const is_source = (port: BoxPort): boolean => port.kind === "output" || port.kind === "event";

/** Finds out where a wire from a port could lead, and shows it. */
export async function look_for_ends(box: string, port: string): Promise<void> {
  const from = box_called(box);
  const end = from && port_of(from, port)?.ends[0];
  if (!end) return;
  try {
    const answer = JSON.parse(await fitting(...split_member(end))) as Fitting;
    selection.set({ reach: reach_of(box, port, answer) });
  } catch (error) {
    tell(message_of(error));
  }
}

/** Why a wire cannot lead to a port; empty if it can, undefined if nobody knows. */
export function why_not(port: BoxPort): string | undefined {
  const { reach } = selection.get();
  const answers = port.ends.flatMap((end) => reach?.ends.get(end) ?? []);
  return answers.length === 0 ? undefined : answers.includes("") ? "" : answers[0];
}

/** The port as a connection names it: a range meets the whole array, another port the first of it that fits. */
function end_words(box: Box, port: BoxPort, other: BoxPort): string {
  if (other.written.includes("{i}")) {
    const array = port.count === 1 ? array_of(box, port) : undefined;
    return array && array_members(box.components[0]!, array).length === other.ends.length ? in_array(port, array) : port.written;
  }
  if (port.count === 1) return port.written;
  const { reach } = selection.get();
  const free = port.ends.find((end) => reach?.ends.get(end) === "") ?? port.ends[0]!;
  return port.written.replace(/[^.]*$/, split_member(free)[1]);
}

export async function connect(a: { box: string; port: string }, b: { box: string; port: string }): Promise<boolean> {
  const first = port_in(a);
  const second = port_in(b);
  if (!first || !second) return false;
  const [source, target] = is_source(first) ? [first, second] : [second, first];
  if (target.parameter) return give_parameter(is_source(first) ? b.box : a.box, target.parameter, source.written);
  const words = [end_words(box_called(a.box)!, first, second), end_words(box_called(b.box)!, second, first)];
  const [from, to] = is_source(first) ? words : words.toReversed();
  const parameters = is_source(first) ? parameters_left(first, box_called(b.box)!, second) : parameters_left(second, box_called(a.box)!, first);
  if (parameters.length > 0) return selection.set({ commanding: { from: from!, to: to!, parameters } }), true;
  return edit([...names_units(a, first), ...names_units(b, second), change("connect", from!, to!)], { field: "canvas" });
}

/** Has the component of a port of any unit name that of the other end. */
function names_units({ box }: { box: string }, port: BoxPort): Change[] {
  const { reach } = selection.get();
  const names = port.ends.map((end) => reach?.names.get(end)).find((one) => one !== undefined);
  return names ? [names_unit(box_called(box)!.edited, names)] : [];
}

const names_unit = (component: string, { property, unit }: NonNullable<End["names"]>): Change =>
  change("set", `${component}.${property}`, /^[\w/^*. -]+$/.test(unit) ? unit : JSON.stringify(unit));

/** Of a command, those that no member of the event gives. */
function parameters_left(event: BoxPort, box: Box, command: BoxPort): Argument[] {
  if (event.kind !== "event" || command.kind !== "command") return [];
  const members = box_with(event)?.components[0]!.events.find((one) => one.name === event.name)?.arguments ?? [];
  const parameters = box.components[0]?.operations.find((one) => one.name === command.name)?.arguments ?? [];
  return parameters.filter((one) => !members.some(({ name }) => without_unit(name) === without_unit(one.name)));
}

/** Names in signatures have their unit: `time [s]`. */
const without_unit = (name: string): string => name.replace(/ \[.*$/, "");

const box_with = (port: BoxPort): Box | undefined => scene().boxes.find((box) => box.outputs.includes(port));

/** Makes a wire to a command with a value for each of its parameters. */
export async function make_commanding({ from, to, parameters }: Commanding, values: string[]): Promise<void> {
  const given = parameters.map(({ name }, i) => `${without_unit(name)}: ${values[i]}`).join(", ");
  if (await edit([change("connect", from, to, `with: {${given}}`)], { field: "canvas" })) selection.set({ commanding: undefined });
}

function port_in({ box, port }: { box: string; port: string }): BoxPort | undefined {
  const found = box_called(box);
  return found && port_of(found, port);
}

/** Connects open inputs, and adds peers, where only one fits by its name; of the boxes `wanted`, or of all. */
export async function connect_by_name(wanted: readonly string[] = []): Promise<void> {
  const graph = scene();
  const services = project.get().shown?.connections.filter((one) => one.kind !== "data") ?? [];
  const served = new Set(services.flatMap((one) => [one.from, one.to]));
  const wires = wires_by_name(graph, wanted);
  const peers = peers_by_name(graph, served, own_file(), wanted);
  if (wires.length + peers.length === 0) return tell("Nothing to connect: no input that needs a writer has exactly one output of its name, type, unit and size.");
  const changes = [...wires.map((pair) => change("connect", ...pair)), ...peers.map((pair) => change("peer", ...pair))];
  if (await edit(changes, { field: "canvas" })) tell(`Connected ${counted(wires.length, "wire")}, and added ${counted(peers.length, "peer")}. Undo takes all of it back.`);
}

export const counted = (count: number, noun: string, plural = `${noun}s`): string => `${count} ${count === 1 ? noun : plural}`;

/** Names that something new must not have. */
export function taken_names(): string[] {
  const { shown, texts } = project.get();
  return [...(shown?.components ?? []).map((one) => one.name.split(".")[0]!), ...entries_of(texts).map((entry) => without_range(entry.name).model)];
}

/** Adds a component of a model, `PID`, several as one box, `PID{1..2}`, or by a name, `Pan=PID`; @return its name, or undefined if that was refused. */
export async function add_model(asked: string, place?: Point, then: (name: string) => ReturnType<typeof change>[] = () => []): Promise<string | undefined> {
  const { wanted, model, range } = asked_of(asked);
  const name = free_name(wanted || model, taken_names()) + range;
  const placed = place ? [change("place", name, String(place[0]), String(place[1]))] : [];
  const library = library_to_load(model);
  const loaded = library ? [change("library", library)] : [];
  if (!(await edit([...loaded, change("add", name, model), ...then(name), ...placed], { field: "canvas" }))) return undefined;
  selection.set({ path: [], boxes: [name], wires: [], port: undefined });
  return name;
}

/** `Pan=PID{1..2}` as the name that is wanted, the model and its range. */
export function asked_of(text: string): { wanted: string; model: string; range: string } {
  const [, wanted = "", asked = text] = /^(\w+)\s*=\s*(.*)$/.exec(text) ?? [];
  return { wanted, ...without_range(asked) };
}

/** `PID{1..2}` as the model and its range. */
export function without_range(asked: string): { model: string; range: string } {
  const [, model = asked, range = ""] = /^(.*?)\s*(\{\d+\.\.\d+\})$/.exec(asked) ?? [];
  return { model, range };
}

/** The library of a model that the deployment does not load yet. */
function library_to_load(model: string): string | undefined {
  const { models, texts } = project.get();
  const library = models.find((one) => one.name === model)?.library;
  if (!library) return undefined;
  const loaded = [...texts.values()].some((text) => libraries_of(text).includes(library));
  return loaded ? undefined : library;
}

function libraries_of(text: string): string[] {
  const flow = /^libraries:\s*\[([^\]]*)\]/m.exec(text)?.[1];
  if (flow !== undefined) return flow.split(",").map((one) => one.trim());
  const block = /^libraries:\s*\n((?:\s*-\s.*\n?)+)/m.exec(text)?.[1] ?? "";
  return [...block.matchAll(/-\s*(\S+)/g)].map((match) => match[1]!);
}

/** Adds a model and connects one of its ports with the one that the menu was opened for. */
export async function add_and_connect(menu: FitMenu, { component: model, member, names }: End): Promise<void> {
  const port = port_in(menu);
  if (!port) return;
  const ends = (name: string) => (is_source(port) ? [port.written, `${name}.${member}`] : [`${name}.${member}`, port.written]);
  await add_model(model, menu.place, (name) => [...(names ? [names_unit(name, names)] : []), change("connect", ...ends(name))]);
}

/** Has a parameter of an opened connection from an event given by a port, a member of the event, or a constant; empty: by the event. */
export async function give_parameter(box: string, parameter: string, value: string): Promise<boolean> {
  const found = box_called(box);
  if (!found?.opened) return false;
  return edit([given(found, found.opened, parameter, value)], { field: `${box} ${parameter}`, file: found.file });
}

function given({ file = "", line = 0, column = 1 }: Place, [from, to]: [string, string], parameter: string, value: string): Change {
  const settings = with_parameter(settings_at(project.get().texts, file, line, column), parameter, value);
  return change("connection", from, to, ...(settings ? [settings] : []));
}

export const disconnect = (wire: Wire): Change =>
  (wire.parameter ? given(wire, wire.written, wire.parameter, "") : change("disconnect", ...wire.written));

/** Removes what is selected. */
export async function remove_selected(): Promise<void> {
  const { boxes, wires } = selection.get();
  const graph = scene();
  const gone = graph.boxes.filter((box) => boxes.includes(box.id));
  const cut = graph.wires.filter((wire) => wires.includes(wire.id) && !gone.some((box) => box.id === wire.from.box || box.id === wire.to.box));
  const changes = [...cut.map(disconnect), ...gone.map((box) => (box.opened ? change("disconnect", ...box.opened) : change("remove", box.edited)))];
  if (changes.length === 0) return;
  const file = gone.find((box) => box.file)?.file ?? cut.find((wire) => wire.file)?.file;
  if (await edit(changes, { field: "canvas", file })) selection.set({ boxes: [], wires: [], port: undefined });
}
