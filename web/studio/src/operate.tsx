// SPDX-License-Identifier: Apache-2.0
import { useState } from "react";
import { message_of } from "./backend.ts";
import type { Component, Property } from "./checked.ts";
import { useElsewhere } from "./elsewhere.ts";
import { HeldAct } from "./held_act.tsx";
import { face_of } from "./faces.tsx";
import { project } from "./project.ts";
import { Jog, jogs } from "./jog.tsx";
import { Call, Operations } from "./operations.tsx";
import { inspector, is_up, run } from "./run.ts";
import { box_called, useScene } from "./scene.ts";
import { is_mine, seat } from "./seat.ts";
import { selection } from "./selection.ts";

/** What an operator arms, and everybody disarms. */
const arms = ({ operations }: Component): boolean => operations.some((one) => one.name === "arm" && one.by_operator) && operations.some((one) => one.name === "disarm");

const words_of = ({ properties }: Component): Property[] => properties.filter((one) => one.by_operator && one.type === "bool");

/** What only the operator can know, to be said once. */
function Word({ component, word }: { component: string; word: Property }) {
  const [answer, set_answer] = useState("");
  const say = () => void inspector().write(`${component}.${word.name}`, "true").then(() => set_answer("said"), (error: unknown) => set_answer(message_of(error)));
  return (
    <div className="call word">
      <HeldAct name={word.name} act={say} tell={set_answer} />
      <output>{answer}</output>
      <small>{word.doc}</small>
    </div>
  );
}

/** Arming, jogging, the controls of the application, and the operations of what is selected. */
export function Operate() {
  const up = run.use((all) => is_up(all.state));
  const elsewhere = useElsewhere();
  const components = project.use((state) => state.shown?.components);
  const models = project.use((state) => state.models);
  const box = useSelectedBox();
  const mine = seat.use(is_mine);
  if (!up && elsewhere) return <p className="hint">The application is not there.</p>;
  if (!up) return <p className="hint">Run the application: its buttons, switches, sliders and displays stand here, and the operations of what you select.</p>;
  const controls = (components ?? []).filter((one) => face_of(models, one.model));
  const armed = (components ?? []).filter((one) => arms(one) || words_of(one).length > 0);
  const jogged = (components ?? []).filter(jogs);
  return (
    <div className="operate scroll" tabIndex={0} aria-label="Operate">
      <div className="faces">
        {armed.length > 0 && !mine && <p className="hint">What has to be held for 1 s is for the operator: press Take the seat first, at the top right.</p>}
        {armed.map((one) => (
          <fieldset key={one.name}>
            <legend>{one.name}</legend>
            {words_of(one).map((word) => <Word key={word.name} component={one.name} word={word} />)}
            {arms(one) && one.operations.filter(({ name }) => name === "arm" || name === "disarm").map((operation) => <Call key={operation.name} component={one.name} operation={operation} />)}
          </fieldset>
        ))}
        {jogged.map((one) => <Jog key={one.name} component={one} />)}
        {controls.map((one) => {
          const Face = face_of(models, one.model)!;
          return <fieldset key={one.name}><legend>{one.name}</legend><Face component={one} /></fieldset>;
        })}
        {controls.length + jogged.length + armed.length === 0 && <p className="hint">{`This application has no controls.${elsewhere ? "" : " Add a Button, a Slider or a Light of the library controls."}`}</p>}
      </div>
      {box && box.components.slice(0, 1).map((one) => <Operations key={one.name} component={one} />)}
      {!box && <p className="hint">Select a box to call its operations.</p>}
    </div>
  );
}

function useSelectedBox() {
  useScene();
  const boxes = selection.use((state) => state.boxes);
  const port = selection.use((state) => state.port);
  return box_called(port?.box ?? boxes[0] ?? "");
}
