// SPDX-License-Identifier: Apache-2.0
/**
 * What browsers cost that watch a run through the studio: 200 numbers at 60 Hz in four of them, the
 * server's share of a core and its memory, what four of them cost the run beside one, and the cycles of
 * the Janus head with and without them.
 * A browser here is a connection of its own in Node.js, which asks as the page does.
 *
 * usage: studio_watch.mjs PROGRAM ROBOTS [--seconds N] [--rounds N]
 *
 * Prints entries in the form of scripts/bench --json.
 */
import { type ChildProcess, spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { connect, type Peer } from "@armature/ride/tcp";
import { InspectorPlaceholder } from "@armature/placeholders/inspection.ts";
import { type RunState, WorkbenchPlaceholder } from "@armature/placeholders/workbench.ts";

const [program, robots] = process.argv.slice(2);
const option = (name: string, otherwise: number) => {
  const at = process.argv.indexOf(name);
  return at < 0 ? otherwise : Number(process.argv[at + 1]);
};
const seconds = option("--seconds", 10);
const rounds = option("--rounds", 3);

const kBrowsers = 4;
const kNumbers = 200;
const kRate = 60;
const kTicksPerSecond = 100;

const folder = mkdtempSync(join(tmpdir(), "studio_watch_"));
const pause = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

interface Studio {
  server: ChildProcess;
  address: string;
  peer: Peer;
  workbench: WorkbenchPlaceholder;
}

async function open(file: string): Promise<Studio> {
  const address = `unix:${join(folder, "studio.sock")}`;
  const server = spawn(program!, ["studio", file, "--listen", address, "--no-open"], {
    env: { ...process.env, XDG_STATE_HOME: folder },
    stdio: ["ignore", "ignore", "inherit"],
  });
  for (let tries = 0; ; ++tries) {
    try {
      const peer = await connect(address);
      return { server, address, peer, workbench: new WorkbenchPlaceholder(peer, "workbench") };
    } catch (error) {
      if (tries === 100) throw error;
      await pause(50);
    }
  }
}

async function close(studio: Studio) {
  studio.peer.close();
  studio.server.kill();
  await new Promise((resolve) => studio.server.once("exit", resolve));
}

async function until(workbench: WorkbenchPlaceholder, states: string[]): Promise<RunState> {
  for (;;) {
    const run = await workbench.run();
    if (states.includes(run.state)) return run;
    await pause(20);
  }
}

async function start(workbench: WorkbenchPlaceholder, overrides: string[] = []) {
  await workbench.start({ simulated: false, pace: 1, mode: "", overrides });
  const run = await until(workbench, ["running", "ended"]);
  if (run.state === "ended") throw new Error((await workbench.log(0)).join("\n"));
}

async function stop(workbench: WorkbenchPlaceholder) {
  await workbench.stop();
  await until(workbench, ["ended"]);
}

interface Seen {
  frames: number;
  ages: number[];
}

/** A browser that draws what it watches `kRate` times a second. */
async function watch(address: string, items: string[]): Promise<Seen> {
  const peer = await connect(address);
  const run = new InspectorPlaceholder(peer, "run");
  const { handle } = await run.watch(items, 1 / kRate);
  const seen: Seen = { frames: 0, ages: [] };
  const begin = performance.now();
  for (let due = begin; due < begin + 1000 * seconds; due += 1000 / kRate) {
    const early = due - performance.now();
    if (early > 0) await pause(early);
    const asked = performance.now();
    const values = await run.watched(handle);
    const way = (performance.now() - asked) / 1000;
    seen.frames += 1;
    // Until it is drawn a value is as old as it was when it was taken, and the way of the answer.
    seen.ages.push(way + Math.max(...values.ages.filter((age) => !Number.isNaN(age))));
  }
  peer.close();
  return seen;
}

const percentile = (values: number[], share: number) =>
  values.sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))]!;

/** Ticks that the process has taken, and its memory in MB. */
function taken(id: number): { ticks: number; resident: number } {
  const fields = readFileSync(`/proc/${id}/stat`, "utf8").split(") ")[1]!.split(" ");
  const status = readFileSync(`/proc/${id}/status`, "utf8");
  const kilobytes = /VmRSS:\s+(\d+)/.exec(status)![1];
  return { ticks: Number(fields[11]) + Number(fields[12]), resident: Number(kilobytes) / 1000 };
}

/** Seconds that the threads of a process were on a processor. */
function busy(id: number): number {
  const threads = readdirSync(`/proc/${id}/task`);
  const times = threads.map((thread) => Number(readFileSync(`/proc/${id}/task/${thread}/schedstat`, "utf8").split(" ")[0]));
  return times.reduce((sum, one) => sum + one, 0) / 1e9;
}

