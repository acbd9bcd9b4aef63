// SPDX-License-Identifier: Apache-2.0
// What the text of a deployment says where an entry stands. This is no YAML parser: it reads keys
// and ends of connections as people and `armature edit` write them, for names on the canvas.
import { offset_of } from "./bytes.ts";

export type Texts = ReadonlyMap<string, string>;

/** A composite's definition, as far as boxes need it. */
export interface Composite {
  name: string;
  file: string;
  /** Path inside, such as `mixer.Forward`, to the name that it is exported as. */
  exports: Map<string, string>;
}

/** An entry below `components:`. */
export interface WrittenEntry {
  name: string;
  file: string;
  line: number;
}

const unquoted = (text: string): string => text.replace(/^(["'])(.*)\1$/, "$2");

/** The key that begins at a place, `Joint{1..7}`; empty if there is none. */
export function key_at(texts: Texts, file: string, line: number, column: number): string {
  const text = texts.get(file);
  if (text === undefined) return "";
  const rest = text.slice(offset_of(text, line, column)).split("\n", 1)[0] ?? "";
  return unquoted(/^("[^"]*"|'[^']*'|[\w.-]+(?:\{[^}]*\}*\})?[\w.]*)\s*:/.exec(rest)?.[1] ?? "");
}

/** The two ends of the connection that begins at a place, as written; undefined if it is not plain. */
export function ends_at(texts: Texts, file: string, line: number, column: number): [string, string] | undefined {
  const text = texts.get(file);
  if (text === undefined) return undefined;
  const rest = text.slice(offset_of(text, line, column)).replace(/^-\s*/, "");
  const arrow = /^["']?([^\s"']+)\s*->\s*([\w.{}+-]+)/.exec(rest);
  if (arrow) return [arrow[1]!, arrow[2]!];
  const entry = rest.slice(0, entry_length(rest));
  const from = /\b(?:from|on):\s*["']?([\w.]+(?:\{[^}]*\}\w*)*(?:\.[\w{}+-]+)?)/.exec(entry);
  const to = /\b(?:to|do):\s*["']?([\w.]+(?:\{[^}]*\}\w*)*(?:\.[\w{}+-]+)?)/.exec(entry);
  return from && to ? [from[1]!, to[1]!] : undefined;
}

/** What else a connection's entry says, as the settings of an edit: `policy: {fifo: 8}`. */
export function settings_at(texts: Texts, file: string, line: number, column: number): string {
  const text = texts.get(file);
  if (text === undefined) return "";
  const rest = text.slice(offset_of(text, line, column)).replace(/^-\s*/, "");
  if (!rest.startsWith("{")) return "";
  const inside = rest.slice(1, entry_length(rest) - 1);
  return split_flow(inside).filter((part) => !/^\s*(from|to|on|do):/.test(part)).map((part) => part.trim()).join(", ");
}

/** Whether the entry at a place is one of braces. */
export function is_flow_at(texts: Texts, file: string, line: number, column: number): boolean {
  const text = texts.get(file);
  return text !== undefined && /^(-\s*)?\{/.test(text.slice(offset_of(text, line, column)));
}

/** Parts between commas that are not inside of brackets. */
export function split_flow(text: string): string[] {
  const parts = [""];
  let depth = 0;
  for (const c of text) {
    if (c === "{" || c === "[") ++depth;
    if (c === "}" || c === "]") --depth;
    if (c === "," && depth === 0) parts.push("");
    else parts[parts.length - 1] += c;
  }
  return parts.filter((part) => part.trim() !== "");
}

/** How long the list entry is with which the text begins. */
function entry_length(text: string): number {
  if (!text.startsWith("{")) {
    const next = /\n\s*-\s/.exec(text);
    return next ? next.index : text.length;
  }
  let depth = 0;
  for (let i = 0; i < text.length; ++i) {
    if (text[i] === "{") ++depth;
    if (text[i] === "}" && --depth === 0) return i + 1;
  }
  return text.length;
}

interface Line {
  indent: number;
  key: string;
  value: string;
  number: number;
}

function keys_of(text: string): Line[] {
  const found: Line[] = [];
  text.split("\n").forEach((line, index) => {
    const match = /^( *)("[^"]*"|'[^']*'|[^\s#:\-"'[{][^:#]*?)\s*:(?:\s+(.*))?$/.exec(line.trimEnd());
    if (!match) return;
    const value = (match[3] ?? "").replace(/(^|\s)#.*$/, "").trim();
    found.push({ indent: match[1]!.length, key: unquoted(match[2]!), value, number: index + 1 });
  });
  return found;
}

/** Lines one level below `lines[at]`. */
function children(lines: Line[], at: number): number[] {
  const found: number[] = [];
  const indent = lines[at]!.indent;
  let level = -1;
  for (let i = at + 1; i < lines.length && lines[i]!.indent > indent; ++i) {
    if (level < 0) level = lines[i]!.indent;
    if (lines[i]!.indent === level) found.push(i);
  }
  return found;
}

const child_called = (lines: Line[], at: number, key: string): number =>
  children(lines, at).find((i) => lines[i]!.key === key) ?? -1;

const top = (lines: Line[], key: string): number => lines.findIndex((line) => line.indent === 0 && line.key === key);

/** Entries below `components:` of the files, composites' instances among them. */
export function entries_of(texts: Texts): WrittenEntry[] {
  const found: WrittenEntry[] = [];
  for (const [file, text] of texts) {
    const lines = keys_of(text);
    const at = top(lines, "components");
    if (at < 0) continue;
    for (const i of children(lines, at)) found.push({ name: lines[i]!.key, file, line: lines[i]!.number });
  }
  return found;
}

/** The parameters of the files, with what they are if nobody sets them. */
export function parameters_of(texts: Texts): Map<string, string> {
  const found = new Map<string, string>();
  for (const text of texts.values()) {
    const lines = keys_of(text);
    const at = top(lines, "parameters");
    for (const i of at < 0 ? [] : children(lines, at)) found.set(lines[i]!.key, unquoted(lines[i]!.value));
  }
  return found;
}

export function composites_of(texts: Texts): Composite[] {
  const found: Composite[] = [];
  for (const [file, text] of texts) {
    const lines = keys_of(text);
    const at = top(lines, "composites");
    if (at < 0) continue;
    for (const i of children(lines, at)) {
      found.push({ name: lines[i]!.key, file, exports: exports_of(lines, i) });
    }
  }
  return found;
}

function exports_of(lines: Line[], composite: number): Map<string, string> {
  const found = new Map<string, string>();
  const at = child_called(lines, composite, "exports");
  if (at < 0) return found;
  for (const kind of children(lines, at)) {
    if (lines[kind]!.value.startsWith("{")) add_flow(lines[kind]!.value, found);
    for (const i of children(lines, kind)) found.set(lines[i]!.value, lines[i]!.key);
  }
  return found;
}

function add_flow(flow: string, to: Map<string, string>): void {
  for (const part of split_flow(flow.slice(1, -1))) {
    const [name, path] = part.split(":").map((word) => unquoted(word.trim()));
    if (name && path) to.set(path, name);
  }
}

/** The lines of an entry. */
export function text_of_entry(texts: Texts, entry: WrittenEntry): string {
  const lines = (texts.get(entry.file) ?? "").split("\n").slice(entry.line - 1);
  const indent = /^ */.exec(lines[0] ?? "")![0].length;
  const end = lines.findIndex((line, i) => i > 0 && line.trim() !== "" && /^ */.exec(line)![0].length <= indent);
  return lines.slice(0, end < 0 ? undefined : end).join("\n");
}

/** The model that an entry names; empty if it is not to be seen. */
export function model_of(texts: Texts, entry: WrittenEntry): string {
  const text = text_of_entry(texts, entry);
  return /\bmodel:\s*["']?([\w.]+)/.exec(text)?.[1] ?? /^[^:\n]*:\s*([\w.]+)\s*(?:#.*)?$/m.exec(text)?.[1] ?? "";
}

/** Whether `name` is one of those that the written `pattern`, `Joint{1..7}`, makes. */
export function is_made_by(pattern: string, name: string): boolean {
  if (pattern === name) return true;
  const range = /^(.*?)\{\d*\$?.*?\.\..*\}(.*)$/.exec(pattern);
  if (!range) return false;
  const middle = name.slice(range[1]!.length, name.length - range[2]!.length);
  return name.startsWith(range[1]!) && name.endsWith(range[2]!) && /^\d+$/.test(middle);
}

/** `Joint{1..7}` as connections name it, `Joint{i}`; a plain name stays. */
export const indexed = (pattern: string): string => pattern.replace(/\{[^}]*\.\..*\}/, "{i}");
