// SPDX-License-Identifier: Apache-2.0
import { type Activity, activity_text, duration_text, type Property } from "./checked.ts";
import { Calls } from "./calls_view.tsx";
import { ConnectByName } from "./connect_by_name.tsx";
import { Field } from "./field.tsx";
import type { Box } from "./graph.ts";
import { dissolve, may_dissolve, split } from "./grouping.ts";
import { change, edit, project } from "./project.ts";
import { PropertyField } from "./property_field.tsx";
import { Requirements } from "./requirements.tsx";
import { change_component, run } from "./run.ts";
import { remove_selected } from "./scene.ts";
import { open_composite, select_box, selection, show_text } from "./selection.ts";
import { acts_of, boxes_state, reason_text, state_class } from "./states.ts";

export function BoxView({ box }: { box: Box }) {
  const model = project.use((state) => state.models.find((one) => one.name === box.model));
  return (
    <>
      <h2>{box.title}{box.names.length > 1 && <span className="count">{`×${box.names.length}`}</span>}</h2>
      <p className="lead"><b>{box.model}</b>{model?.doc && ` ${model.doc}`}{model && <em>{model.granularity}</em>}</p>
      {is_unknown(box) && <p className="error">The check says nothing of it, because of a mistake: see Problems, or mend it in the text.</p>}
      <Live box={box} />
      <Name box={box} />
      {is_range(box) && <SplitField box={box} />}
      {!box.composite && !is_unknown(box) && <ActivityField box={box} />}
      {box.composite ? <Parts box={box} /> : <Properties box={box} defaults={model?.properties ?? []} />}
      {!box.composite && model?.most_calls !== undefined && <Calls box={box} most={model.most_calls} />}
      {!box.composite && !is_unknown(box) && <Requirements box={box} />}
      <p className="actions">
        <ConnectByName boxes={[box.id]} />
        {box.file && <button type="button" onClick={() => show_text(box.file!, box.line, box.column)}>Show in the text</button>}
        {may_dissolve(box) && <button type="button" title="Ctrl+Shift+G: its parts become boxes beside it" onClick={() => void dissolve(box)}>Dissolve</button>}
        <button type="button" className="danger" onClick={() => void remove_selected()}>Remove</button>
      </p>
    </>
  );
}

function Name({ box }: { box: Box }) {
  const rename = async (name: string) => {
    const done = await edit([change("rename", box.edited, name)], { field: `${box.id} name`, file: box.file });
    if (done) select_box([...selection.get().path, name].join("."));
    return done;
  };
  return <Field label="Name" about={`${box.id} name`} value={box.title} take={rename} />;
}

const is_unknown = (box: Box): boolean => box.components[0]!.unknown ?? false;

/** A box of a range as the file has it, not of all instances of a composite. */
const is_range = (box: Box): boolean => box.names.length > 1 && box.title.includes("..");

function SplitField({ box }: { box: Box }) {
  const about = `${box.id} split`;
  return <Field label="Split off" about={about} value="" hint="3, or 3..5, gets a box of its own" take={(part) => split(box, part, about)} />;
}

/** How the run has it, with what can be done about that. */
export function Live({ box }: { box: Box }) {
  const components = run.use((all) => all.components);
  const state = boxes_state(box, components);
  if (!state) return null;
  const reasons = [...new Set(box.components.flatMap((one) => components.get(one.name)?.reason || []))].map((one) => reason_text(state, one));
  const acts = box.components.map((one) => acts_of(components.get(one.name)?.state ?? ""));
  const all = (what: string) => () => box.components.forEach((one) => void change_component(one.name, what));
  return (
    <div className={`live ${state_class(state)}`}>
      <b>{state}</b> {reasons.join("; ")}
      <span className="group" role="group" aria-label="State">
        {acts.some((one) => one.start) && <button type="button" onClick={all("start")}>Start</button>}
        {acts.some((one) => one.stop) && <button type="button" title="Stops this component alone" onClick={all("stop")}>Stop this</button>}
        {acts.some((one) => one.reset) && <button type="button" title="Takes the fault back; then it may be started" onClick={all("reset")}>Reset</button>}
      </span>
    </div>
  );
}

/** As the file would have it: `{periodic: 10 ms, priority: 70}`. */
function activity_yaml(activity: Activity): string {
  if (activity.kind !== "periodic") return activity.kind === "triggered" ? "{triggered: true}" : activity.kind;
  const priority = activity.scheduler === "realtime" ? `, priority: ${activity.priority}` : "";
  return `{periodic: ${duration_text(activity.period_ns ?? 0)}${priority}}`;
}

function ActivityField({ box }: { box: Box }) {
  const { activity, thread } = box.components[0]!;
  return (
    <Field wide label="Activity" about={`${box.id} activity`} value={activity_yaml(activity)}
      hint={`${activity_text(activity)}${thread ? `, in the thread ${thread}` : ""}`}
      list={["sequential", "triggered", "{periodic: 10 ms}", "{periodic: 10 ms, priority: 70}"]}
      take={(text) => edit([change("set", `${box.edited}.activity`, text)], { field: `${box.id} activity`, file: box.file })} />
  );
}

function Properties({ box, defaults }: { box: Box; defaults: Property[] }) {
  // Attributes are what a component tells while it runs: here they would be what they are before.
  const properties = (box.components[0]!.properties ?? []).filter((one) => one.persistent);
  if (properties.length === 0) return null;
  return (
    <section aria-label="Properties">
      <h3>Properties</h3>
      {properties.map((property) => (
        <PropertyField key={property.name} box={box} property={property} fallback={defaults.find((one) => one.name === property.name)?.default} />
      ))}
    </section>
  );
}

export function Parts({ box }: { box: Box }) {
  return (
    <section aria-label="Parts">
      <h3>Parts</h3>
      <p>{`${box.components.length} components. What is inside belongs to the definition of ${box.model}: a change there is one for every instance.`}</p>
      <button type="button" onClick={() => open_composite([...selection.get().path, box.title])}>Show what is inside</button>
    </section>
  );
}
