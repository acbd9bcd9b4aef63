// SPDX-License-Identifier: Apache-2.0
// One cycle of a thread: which component ran when. The thread records cycles only while somebody looks.
import { useEffect, useState } from "react";
import { type Cycle, message_of } from "./backend.ts";
import { duration_text } from "./checked.ts";
import { project } from "./project.ts";
import { inspector, is_up, run } from "./run.ts";
import { microseconds_text } from "./values.ts";

const kInterval = 400;  ///< between two looks [ms]
const kTicks = 2;       ///< of the scale

/** What one component did in a cycle. */
interface Part {
  component: string;
  length: number;                               ///< of all its steps [us]
  steps: { begin: number; length: number }[];   ///< since the cycle's begin [us]
}

/** The components in the order in which they first ran. */
export function parts_of({ steps }: Cycle): Part[] {
  const parts = new Map<string, Part>();
  for (const { component, begin, length } of steps) {
    const part = parts.get(component) ?? { component, length: 0, steps: [] };
    part.length += length;
    part.steps.push({ begin, length });
    parts.set(component, part);
  }
  return [...parts.values()];
}

export function CycleView() {
  const application = run.use((all) => all.application);
  const [wanted, set_wanted] = useState("");
  const [held, set_held] = useState(false);
  const threads = (application?.threads ?? []).filter((one) => one.components > 0);
  const thread = (threads.find((one) => one.name === wanted) ?? threads[0])?.name ?? "";
  const { cycle, trouble } = useCycle(thread, held);
  if (!application) return <p className="hint">Run the application: what its components do in one cycle of a thread stands here, in microseconds.</p>;
  return (
    <div className="cycle scroll" tabIndex={0} role="region" aria-label="Cycle">
      <div className="row">
        <label>Thread <select aria-label="Thread" value={thread} onChange={(event) => set_wanted(event.target.value)}>{threads.map(({ name }) => <option key={name}>{name}</option>)}</select></label>
        <button type="button" aria-pressed={held} onClick={() => set_held(!held)} title="Keeps this cycle and looks at no other">Hold</button>
        <span className="about">{trouble || (cycle ? about(cycle, thread) : "")}</span>
      </div>
      {cycle && cycle.number > 0n && <Bars cycle={cycle} />}
    </div>
  );
}

/** The newest cycle that was recorded, while the view is open and not held. */
function useCycle(thread: string, held: boolean): { cycle?: Cycle; trouble: string } {
  const up = run.use((all) => is_up(all.state));
  const [seen, set_seen] = useState<{ thread: string; cycle?: Cycle; trouble: string }>({ thread, trouble: "" });
  useEffect(() => {
    if (!up || !thread || held) return;
    let over = false;
    const look = async () => {
      const found = await inspector().cycle(thread).then((cycle) => ({ cycle, trouble: "" }), (error: unknown) => ({ trouble: message_of(error) }));
      if (over) return;
      set_seen({ thread, ...found });
      timer = setTimeout(look, kInterval);
    };
    let timer = setTimeout(look, 0);
    return () => {
      over = true;
      clearTimeout(timer);
    };
  }, [up, thread, held]);
  return seen.thread === thread ? seen : { trouble: "" };
}

function about(cycle: Cycle, thread: string): string {
  if (cycle.number === 0n) return "The thread has run no cycle since it was asked for one.";
  const period = project.get().shown?.threads.find((one) => one.name === thread)?.activity.period_ns ?? 0;
  const share = period > 0 ? ` of ${duration_text(period)}, ${((cycle.length / (period / 1e3)) * 100).toFixed(1)} %` : "";
  const lost = cycle.left_out > 0n ? `; ${cycle.left_out} steps found no room` : "";
  return `Cycle ${cycle.number} at ${cycle.time.toFixed(3)} s: ${microseconds_text(cycle.length)}${share}${lost}`;
}

function Bars({ cycle }: { cycle: Cycle }) {
  const lane = (component: string) => {
    const { shown } = project.get();
    const thread = shown?.components.find((one) => one.name === component)?.thread;
    return shown?.threads.findIndex((one) => one.name === thread) ?? -1;
  };
  const percent = (time: number) => `${Math.min(100, (time / (cycle.length || 1)) * 100)}%`;
  return (
    <table className="bars">
      <thead>
        <tr><th>Component</th><th>Time</th><th className="scale" aria-label="When it ran"><Scale length={cycle.length} /></th></tr>
      </thead>
      <tbody>
        {parts_of(cycle).map(({ component, length, steps }) => (
          <tr key={component}>
            <th scope="row">{component || "others"}</th>
            <td>{microseconds_text(length)}</td>
            <td className="track" data-lane={lane(component)}>
              {steps.map(({ begin, length: long }, i) => (
                <span key={i} className="bar" style={{ left: percent(begin), width: percent(long) }} title={`from ${microseconds_text(begin)} to ${microseconds_text(begin + long)}`} />
              ))}
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Scale({ length }: { length: number }) {
  const ticks = Array.from({ length: kTicks + 1 }, (_, i) => i / kTicks);
  return <>{ticks.map((at) => <span key={at} style={{ left: `${at * 100}%` }} aria-hidden="true">{microseconds_text(at * length)}</span>)}</>;
}
