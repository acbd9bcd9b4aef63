// SPDX-License-Identifier: Apache-2.0
// How the components of the library `controls` are drawn and operated (docs/controls.md).
import { type ReactNode, useEffect, useRef, useState } from "react";
import { message_of } from "./backend.ts";
import type { Component, Model } from "./checked.ts";
import { inspector } from "./run.ts";
import { tell, toggle_plotted } from "./selection.ts";
import { number_text, watch } from "./values.ts";

type Face = (props: { component: Component }) => ReactNode;

const kRenewal = 50;  ///< of what is held [ms]
const kTextInterval = 250;  ///< between two looks at a text [ms]

const property = (component: Component, name: string): string => component.properties.find((one) => one.name === name)?.value ?? "";

function call(component: string, operation: string, ...words: string[]): void {
  inspector().call(component, operation, words).catch((error: unknown) => tell(message_of(error)));
}

function useNumber(item: string): number {
  const [value, set_value] = useState(NaN);
  useEffect(() => watch(item, (numbers) => set_value(numbers[0] ?? NaN)), [item]);
  return value;
}

const ButtonFace: Face = ({ component }) => (
  <button type="button" className="press" onClick={() => call(component.name, "press")}>Press</button>
);

const SwitchFace: Face = ({ component }) => {
  const on = useNumber(`${component.name}.On`) > 0;
  return (
    <button type="button" role="switch" aria-checked={on} aria-label={component.name} className="switch" onClick={() => call(component.name, "turn", String(!on))}>
      {on ? "on" : "off"}
    </button>
  );
};

const SliderFace: Face = ({ component }) => {
  const { name } = component;
  const value = useNumber(`${name}.Out`);
  const holds = property(component, "Hold") === "true";
  const { held, move, let_go } = useHold(name, holds);
  const low = Number(property(component, "Low") || 0);
  const high = Number(property(component, "High") || 1);
  const shown = held ?? (Number.isNaN(value) ? low : value);
  return (
    <label className="slide">
      <input type="range" aria-label={name} min={low} max={high} step={(high - low) / 200} value={shown}
        onChange={(event) => move(Number(event.target.value))} onPointerUp={let_go} onPointerCancel={let_go} onKeyUp={let_go} onBlur={let_go} />
      <output>{`${number_text(shown)} ${property(component, "Unit")}`}</output>
      {holds && <small>moves while it is held</small>}
    </label>
  );
};

/** What is held is moved again and again; it ends with the hand, the page or the connection. */
function useHold(component: string, holds: boolean) {
  const [held, set_held] = useState<number>();
  const timer = useRef<ReturnType<typeof setInterval>>(undefined);
  const send = (value: number) => inspector().begin(component, "move", [String(value)]).catch((error: unknown) => tell(message_of(error)));
  const let_go = () => {
    clearInterval(timer.current);
    set_held(undefined);
  };
  const move = (value: number) => {
    clearInterval(timer.current);
    set_held(value);
    void send(value);
    if (holds) timer.current = setInterval(() => void send(value), kRenewal);
  };
  useEffect(() => {
    addEventListener("blur", let_go);
    return () => {
      removeEventListener("blur", let_go);
      clearInterval(timer.current);
    };
  }, []);
  return { held, move, let_go };
}

const LightFace: Face = ({ component }) => {
  const on = useNumber(`${component.name}.On`) > 0;
  return <span className={`lamp ${on ? "on" : ""}`} role="img" aria-label={`${component.name} is ${on ? "on" : "off"}`} />;
};

const NumberFace: Face = ({ component }) => {
  const value = useNumber(`${component.name}.Value`);
  return <output className="number">{`${number_text(value)} `}<small>{property(component, "Unit")}</small></output>;
};

const TextFace: Face = ({ component }) => <output className="says">{useText(`${component.name}.Text`)}</output>;

/** A text of the run; watches carry numbers only. */
function useText(item: string): string {
  const [text, set_text] = useState("");
  useEffect(() => {
    const look = () => inspector().read([item]).then(([found]) => set_text(found?.written ? found.value : ""), () => undefined);
    const timer = setInterval(() => void look(), kTextInterval);
    return () => clearInterval(timer);
  }, [item]);
  return text;
}

const PlotFace: Face = ({ component }) => (
  <button type="button" onClick={() => component.inputs.forEach((port) => toggle_plotted(`${component.name}.${port.name}`))}>Plot its inputs</button>
);

const faces: Record<string, Face | undefined> = {
  button: ButtonFace, switch: SwitchFace, slider: SliderFace, light: LightFace, number: NumberFace, text: TextFace, plot: PlotFace,
};

/** How a model is drawn that says so. Of an application elsewhere, whose libraries are not here, models have the names of controls. */
export function face_of(models: readonly Model[], name: string): Face | undefined {
  const model = models.find((one) => one.name === name);
  return faces[model ? model.face : name.toLowerCase()];
}