/** The run's process: `armature run` of what is in the folder. */
function run_process(): number {
  const is_run = (id: string) => {
    try {
      const words = readFileSync(`/proc/${id}/cmdline`, "utf8").split("\0");
      return words.includes("run") && words.some((word) => word.startsWith(folder));
    } catch {
      return false;  // it has ended
    }
  };
  return Number(readdirSync("/proc").filter((id) => /^\d+$/.test(id)).find(is_run));
}

function entry(name: string, value: number, unit: string, reference: number | null = null) {
  const ratio = reference === null ? null : value / reference;
  return { name, value, unit, reference, ratio, allocations: null };
}

function numbers(): string {
  const rows = Array.from({ length: kNumbers / 2 }, (_, i) => [
    `  Adder${i}: {model: Adder}\n  Limit${i}: {model: Limit, properties: {High: 1}}`,
    `  - Source.Out -> Adder${i}.In1\n  - Source.Out -> Adder${i}.In2\n  - Adder${i}.Out -> Limit${i}.In`,
  ]);
  return [
    "application: watched\nlibraries: [controls]\ncomponents:",
    "  Source: {model: Constant, activity: {periodic: 10 ms}, properties: {Value: 0.25}}",
    ...rows.map((row) => row[0]),
    "connections:",
    ...rows.map((row) => row[1]),
    "",
  ].join("\n");
}

async function measureWatching() {
  const file = join(folder, "watched.yaml");
  writeFileSync(file, numbers());
  const studio = await open(file);
  await start(studio.workbench);
  const items = Array.from({ length: kNumbers / 2 }, (_, i) => [`Adder${i}.Out`, `Limit${i}.Out`]).flat();
  const shares: number[] = [];
  const run = run_process();
  let seen: Seen[] = [];
  let before = taken(studio.server.pid!);
  for (const browsers of [0, 1, kBrowsers]) {
    before = taken(studio.server.pid!);
    const begun = busy(run);
    seen = await Promise.all(Array.from({ length: browsers }, () => watch(studio.address, items)));
    if (browsers === 0) await pause(1000 * seconds);
    shares.push(((busy(run) - begun) / seconds) * 100);
  }
  const [alone = 0, one = 0, all = 0] = shares;
  const after = taken(studio.server.pid!);
  await stop(studio.workbench);
  await close(studio);
  const slowest = Math.min(...seen.map((one) => one.frames)) / seconds;
  const load = (after.ticks - before.ticks) / kTicksPerSecond / seconds;
  return [
    entry("studio/watch_200_at_60hz/frames", slowest, "1/s"),
    entry("studio/watch_200_at_60hz/age_p99", 1000 * percentile(seen.flatMap((one) => one.ages), 0.99), "ms"),
    entry("studio/server_cpu", 100 * load, "%"),
    entry("studio/server_resident", after.resident, "MB"),
    entry("studio/run_cpu_of_4_browsers", all - alone, "%", one - alone),
  ];
}

/** The thread that controls the head, after a run that lasts so long. */
async function cycle(studio: Studio, browsers: number) {
  await start(studio.workbench, ["period=1ms", "PID1.Ki=2", "PID2.Ki=2"]);
  const run = new InspectorPlaceholder(studio.peer, "run");
  const items = [1, 2].flatMap((i) => [`Joint${i}.Position`, `PID${i}.Out`, `AIC${i}.DisplacementSensor`]);
  const watching = Array.from({ length: browsers }, () => watch(studio.address, items));
  await (browsers > 0 ? Promise.all(watching) : pause(1000 * seconds));
  const { threads } = await run.application();
  await stop(studio.workbench);
  return threads.reduce((most, one) => (one.components > most.components ? one : most));
}

async function measureCycles() {
  const studio = await open(join(robots!, "janus/deployments/pid.yaml"));
  await studio.workbench.take_seat();  // a run's overrides are the operator's
  const medians: number[][] = [[], []];
  const highs: number[][] = [[], []];
  const skipped = [0, 0];
  for (let round = 0; round < 2 * rounds; ++round) {
    const watched = round % 2;
    const thread = await cycle(studio, watched * kBrowsers);
    medians[watched]!.push(thread.cycle_median);
    highs[watched]!.push(thread.cycle_high);
    skipped[watched] += Number(thread.skipped);
  }
  await close(studio);
  const middle = (values: number[]) => percentile(values, 0.5);
  return [
    entry("studio/cycle_with_browsers/median", middle(medians[1]!), "us", middle(medians[0]!)),
    entry("studio/cycle_with_browsers/p99.9", middle(highs[1]!), "us", middle(highs[0]!)),
    entry("studio/cycle_with_browsers/skipped", skipped[1]!, "cycles"),
    entry("studio/cycle_without_browsers/skipped", skipped[0]!, "cycles"),
  ];
}

const entries = [...(await measureWatching()), ...(await measureCycles())];
console.log(JSON.stringify(entries, null, 1));
rmSync(folder, { recursive: true });
