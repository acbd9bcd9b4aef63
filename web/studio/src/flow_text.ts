// SPDX-License-Identifier: Apache-2.0
// YAML of lines as YAML on one line, as far as lists and maps of a deployment need it: no anchors, no texts of several lines.
import { split_flow, text_of_entry, type Texts, type WrittenEntry } from "./written.ts";

const indent_of = (line: string): number => /^ */.exec(line)![0].length;

const without_comment = (line: string): string => line.replace(/(^|\s)#.*$/, "").trimEnd();

/** Lines of a list, a map or a text, without comments, on one line. */
export function flow_of(text: string): string {
  return flow(text.split("\n").map(without_comment).filter((line) => line.trim() !== ""));
}

function flow(lines: string[]): string {
  const first = lines[0]?.trim() ?? "";
  if (/^-(\s|$)/.test(first)) return `[${groups_of(lines).map((item) => flow([item[0]!.replace("-", " "), ...item.slice(1)])).join(", ")}]`;
  if (!/^[[{]/.test(first) && /^[^\s:]+:(\s|$)/.test(first)) return `{${groups_of(lines).map(entry).join(", ")}}`;
  return lines.map((line) => line.trim()).join(" ");
}

/** Lines that belong together: each group begins at the column of the first line. */
function groups_of(lines: string[]): string[][] {
  const column = indent_of(lines[0]!);
  const is_list = /^-(\s|$)/.test(lines[0]!.trim());
  const groups: string[][] = [];
  for (const line of lines) {
    const begins = indent_of(line) <= column && /^-(\s|$)/.test(line.trim()) === is_list;
    if (begins) groups.push([line]);
    else groups.at(-1)?.push(line);
  }
  return groups;
}

function entry([first = "", ...rest]: string[]): string {
  const [, key = first.trim(), value = ""] = /^\s*([^\s:]+):\s*(.*)$/.exec(first) ?? [];
  return `${key}: ${value ? [value, ...rest.map((line) => line.trim())].join(" ") : flow(rest)}`;
}

/** What a map or list in brackets has inside; empty if it is none. */
const inside_of = (text: string): string => /^[[{]([\s\S]*)[\]}]$/.exec(text.trim())?.[1] ?? "";

/** The values of a map on one line, by key. */
export function map_of(text: string): Map<string, string> {
  return new Map(split_flow(inside_of(text)).flatMap((part): [string, string][] => {
    const colon = /:(\s|$)/.exec(part)?.index ?? -1;
    return colon > 0 ? [[unquoted(part.slice(0, colon).trim()), part.slice(colon + 1).trim()]] : [];
  }));
}

/** The items of a list on one line, or the only one without brackets. */
export function items_of(text: string): string[] {
  const plain = text.trim();
  if (plain === "") return [];
  return plain.startsWith("[") ? split_flow(inside_of(plain)).map((part) => part.trim()) : [plain];
}

export const unquoted = (text: string): string => text.replace(/^(["'])(.*)\1$/, "$2");

/** What an entry says under a key, on one line; empty if it says nothing there. */
export function said_in(texts: Texts, written: WrittenEntry, key: string): string {
  const [body = ""] = [...map_of(flow_of(text_of_entry(texts, written))).values()];
  return map_of(body).get(key) ?? "";
}

/** What a file says under one of its own keys, on one line. */
export function section_of(text: string, key: string): string {
  const lines = text.split("\n").map(without_comment);
  const at = lines.findIndex((line) => line === `${key}:` || line.startsWith(`${key}: `));
  if (at < 0) return "";
  const end = lines.findIndex((line, i) => i > at && /^[^\s-}\]]/.test(line));
  return map_of(flow_of(lines.slice(at, end < 0 ? undefined : end).join("\n"))).get(key) ?? "";
}
