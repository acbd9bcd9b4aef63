// SPDX-License-Identifier: Apache-2.0
// How one text becomes another, in few small replacements, so that an editor keeps its cursor.

/** `text.slice(from, to)` becomes `insert`; offsets are of the old text. */
export interface Replacement {
  from: number;
  to: number;
  insert: string;
}

const kMostCells = 4_000_000;

const lines_of = (text: string): string[] => text.split(/(?<=\n)/);

function common_prefix(a: string, b: string): number {
  const most = Math.min(a.length, b.length);
  let count = 0;
  while (count < most && a[count] === b[count]) ++count;
  return count;
}

function common_suffix(a: string, b: string, most: number): number {
  let count = 0;
  while (count < most && a[a.length - 1 - count] === b[b.length - 1 - count]) ++count;
  return count;
}

/** One replacement from the first to the last difference. */
function narrowed(old: string, now: string, offset: number): Replacement[] {
  if (old === now) return [];
  const prefix = common_prefix(old, now);
  const suffix = common_suffix(old, now, Math.min(old.length, now.length) - prefix);
  const insert = now.slice(prefix, now.length - suffix);
  return [{ from: offset + prefix, to: offset + old.length - suffix, insert }];
}

/** Lengths of the longest common series of lines behind each pair, in rows of b.length + 1. */
function common_lines(a: string[], b: string[]): Uint32Array {
  const width = b.length + 1;
  const table = new Uint32Array((a.length + 1) * width);
  for (let i = a.length - 1; i >= 0; --i) {
    for (let j = b.length - 1; j >= 0; --j) {
      const at = i * width + j;
      table[at] = a[i] === b[j] ? table[at + width + 1]! + 1 : Math.max(table[at + width]!, table[at + 1]!);
    }
  }
  return table;
}

/** Replacements of runs of lines, each narrowed to what differs in it; in order, apart. */
export function replacements(old: string, now: string): Replacement[] {
  const rough = narrowed(old, now, 0)[0];
  if (!rough) return [];
  const begin = rough.from === 0 ? 0 : old.lastIndexOf("\n", rough.from - 1) + 1;
  const behind = old.indexOf("\n", rough.to);
  const end = behind < 0 ? old.length : behind + 1;
  const a = lines_of(old.slice(begin, end));
  const b = lines_of(now.slice(begin, now.length - (old.length - end)));
  if (a.length * b.length > kMostCells) return [rough];
  return by_lines(a, b, begin);
}

function by_lines(a: string[], b: string[], begin: number): Replacement[] {
  const table = common_lines(a, b);
  const width = b.length + 1;
  const found: Replacement[] = [];
  let offset = begin;
  let removed = "";
  let added = "";
  const close = () => {
    found.push(...narrowed(removed, added, offset));
    offset += removed.length;
    removed = added = "";
  };
  for (let i = 0, j = 0; i < a.length || j < b.length; ) {
    if (i < a.length && j < b.length && a[i] === b[j]) {
      close();
      offset += a[i]!.length;
      ++i;
      ++j;
    } else if (j >= b.length || (i < a.length && table[(i + 1) * width + j]! >= table[i * width + j + 1]!)) {
      removed += a[i++];
    } else {
      added += b[j++];
    }
  }
  close();
  return found;
}
