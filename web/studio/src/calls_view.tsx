// SPDX-License-Identifier: Apache-2.0
// What a Sequence or a Request calls, in its order.
import { useState } from "react";
import { type Call, callable, calls_of, calls_text, moved, parameters_of_call } from "./calls.ts";
import { with_parameter } from "./event_command.ts";
import { Field } from "./field.tsx";
import { map_of } from "./flow_text.ts";
import type { Box } from "./graph.ts";
import { change, edit, project } from "./project.ts";
import { Refused } from "./refused.tsx";

/** Writes what the calls of this moment become. */
type Write = (to: (now: Call[]) => Call[], field?: string) => Promise<boolean>;

let last: Promise<unknown> = Promise.resolve();

/** An edit gives all calls: who types fast gives the next parameter before the one before is in the text. */
function one_after_the_other(act: () => Promise<boolean>): Promise<boolean> {
  const done = last.then(act);
  last = done.catch(() => undefined);
  return done;
}

export function Calls({ box, most }: { box: Box; most: number }) {
  const texts = project.use((state) => state.texts);
  const shown = project.use((state) => state.shown);
  const calls = calls_of(texts, box);
  if (!shown) return null;
  const offers = callable(shown, box);
  const about = `${box.id} calls`;
  const write: Write = (to, field = about) => one_after_the_other(() => {
    const now = calls_of(project.get().texts, box);
    return edit([change("calls", box.edited, calls_text(to(now)))], { field, file: box.file });
  });
  const several = most > 1;
  return (
    <section className="calls" aria-label="Calls">
      <h3>{several ? "Calls, one after the other" : "Asks"}</h3>
      <ol>
        {calls.map((call, i) => (
          <li key={i}>
            <One call={call} index={i} box={box} offers={offers} write={(to, field) => write((now) => now.map((one, k) => (k === i ? to(one) : one)), field)}>
              {several && <button type="button" className="unset" disabled={i === 0} aria-label={`Call ${call.to} earlier`} onClick={() => void write((now) => moved(now, i, -1))}>↑</button>}
              {several && <button type="button" className="unset" disabled={i === calls.length - 1} aria-label={`Call ${call.to} later`} onClick={() => void write((now) => moved(now, i, 1))}>↓</button>}
              <button type="button" className="unset" aria-label={`Call ${call.to} no more`} onClick={() => void write((now) => now.filter((_, k) => k !== i))}>×</button>
            </One>
          </li>
        ))}
      </ol>
      {calls.length < most && <Another offers={offers} add={(to) => write((now) => [...now, { to, with: "" }])} />}
      <Refused about={about} />
    </section>
  );
}

/** A call, and where each of its parameters comes from. */
function One({ call, index, box, offers, write, children }: {
  call: Call; index: number; box: Box; offers: string[]; write(to: (now: Call) => Call, field: string): Promise<boolean>; children: React.ReactNode;
}) {
  const shown = project.use((state) => state.shown)!;
  const give = (name: string, field: string) => (value: string) => write((now) => {
    const settings = with_parameter(now.with ? `with: ${now.with}` : "", name, value);
    return { ...now, with: map_of(`{${settings}}`).get("with") ?? "" };
  }, field);
  const about = `${box.id} call ${index}`;
  return (
    <>
      <Field wide label={`Call ${index + 1}`} about={about} value={call.to} list={offers} take={(to) => write(() => ({ to, with: "" }), about)}>{children}</Field>
      {parameters_of_call(shown, box, call).map(({ name, type, unit, given }) => (
        <Field key={name} label={name} about={`${about} ${name}`} value={given} unit={unit} take={give(name, `${about} ${name}`)}
          hint={given ? "" : "to be given: a value, or a port such as Dial.Out"} title={`${type}: a constant, or a port such as Dial.Out`} />
      ))}
    </>
  );
}

function Another({ offers, add }: { offers: string[]; add(to: string): Promise<boolean> }) {
  const [wanted, set_wanted] = useState("");
  const submit = async () => {
    if (wanted.trim() && (await add(wanted.trim()))) set_wanted((now) => (now === wanted ? "" : now)); // the next one may be typed already
  };
  return (
    <form className="row" onSubmit={(event) => (event.preventDefault(), void submit())}>
      <input aria-label="New call" placeholder="such as Vision.start" list="callable" value={wanted} onChange={(event) => set_wanted(event.target.value)} />
      <datalist id="callable">{offers.map((one) => <option key={one} value={one} />)}</datalist>
      <button type="submit" disabled={!wanted.trim()}>Add</button>
    </form>
  );
}
