// SPDX-License-Identifier: Apache-2.0
import type { ThreadStatus } from "./backend.ts";
import { change_component, run } from "./run.ts";
import { select_box } from "./selection.ts";
import { scene } from "./scene.ts";
import { reason_text, state_class } from "./states.ts";
import { project } from "./project.ts";
import { microseconds_text } from "./values.ts";

const kHighLoad = 70;  ///< [%]

/** How the threads keep their periods, and which components do not run. */
export function Threads() {
  const application = run.use((all) => all.application);
  if (!application) return <p className="hint">Run the application: its threads, their loads and how late they are stand here.</p>;
  return (
    <div className="scroll" tabIndex={0} aria-label="Threads">
      <Idle />
      <table>
        <thead>
          <tr><th>Thread</th><th>Activity</th><th>Components</th><th>Cycles</th><th>Skipped</th><th>Cycle, median</th><th>Cycle, 99.9 %</th><th>Load</th><th>Late, median</th><th>Late, most</th></tr>
        </thead>
        <tbody>{application.threads.map((thread) => <Row key={thread.name} thread={thread} />)}</tbody>
      </table>
    </div>
  );
}

function Row({ thread }: { thread: ThreadStatus }) {
  const lane = project.use((state) => state.shown?.threads.findIndex((one) => one.name === thread.name) ?? -1);
  return (
    <tr>
      <th scope="row" data-lane={lane}>{thread.name}</th>
      <td className="text">{thread.activity}</td>
      <td>{thread.components}</td>
      <td>{String(thread.cycles)}</td>
      <td className={thread.skipped > 0n ? "bad" : ""}>{String(thread.skipped)}</td>
      <td>{microseconds_text(thread.cycle_median)}</td>
      <td>{microseconds_text(thread.cycle_high)}</td>
      <td className={thread.load > kHighLoad ? "bad" : ""}>{thread.load > 0 ? `${thread.load.toFixed(1)} %` : "–"}</td>
      <td>{microseconds_text(thread.latency_median)}</td>
      <td>{microseconds_text(thread.latency_most)}</td>
    </tr>
  );
}

function Idle() {
  const components = run.use((all) => all.components);
  const idle = [...components.values()].filter((one) => one.state !== "Running" && (one.autostart || one.reason));
  if (idle.length === 0) return null;
  return (
    <section aria-label="Components that do not run">
      {idle.map((one) => (
        <div key={one.name} className={`problem ${state_class(one.state) === "is-faulty" ? "error" : "warning"}`}>
          <b>{one.state}</b>
          <span className="message"><button type="button" className="link" onClick={() => go_to(one.name)}>{one.name}</button>{one.reason && `: ${reason_text(one.state, one.reason)}`}</span>
          <button type="button" className="small" onClick={() => void change_component(one.name, state_class(one.state) === "is-faulty" ? "reset" : "start")}>
            {state_class(one.state) === "is-faulty" ? "Reset" : "Start"}
          </button>
        </div>
      ))}
    </section>
  );
}

function go_to(component: string): void {
  const box = scene().boxes.find((one) => one.components.some(({ name }) => name === component));
  if (box) select_box(box.id, true);
}
