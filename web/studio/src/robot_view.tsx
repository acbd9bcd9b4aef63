// SPDX-License-Identifier: Apache-2.0
// A robot in 3D, moved by its joints' positions, with the same in a table. It comes with three.js, so
// it is loaded when it is opened.
import { type KeyboardEvent, useEffect, useMemo, useRef, useState } from "react";
import { message_of } from "./backend.ts";
import { describe_robot, project, set_robot_source } from "./project.ts";
import { type Joint, RobotModel } from "./robot_model.ts";
import { Stage } from "./robot_stage.ts";
import { type Binding, binding_of, type Robot, robots_of, type Source, sources_of } from "./robots.ts";
import { is_up, run } from "./run.ts";
import { age_text, fixed_text, number_text, watch } from "./values.ts";

const kNone: never[] = [];
const kOld = 1;  ///< from this age on positions are told as old [s]

export default function RobotView() {
  const components = project.use((state) => state.shown?.components ?? kNone);
  const robots = useMemo(() => robots_of(components), [components]);
  const [owner, set_owner] = useState("");
  const robot = robots.find((one) => one.owner === owner) ?? robots[0];
  if (!robot) return <p className="hint">No component of this deployment describes a robot: none has a property robot_description that names a file (URDF).</p>;
  return (
    <div className="robot">
      {robots.length > 1 && (
        <label className="row">Robot of <select value={robot.owner} onChange={(event) => set_owner(event.target.value)}>{robots.map((one) => <option key={one.owner}>{one.owner}</option>)}</select></label>
      )}
      <Described key={robot.path} robot={robot} />
    </div>
  );
}

/** The robot of a description, which is read again whenever the deployment was checked. */
function Described({ robot }: { robot: Robot }) {
  const checked = project.use((state) => state.state.checked);
  const [text, set_text] = useState("");
  const [trouble, set_trouble] = useState("");
  useEffect(() => {
    describe_robot(robot.path).then((read) => (set_text(read), set_trouble("")), (error: unknown) => set_trouble(message_of(error)));
  }, [robot.path, checked]);
  const { owner, base, tip, path } = robot;
  const made = useMemo(() => (text ? model_of(text, { owner, base, tip, path }) : undefined), [text, owner, base, tip, path]);
  useEffect(() => () => made?.model?.dispose(), [made]);
  const wrong = trouble || made?.trouble;
  if (wrong) return <p className="hint bad" role="alert">{`The robot of ${owner} is not shown: ${wrong}`}</p>;
  if (!made?.model) return <p className="hint">Reading the description …</p>;
  return <Shown model={made.model} owner={owner} />;
}

function model_of(text: string, robot: Robot): { model?: RobotModel; trouble?: string } {
  try {
    return { model: new RobotModel(text, robot) };
  } catch (error) {
    return { trouble: message_of(error) };
  }
}

function Shown({ model, owner }: { model: RobotModel; owner: string }) {
  const components = project.use((state) => state.shown?.components ?? kNone);
  const chosen = project.use((state) => state.robots.get(owner));
  const sources = useMemo(() => sources_of(components, owner, model.joints.length), [components, owner, model]);
  const binding = useMemo(() => binding_of(sources, chosen), [sources, chosen]);
  const [stage, set_stage] = useState<Stage>();
  const table = useRef<HTMLTableSectionElement>(null);
  const state = useRef<HTMLParagraphElement>(null);
  const up = run.use((all) => is_up(all.state));
  const items = up ? (binding.source?.items.join("\n") ?? "") : "";
  useEffect(() => new Pose(model, stage, table.current!, state.current!).follow(items ? items.split("\n") : []), [model, stage, items]);
  return (
    <>
      <View model={model} on_stage={set_stage} />
      <Moved binding={binding} sources={sources} owner={owner} up={up} />
      <p className="hint" ref={state} role="status" />
      <div className="scroll joints" tabIndex={0} role="region" aria-label="Joints">
        <table>
          <thead><tr><th>Joint</th><th>Position</th><th /><th>Range</th></tr></thead>
          <tbody ref={table}>{model.joints.map((joint) => <Row key={joint.name} joint={joint} />)}</tbody>
        </table>
      </div>
      {model.tip && <p className="hint">Arrows at <code>{model.tip}</code>: red is x, green y, blue z.</p>}
      {model.meshes > 0 && <p className="hint">{`${model.meshes} shapes of the description are meshes, which are not drawn.`}</p>}
    </>
  );
}

