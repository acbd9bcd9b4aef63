// SPDX-License-Identifier: Apache-2.0
// Numbers of the run, at up to 60 Hz: one watch for all that is shown. Views give the elements in
// which the numbers stand, so that no view is made anew for a number.
import { message_of } from "./backend.ts";
import { is_up, inspector, run } from "./run.ts";

/** Told what an item has: its numbers, and the age of the oldest. */
export type Taker = (numbers: number[], age: number) => void;

const kInterval = 1 / 60;
const kMostItems = 256;

const takers = new Map<string, Set<Taker>>();
const numberless = new Set<string>();  ///< items that the run said have no numbers
let handle = -1;
let watched: string[] = [];   ///< the asked item of each number
let stale = true;             ///< other items than those that are watched are shown
let opening = false;
let asking = false;

/** Calls `taker` with each new value of an item of the run, `Joint1.Position`; returns what ends it. */
export function watch(item: string, taker: Taker): () => void {
  const all = takers.get(item) ?? new Set();
  takers.set(item, all.add(taker));
  if (all.size === 1) stale = true;
  return () => {
    all.delete(taker);
    if (all.size === 0 && takers.get(item) === all) {
      takers.delete(item);
      stale = true;
    }
  };
}

export function start_values(): void {
  const frame = () => {
    void ask();
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
  run.subscribe(() => {
    if (is_up(run.get().state)) return;
    handle = -1;
    stale = true;
    numberless.clear();
  });
}

async function ask(): Promise<void> {
  if (!is_up(run.get().state) || opening || asking) return;
  if (stale) return open();
  if (handle < 0) return;
  asking = true;
  try {
    hand_out(await inspector().watched(handle));
  } catch {
    retry_soon();
  } finally {
    asking = false;
  }
}

async function open(): Promise<void> {
  opening = true;
  try {
    const old = handle;
    handle = -1;
    stale = false;
    if (old >= 0) await inspector().end_watch(old);
    const items = [...takers.keys()].filter((item) => !numberless.has(item)).slice(0, kMostItems);
    if (items.length === 0) return;
    const opened = await inspector().watch(items, kInterval);
    watched = opened.items.map(({ item }) => owner_of(item, items));
    handle = opened.handle;
  } catch (error) {
    leave_out(message_of(error));
  } finally {
    opening = false;
  }
}

/** One item without numbers refuses the whole watch; it goes on without that one. */
function leave_out(message: string): void {
  const item = [...takers.keys()].find((one) => message.includes(`'${one}'`));
  if (!item) return retry_soon();
  numberless.add(item);
  stale = true;
}

function retry_soon(): void {
  handle = -1;
  setTimeout(() => (stale = true), 1000);
}

/** Of `Sensor.sensor[2]` the item that was asked for, `Sensor.sensor`. */
function owner_of(item: string, items: string[]): string {
  const plain = item.replace(/\[\d+\].*$/, "");
  return items.includes(item) ? item : items.includes(plain) ? plain : items.find((one) => item.startsWith(`${one}.`)) ?? item;
}

function hand_out({ values, ages }: { values: number[]; ages: number[] }): void {
  const found = new Map<string, { numbers: number[]; age: number }>();
  values.forEach((value, i) => {
    const item = watched[i] ?? "";
    const known = found.get(item) ?? { numbers: [], age: 0 };
    known.numbers.push(value);
    known.age = Math.max(known.age, ages[i] ?? 0);
    found.set(item, known);
  });
  for (const [item, { numbers, age }] of found) {
    for (const taker of takers.get(item) ?? []) taker(numbers, age);
  }
}

/** `0.503`, `-12.1`, `1.2e+6`: at most seven characters. */
export function number_text(value: number): string {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "inf" : "-inf";
  const size = Math.abs(value);
  if (value === 0) return "0";
  if (size >= 1e6 || size < 1e-4) return value.toExponential(1);
  return Number.isInteger(value) ? String(value) : String(Number(value.toFixed(size >= 100 ? 1 : 3)));
}

/** What changes all the time, as wide as it was; nothing is `-0.000`. */
export const fixed_text = (value: number, digits = 3): string => value.toFixed(digits).replace(/^-(0\.0+)$/, "$1");

export const with_unit = (text: string, unit: string): string => (unit ? `${text} ${unit}` : text);

/** `true` while it is one, or all, of several. */
export const truth_text = (numbers: number[]): string => (numbers.every((one) => one > 0) ? "true" : numbers.some((one) => one > 0) ? "some" : "false");

/** One number, or the least and the greatest of several; once if they read the same. */
export function numbers_text(numbers: number[]): string {
  if (numbers.length === 0) return "";
  if (numbers.length <= 2) return numbers.map(number_text).join(", ");
  const short = (value: number) => number_text(Number(value.toPrecision(2)));
  const [least, greatest] = [short(Math.min(...numbers)), short(Math.max(...numbers))];
  return least === greatest ? least : `${least} … ${greatest}`;
}

/** `12.3 us`, `1.25 ms`. */
export const microseconds_text = (value: number): string => (value >= 1000 ? `${(value / 1000).toFixed(2)} ms` : `${value.toFixed(1)} us`);

export function age_text(seconds: number): string {
  if (Number.isNaN(seconds)) return "never written";
  if (seconds < 1) return `${Math.round(seconds * 1000)} ms old`;
  return `${seconds.toFixed(seconds < 10 ? 1 : 0)} s old`;
}
