// SPDX-License-Identifier: Apache-2.0
// Time that passes only when a test says so. The one of node:test loses timers in Node.js 18, which
// Debian 12 has.
interface Timer {
  due: number;
  period?: number;
  run: () => void;
}

const real = { setTimeout, clearTimeout, setInterval, clearInterval, now: Date.now };
let now = 0;
let last = 0;
const timers = new Map<number, Timer>();

function begin(run: () => void, delay: number, period?: number): number {
  timers.set(++last, { due: now + delay, run, ...(period !== undefined && { period }) });
  return last;
}

const end = (id: unknown): void => void timers.delete(id as number);

/** From now on, until `go_on`. */
export function stop_time(): void {
  now = 0;
  timers.clear();
  Object.assign(globalThis, {
    setTimeout: (run: () => void, delay = 0) => begin(run, delay),
    setInterval: (run: () => void, period: number) => begin(run, period, period),
    clearTimeout: end,
    clearInterval: end,
  });
  Date.now = () => now;
}

export function go_on(): void {
  const { now: date, ...functions } = real;
  Object.assign(globalThis, functions);
  Date.now = date;
}

/** Runs what is due in the next milliseconds, in its order. */
export function tick(ms: number): void {
  const until = now + ms;
  for (;;) {
    const [next] = [...timers].filter(([, { due }]) => due <= until).sort(([, a], [, b]) => a.due - b.due);
    if (!next) break;
    const [id, timer] = next;
    now = timer.due;
    if (timer.period === undefined) timers.delete(id);
    else timer.due += timer.period;
    timer.run();
  }
  now = until;
}