function Row({ joint: { name, range, unit } }: { joint: Joint }) {
  return (
    <tr>
      <th scope="row">{name}</th>
      <td className="position" />
      <td className="degrees" />
      <td>{range ? `${number_text(range[0])} … ${number_text(range[1])} ${unit}` : "without end"}</td>
    </tr>
  );
}

function View({ model, on_stage }: { model: RobotModel; on_stage(stage: Stage | undefined): void }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const stage = useRef<Stage>(undefined);
  const [trouble, set_trouble] = useState("");
  useEffect(() => {
    try {
      stage.current = new Stage(canvas.current!, model);
      on_stage(stage.current);
    } catch (error) {
      set_trouble(message_of(error));
    }
    return () => {
      stage.current?.dispose();
      stage.current = undefined;
      on_stage(undefined);
    };
  }, [model]);
  const on_key = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !stage.current?.key(event.key)) return;
    event.preventDefault();
    event.stopPropagation();
  };
  if (trouble) return <p className="hint warning" role="alert">{`${trouble} The table has the joints' positions.`}</p>;
  return (
    <div className="stage">
      <canvas ref={canvas} tabIndex={0} role="application" aria-label={`${model.name} in 3D: arrow keys turn the view, + and - zoom, Home shows all of it`} onKeyDown={on_key} />
      <span className="stage-keys" aria-hidden="true"><kbd>←</kbd> <kbd>↑</kbd> turn · <kbd>+</kbd> <kbd>-</kbd> zoom · <kbd>Home</kbd> all</span>
    </div>
  );
}

/** What moves it, and the user's choice of that. */
function Moved({ binding, sources, owner, up }: { binding: Binding; sources: Source[]; owner: string; up: boolean }) {
  const found = binding.chosen || !binding.source ? "found by itself" : `found: ${binding.source.port}`;
  return (
    <div className="moved">
      <label className="row">Moved by
        <select value={binding.chosen ? (binding.source?.port ?? "?") : ""} onChange={(event) => void set_robot_source(owner, event.target.value)}>
          {binding.chosen && !binding.source && <option value="?" disabled>a port that is gone</option>}
          <option value="">{found}</option>
          {sources.map(({ port }) => <option key={port} value={port}>{port}</option>)}
        </select>
      </label>
      {binding.trouble && <p className={up ? "bad" : "warning"} role={up ? "alert" : undefined}>{`Nothing moves it: ${binding.trouble}.`}</p>}
    </div>
  );
}

/** The joints' positions, in the table and on the stage; joints without a value rest at 0. */
class Pose {
  private readonly cells: { position: HTMLElement; degrees: HTMLElement }[];
  private readonly known: number[];
  private age = 0;

  constructor(private readonly model: RobotModel, private readonly stage: Stage | undefined, table: HTMLTableSectionElement, private readonly state: HTMLElement) {
    this.cells = [...table.rows].map((row) => ({ position: row.querySelector<HTMLElement>(".position")!, degrees: row.querySelector<HTMLElement>(".degrees")! }));
    this.known = model.joints.map(() => NaN);
  }

  /** @param items  of the run: one with all numbers, or one for each joint. @return what ends it */
  follow(items: string[]): () => void {
    const ends = items.map((item, i) => watch(item, (numbers, age) => {
      numbers.slice(0, items.length > 1 ? 1 : this.known.length).forEach((value, k) => (this.known[i + k] = value));
      this.age = age;
      this.show(true);
    }));
    this.show(items.length > 0);
    return () => ends.forEach((end) => end());
  }

  private show(live: boolean): void {
    this.model.joints.forEach((joint, i) => this.show_joint(joint, this.known[i]!, this.cells[i]!));
    this.stage?.show();
    const text = this.state_text(live);
    if (this.state.textContent !== text) this.state.textContent = text;
  }

  private show_joint({ name, unit }: Joint, value: number, { position, degrees }: { position: HTMLElement; degrees: HTMLElement }): void {
    const known = Number.isFinite(value);
    this.model.move(name, known ? value : 0);
    position.textContent = known ? `${fixed_text(value)} ${unit}` : "no value";
    position.classList.toggle("none", !known);
    degrees.textContent = known && unit === "rad" ? `${fixed_text((value * 180) / Math.PI, 1)}°` : "";
  }

  private state_text(live: boolean): string {
    const without = this.model.joints.filter((_, i) => !Number.isFinite(this.known[i])).map(({ name }) => name);
    if (!live) return "All joints are shown at 0.";
    if (without.length === this.known.length) return "All joints are shown at 0: nobody has written their positions yet.";
    if (without.length > 0) return `Without a value, shown at 0: ${without.join(", ")}.`;
    return this.age < kOld ? "" : `The positions are ${age_text(Math.round(this.age))}.`;
  }
}
