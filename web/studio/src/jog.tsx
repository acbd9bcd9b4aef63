// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from "react";
import type { Component } from "./checked.ts";
import { useHeld } from "./held.ts";
import { press_jog } from "./jogging.ts";
import { fixed_text, watch } from "./values.ts";

const kSlow = 0.1;  ///< of the largest velocity, to begin with

export const jogs = ({ operations }: Component): boolean => ["jog", "keepJogging"].every((name) => operations.some((one) => one.name === name));

const property = (component: Component, name: string): string => {
  const found = component.properties.find((one) => one.name === name);
  return found?.value ?? found?.default ?? "";
};

/** `0.1` of a list's least number, `[1, 2]`. */
function slow(text: string): number {
  const numbers = text.match(/[\d.]+(e[-+]?\d+)?/gi)?.map(Number).filter((one) => one > 0) ?? [];
  return numbers.length > 0 ? Number((kSlow * Math.min(...numbers)).toPrecision(2)) : kSlow;
}

/** An axis that is jogged: its name, and by which of the speeds. */
interface Axis { name: string; unit: "rad/s" | "m/s" }

const kToolAxes: readonly Axis[] = [
  ...["x", "y", "z"].map((name): Axis => ({ name: `Along ${name}`, unit: "m/s" })),
  ...["x", "y", "z"].map((name): Axis => ({ name: `About ${name}`, unit: "rad/s" })),
];

/** It moves a tool, in the axes of the base or of the tool. */
const moves_tool = ({ properties }: Component): boolean => properties.some((one) => one.name === "jog_frame");

function axes_of(component: Component): readonly Axis[] {
  if (moves_tool(component)) return kToolAxes;
  const count = Math.max(1, Number(property(component, "num_axes")) || 1);
  return Array.from({ length: count }, (_, i) => ({ name: `Axis ${i + 1}`, unit: "rad/s" }));
}

/** Two buttons for each axis of a generator or a tool: it moves as long as one of them is held. */
export function Jog({ component }: { component: Component }) {
  const tool = moves_tool(component);
  const [turning, set_turning] = useState(() => String(slow(property(component, tool ? "max_tool_turning" : "max_vel"))));
  const [along, set_along] = useState(() => String(slow(property(component, "max_tool_velocity"))));
  const [frame, set_frame] = useState(() => (tool ? property(component, "jog_frame") : ""));
  const [why, set_why] = useState("");
  const positions = usePositions(component);
  const wanted = { "rad/s": Number(turning), "m/s": Number(along) };
  return (
    <fieldset className="jog">
      <legend>{`${component.name}: jog`}</legend>
      {tool && <Frame frame={frame} set={set_frame} />}
      {tool && <Speed unit="m/s" text={along} set={set_along} />}
      <Speed unit="rad/s" text={turning} set={set_turning} />
      {axes_of(component).map(({ name, unit }, i) => (
        <div key={name} className="row" role="group" aria-label={`${component.name} axis ${i + 1}`}>
          <span>{name}</span>
          <JogButton component={component.name} name={name} axis={i + 1} sign={-1} speed={wanted[unit]} frame={frame} tell={set_why} />
          <JogButton component={component.name} name={name} axis={i + 1} sign={1} speed={wanted[unit]} frame={frame} tell={set_why} />
          <output>{positions[i] === undefined ? "" : `${fixed_text(positions[i])} rad`}</output>
        </div>
      ))}
      <small role="status">{why || "moves while it is held"}</small>
    </fieldset>
  );
}

function Speed({ unit, text, set }: { unit: string; text: string; set: (text: string) => void }) {
  return (
    <label className="row">Speed
      <input inputMode="decimal" size={6} value={text} aria-invalid={!(Number(text) > 0)} onChange={(event) => set(event.target.value)} /> {unit}
    </label>
  );
}

/** In whose axes a tool is jogged: each jog says it. */
function Frame({ frame, set }: { frame: string; set: (frame: string) => void }) {
  return (
    <label className="row">In the axes of the
      <select value={frame} onChange={(event) => set(event.target.value)}>
        <option value="base">base</option>
        <option value="tool">tool</option>
      </select>
    </label>
  );
}

interface JogButtonProps { component: string; name: string; axis: number; sign: 1 | -1; speed: number; frame: string; tell: (why: string) => void }

function JogButton({ component, name, axis, sign, speed, frame, tell }: JogButtonProps) {
  const { held, props } = useHeld(() => press_jog(component, axis, sign * speed, tell, frame));
  return (
    <button type="button" className={`hold ${held ? "held" : ""}`} disabled={!(speed > 0)} aria-label={`${name.toLowerCase()} ${sign < 0 ? "back" : "forth"}`}
      title="Hold it: mouse, finger, Space or Enter" {...props}>{sign < 0 ? "−" : "+"}</button>
  );
}

function usePositions(component: Component): number[] {
  const [positions, set_positions] = useState<number[]>([]);
  const port = component.outputs.find((one) => one.name === "nAxesDesiredPosition");
  const item = port ? `${component.name}.${port.name}` : "";
  useEffect(() => (item ? watch(item, set_positions) : undefined), [item]);
  return positions;
}
