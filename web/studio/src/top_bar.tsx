// SPDX-License-Identifier: Apache-2.0
import { has_nothing_yet } from "./checked.ts";
import { useElsewhere } from "./elsewhere.ts";
import { is_saved, project, redo, reload, save, undo } from "./project.ts";
import { is_going, is_up, pause, run, set_pace, start, step, stop } from "./run.ts";
import { emergency_stop } from "./emergency.ts";
import { RunSettings } from "./run_settings.tsx";
import { counted } from "./scene.ts";
import { SeatView } from "./seat_view.tsx";
import { type Beside, selection } from "./selection.ts";

const kNone: never[] = [];
const kPaces: [number, string][] = [[0.1, "0.1 ×"], [1, "1 ×"], [10, "10 ×"], [Infinity, "fastest"]];

export function TopBar() {
  return (
    <header className="top-bar">
      <FileState />
      <EditButtons />
      <ViewButtons />
      <RunControls />
      <RunTime />
      <div className="safety">
        <div className="stops" role="group" aria-label="Stop">
          <StopButton />
          <EmergencyButton />
        </div>
        <SeatView />
      </div>
    </header>
  );
}

function FileState() {
  const state = project.use((all) => all.state);
  const name = state.elsewhere || state.file.split("/").pop() || "…";
  if (state.elsewhere) return <div className="file"><h1 title={state.file}>{name}</h1></div>;
  const saved = is_saved(state);
  return (
    <div className="file">
      <h1 title={state.file}>{name}</h1>
      <span className={saved ? "saved" : "changed"} role="status">{saved ? "saved" : "changed"}</span>
    </div>
  );
}

function EditButtons() {
  const state = project.use((all) => all.state);
  if (state.elsewhere) {
    return <div className="group" role="group" aria-label="Edit"><button type="button" title="Asks the application anew what it is made of, and what its properties are now" onClick={() => void reload()}>Read anew</button></div>;
  }
  return (
    <div className="group" role="group" aria-label="Edit">
      <button type="button" disabled={!state.undo} title={state.undo ? `Undo ${state.undo} (Ctrl+Z)` : "Nothing to undo"} onClick={() => void undo()}>Undo</button>
      <button type="button" disabled={!state.redo} title={state.redo ? `Redo ${state.redo} (Ctrl+Shift+Z)` : "Nothing to redo"} onClick={() => void redo()}>Redo</button>
      <button type="button" disabled={is_saved(state)} title="Ctrl+S" onClick={() => void save()}>Save</button>
      <button type="button" title="Takes what the disk has, libraries that were built anew among it; Undo takes it back" onClick={() => void reload()}>Reload</button>
    </div>
  );
}

/** What stands beside the canvas. */
function ViewButtons() {
  const beside = selection.use((all) => all.beside);
  const elsewhere = useElsewhere();
  const toggle = (what: Beside) => selection.set({ beside: beside === what ? "" : what });
  return (
    <div className="group" role="group" aria-label="Beside the canvas">
      {!elsewhere && <button type="button" aria-pressed={beside === "text"} onClick={() => toggle("text")}>Text</button>}
      <button type="button" aria-pressed={beside === "robot"} onClick={() => toggle("robot")}>Robot</button>
    </div>
  );
}

function RunControls() {
  return useElsewhere() ? <FarPace /> : <OwnRun />;
}

/** Of simulated time elsewhere. */
function FarPace() {
  const { state } = run.use((all) => all);
  if (!is_up(state) || !state.simulated) return null;
  return <div className="group" role="group" aria-label="Simulated time"><Pace going /><Pausing /></div>;
}

function Pace({ going }: { going: boolean }) {
  const { state, simulated, pace, now } = run.use((all) => all);
  const rate = now?.rate ?? pace;
  const known = kPaces.some(([value]) => value === rate);
  return (
    <select aria-label="Pace of simulated time" value={String(rate)} disabled={going ? !(is_up(state) && state.simulated) : !simulated}
      onChange={(event) => void set_pace(Number(event.target.value))}>
      {kPaces.map(([value, label]) => <option key={label} value={String(value)}>{label}</option>)}
      {!known && <option value={String(rate)}>{`${rate} ×`}</option>}
    </select>
  );
}

function Pausing() {
  const { state, now } = run.use((all) => all);
  const live_sim = is_up(state) && state.simulated;
  return (
    <>
      <button type="button" disabled={!live_sim} onClick={() => void pause(!now?.paused)}>{now?.paused ? "Go on" : "Pause"}</button>
      <button type="button" disabled={!live_sim || !now?.paused} title="On to the next instant at which something is due" onClick={() => void step()}>Step</button>
    </>
  );
}

