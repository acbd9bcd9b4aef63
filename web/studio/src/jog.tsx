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

/** Two buttons for each axis of a generator: it moves as long as one of them is held. */
export function Jog({ component }: { component: Component }) {
  const [speed, set_speed] = useState(() => String(slow(property(component, "max_vel"))));
  const [why, set_why] = useState("");
  const positions = usePositions(component);
  const axes = Math.max(1, Number(property(component, "num_axes")) || 1);
  const wanted = Number(speed);
  return (
    <fieldset className="jog">
      <legend>{`${component.name}: jog`}</legend>
      <label className="row">Speed
        <input inputMode="decimal" size={6} value={speed} aria-invalid={!(wanted > 0)} onChange={(event) => set_speed(event.target.value)} /> rad/s
      </label>
      {Array.from({ length: axes }, (_, i) => (
        <div key={i} className="row" role="group" aria-label={`${component.name} axis ${i + 1}`}>
          <span>{`Axis ${i + 1}`}</span>
          <JogButton component={component.name} axis={i + 1} sign={-1} speed={wanted} tell={set_why} />
          <JogButton component={component.name} axis={i + 1} sign={1} speed={wanted} tell={set_why} />
          <output>{positions[i] === undefined ? "" : `${fixed_text(positions[i])} rad`}</output>
        </div>
      ))}
      <small role="status">{why || "moves while it is held"}</small>
    </fieldset>
  );
}

function JogButton({ component, axis, sign, speed, tell }: { component: string; axis: number; sign: 1 | -1; speed: number; tell: (why: string) => void }) {
  const { held, props } = useHeld(() => press_jog(component, axis, sign * speed, tell));
  return (
    <button type="button" className={`hold ${held ? "held" : ""}`} disabled={!(speed > 0)} aria-label={`axis ${axis} ${sign < 0 ? "back" : "forth"}`}
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
