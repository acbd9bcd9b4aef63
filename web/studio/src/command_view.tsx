// SPDX-License-Identifier: Apache-2.0
// A wire from an event to a command whose parameters are still to be given: it is made once they are.
import { useEffect, useRef, useState } from "react";
import { counted, make_commanding } from "./scene.ts";
import { type Commanding, selection } from "./selection.ts";

export function CommandView({ commanding }: { commanding: Commanding }) {
  const { from, to, parameters } = commanding;
  const [values, set_values] = useState(() => parameters.map(() => ""));
  const first = useRef<HTMLInputElement>(null);
  useEffect(() => first.current?.focus(), []);
  const ready = values.every((value) => value.trim() !== "");
  return (
    <form aria-label="Parameters of the command" onSubmit={(event) => (event.preventDefault(), ready && void make_commanding(commanding, values))}>
      <p className="lead">An event that commands</p>
      <h2 className="ends"><span>{from}</span> <span aria-label="to">→</span> <span>{to}</span></h2>
      <p>{`The command takes ${counted(parameters.length, "parameter")}: each is a value, a port such as Left.Out, or a member of the event.`}</p>
      {parameters.map((parameter, i) => (
        <div key={parameter.name} className="field wide">
          <label htmlFor={`given-${i}`}>{parameter.name}</label>
          <span className="entry">
            <input id={`given-${i}`} ref={i === 0 ? first : undefined} value={values[i]} spellCheck={false} autoComplete="off"
              onChange={(event) => set_values(values.with(i, event.target.value))} />
          </span>
          <div className="about"><small>{`${parameter.type}${parameter.type.includes("vector") ? ", such as [2.0, 0.8]" : ""}`}</small></div>
        </div>
      ))}
      <p className="actions">
        <button type="submit" className="primary" disabled={!ready}>Connect</button>
        <button type="button" onClick={() => selection.set({ commanding: undefined })}>Cancel</button>
      </p>
    </form>
  );
}
