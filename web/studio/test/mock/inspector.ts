// SPDX-License-Identifier: Apache-2.0
// Stands for the Inspector of a run: numbers that swing.
import type { ApplicationStatus, CommandStatus, ComponentStatus, Cycle, Inspector, Pace } from "../../src/backend.ts";
import type { MockWorkbench } from "./workbench.ts";

const kNone = { value: "", unit: "", type: "", kind: "", error: "" };

export class MockInspector implements Inspector {
  readonly called: string[] = [];
  cycles = 0;  ///< how many were asked for
  private readonly items = new Map<number, string[]>();
  private readonly numbers = new Map<string, number>();
  private readonly stopped = new Set<string>();
  private handles = 0;
  jogs = false;
  private time = 0;
  private last = Date.now();
  private now: Pace = { rate: 1, paused: false };
  private up = false;

  constructor(private readonly workbench: MockWorkbench) {
    workbench.on_state = (state) => {
      this.up = state === "running";
      this.time = 0;
      this.last = Date.now();
    };
  }

  private tick(): void {
    if (!this.up) throw new Error("'run' is not there: nothing runs");
    const here = Date.now();
    if (!this.now.paused) this.time += ((here - this.last) / 1000) * Math.min(this.now.rate, 100);
    this.last = here;
  }

  async application(): Promise<ApplicationStatus> {
    this.tick();
    const { application, threads } = this.workbench.checked();
    return {
      name: application, time: this.time, simulated: true, mode: "", faults: BigInt(this.stopped.size), reactions: 0n,
      threads: threads.map(({ name, activity, order }, i) => ({
        name, activity: `every ${(activity.period_ns ?? 0) / 1e6} ms`, components: order.length, cycles: BigInt(Math.floor(this.time * 100)), skipped: 0n,
        log_lines_dropped: 0n, cycle_median: 31 + 8 * i, cycle_high: 64 + i, cycle_most: 120, load: 4 + 17 * i, latency_median: 3.1, latency_most: 44,
      })),
    };
  }

  async components(): Promise<ComponentStatus[]> {
    this.tick();
    return this.workbench.checked().components.map(({ name, model, thread }, i) => ({
      name, model, thread: thread ?? "", autostart: true, start_order: i,
      state: this.stopped.has(name) ? "Stopped" : name === "PID3" ? "Exception" : "Running", reason: name === "PID3" ? "its input Sen is 0.3 s old, 0.1 s are allowed" : "",
    }));
  }

  faults = async () => ({ faults: 0n, reactions: 0n, components: [] });
  describe = async (): Promise<never> => {
    throw new Error("not in tests");
  };
  read = async (items: string[]) => items.map((item) => ({ ...kNone, item, value: `${item} is read`, written: true, age: 0 }));

  async write(item: string, value: string) {
    this.called.push(`${item} = ${value}`);
    return { ...kNone, item, value, written: true, age: 0 };
  }

  async call(component: string, operation: string, words: string[]) {
    this.called.push(`${component}.${operation}(${words.join(", ")})`);
    if (operation === "keepJogging") return { given: true, type: "bool", value: String(this.jogs) };
    if (operation === "turn") this.numbers.set(`${component}.On`, words[0] === "true" ? 1 : 0);
    return { given: false, type: "", value: "" };
  }

  async begin(component: string, command: string, words: string[]): Promise<CommandStatus> {
    this.called.push(`${component}.${command}(${words.join(", ")})`);
    if (command === "jog") {
      this.jogs = true;
      return { handle: ++this.handles, command: `${component}.jog`, stage: "under way", ended: false, progress: 0, reason: "" };
    }
    if (command === "move") this.numbers.set(`${component}.Out`, Number(words[0]));
    return { handle: ++this.handles, command: `${component}.${command}`, stage: "done", ended: true, progress: 1, reason: "" };
  }

  follow = async (handle: number): Promise<CommandStatus> => ({ handle, command: "", stage: "done", ended: true, progress: 1, reason: "" });

  async cancel(handle: number): Promise<CommandStatus> {
    this.called.push("cancel");
    this.jogs = false;
    return this.follow(handle);
  }

  async change(component: string, change: string): Promise<ComponentStatus> {
    if (change === "stop") this.stopped.add(component);
    else this.stopped.delete(component);
    return (await this.components()).find((one) => one.name === component)!;
  }

  async watch(items: string[]) {
    this.tick();
    const all = items.flatMap((item) => (/\.(sensor|nAxesDesiredPosition)$/.test(item) ? [1, 2, 3, 4, 5, 6, 7].map((i) => `${item}[${i}]`) : [item]));
    this.items.set(++this.handles, all);
    return { handle: this.handles, items: all.map((item) => ({ item, unit: "rad" })) };
  }

  async watched(handle: number) {
    this.tick();
    const items = this.items.get(handle) ?? [];
    const values = items.map((item, i) => this.numbers.get(item) ?? (/\.(On|Armed)$/.test(item) ? 1 : Math.sin(this.time * 3 + i) * (0.5 + 0.1 * i)));
    return { values, ages: items.map(() => 0.004), replaced: 0n };
  }

  /** Each component takes its turn. */
  async cycle(thread: string): Promise<Cycle> {
    this.tick();
    ++this.cycles;
    const order = this.workbench.checked().threads.find(({ name }) => name === thread)?.order ?? [];
    const steps = order.map((component, i) => ({ component, begin: 2 + 4.5 * i, length: 1 + (i % 3) * 1.25 }));
    return { number: BigInt(Math.floor(this.time * 100)), time: this.time, length: 4.5 * order.length + 2, steps, left_out: 0n };
  }

  end_watch = async (handle: number) => this.items.delete(handle);
  pace = async () => this.now;
  set_pace = async (pace: Pace) => (this.now = pace);

  async step() {
    this.time += 0.01;
    return this.now;
  }
}