function OwnRun() {
  const { state, simulated } = run.use((all) => all);
  const saved = project.use((all) => is_saved(all.state));
  const errors = project.use((all) => all.checked?.errors ?? 0);
  const empty = project.use((all) => all.checked !== undefined && has_nothing_yet(all.checked));
  const going = is_going(state);
  return (
    <div className="group" role="group" aria-label="Run">
      <select aria-label="Time" value={simulated ? "simulated" : "real"} disabled={going}
        onChange={(event) => run.set({ simulated: event.target.value === "simulated" })}>
        <option value="simulated">Simulated</option>
        <option value="real">Real time</option>
      </select>
      <Pace going={going} />
      <ModeChoice going={going} />
      <RunSettings going={going} />
      <button type="button" className="primary" disabled={going || errors > 0} onClick={() => void start()}
        title={empty ? "Add a component first" : errors > 0 ? "Mend the errors below first" : "Starts the application"}>
        {saved ? "Run" : "Save and run"}
      </button>
      <Pausing />
    </div>
  );
}

/** Of the modes that the deployment has. */
function ModeChoice({ going }: { going: boolean }) {
  const modes = project.use((all) => all.shown?.modes ?? kNone);
  const chosen = run.use((all) => all.mode);
  const now = run.use((all) => all.application?.mode ?? "");
  if (modes.length === 0) return null;
  const shown = going ? now : modes.find((one) => one.name === chosen)?.name;
  return (
    <select aria-label="Mode" title="The mode in which the next run starts; what the file says is changed under Modes" value={shown || modes.find((one) => one.initial)?.name} disabled={going}
      onChange={(event) => run.set({ mode: event.target.value })}>
      {modes.map(({ name }) => <option key={name}>{name}</option>)}
    </select>
  );
}

function RunTime() {
  const state = run.use((all) => all.state);
  const time = run.use((all) => all.application?.time);
  const faults = run.use((all) => Number(all.application?.faults ?? 0));
  const paused = run.use((all) => all.now?.paused ?? false);
  return (
    <div className={`run-state is-${has_failed(state.state, state.exit_code) ? "failed" : state.state}`}>
      <span role="status">{state_text(state.state, state.exit_code, paused)}</span>
      {time !== undefined && <span className="time">{`${time.toFixed(2)} s`}</span>}
      {has_failed(state.state, state.exit_code) && <button type="button" className="faults" title="What the run said last" onClick={() => selection.set({ tab: "log" })}>See the log</button>}
      {faults > 0 && <button type="button" className="faults" onClick={() => selection.set({ tab: "threads" })}>{counted(faults, "fault")}</button>}
    </div>
  );
}

function state_text(state: string, exit_code: number, paused: boolean): string {
  if (state === "none") return "not run yet";
  if (state === "lost") return "not there";
  if (state === "ended") return end_text(exit_code);
  return paused ? "paused" : state;
}

const has_failed = (state: string, exit_code: number): boolean => state === "ended" && exit_code > 0;

const kSignals = 128;  ///< codes above are of what a signal ended
const kCrashes = new Map([[4, "illegal instruction"], [6, "aborted"], [7, "bus error"], [8, "division by zero"], [11, "segmentation fault"]]);
const kKilled = [9, 15];

/** As docs/command_line.md has the codes. -1: a run that an earlier studio has started; nobody knows how it ended. */
function end_text(exit_code: number): string {
  if (exit_code <= 0) return "ended";
  const crash = kCrashes.get(exit_code - kSignals);
  if (crash) return `crashed: ${crash}`;
  if (kKilled.includes(exit_code - kSignals)) return "was killed";
  if (exit_code === 1) return "failed";
  if (exit_code === 4) return "ended by a safety reaction";
  return `ended with code ${exit_code}`;
}

/** Always at the same place, and never disabled: what it does is safe at any time. */
function StopButton() {
  const stopping = run.use((all) => all.state.state === "stopping");
  if (useElsewhere()) return null;  // it is stopped where it runs
  return (
    <button type="button" className="stop" title="Stops the run in order; a second time at once (Shift+Esc)"
      onClick={() => void stop()}>
      {stopping ? "Stop now" : "Stop"}
    </button>
  );
}

/** Likewise; from every browser, whoever sits at the seat. */
function EmergencyButton() {
  return (
    <button type="button" className="emergency" aria-keyshortcuts="F8" onClick={() => void emergency_stop()}
      title="Disarms the robot at once; where nothing can be disarmed, stops a run of this studio. F8 does it, too, wherever you are. It replaces no emergency switch.">
      E-stop <small>F8 · replaces no switch</small>
    </button>
  );
}
