// SPDX-License-Identifier: Apache-2.0
// Parameters and properties that the next run has otherwise than the file says, as `armature run --set`.
import { useEffect, useRef, useState } from "react";
import { project } from "./project.ts";
import { named_settings, run, type Setting } from "./run.ts";
import { parameters_of } from "./written.ts";

const kMostNames = 500;
const kEmpty: Setting = { name: "", value: "" };

export function RunSettings({ going }: { going: boolean }) {
  const settings = run.use((all) => all.settings);
  const [open, set_open] = useState(false);
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => (open ? close_elsewhere(place.current!, () => set_open(false)) : undefined), [open]);
  const count = named_settings(settings).length;
  const toggle = () => {
    if (!open && settings.length === 0) run.set({ settings: [kEmpty] });
    set_open(!open);
  };
  return (
    <div className="run-settings" ref={place}>
      <button type="button" aria-expanded={open} title="What the next run has otherwise than the file says" onClick={toggle}>
        {count > 0 ? `Set ${count}` : "Set …"}
      </button>
      {open && <Form settings={settings} going={going} close={() => set_open(false)} />}
    </div>
  );
}

/** A click or the focus elsewhere closes it. */
function close_elsewhere(place: HTMLElement, close: () => void): () => void {
  const look = ({ target }: Event) => target instanceof Node && !place.contains(target) && close();
  document.addEventListener("pointerdown", look);
  document.addEventListener("focusin", look);
  return () => {
    document.removeEventListener("pointerdown", look);
    document.removeEventListener("focusin", look);
  };
}

function Form({ settings, going, close }: { settings: Setting[]; going: boolean; close(): void }) {
  const change = (i: number, part: Partial<Setting>) => run.set({ settings: settings.with(i, { ...settings[i]!, ...part }) });
  const remove = (i: number) => run.set({ settings: settings.filter((_, k) => k !== i) });
  return (
    <form className="run-settings-form" aria-label="Set for the next run" onSubmit={(event) => (event.preventDefault(), close())}
      onKeyDown={(event) => event.key === "Escape" && !event.shiftKey && close()}>
      <p className="lead">{going ? "For the next run, not for the one that goes on:" : "For the next run; the file stays as it is:"}</p>
      <Names />
      {settings.map((one, i) => (
        <div className="row" key={i}>
          <input aria-label={`Name ${i + 1}`} list="settable" placeholder="Component.Property" value={one.name} onChange={(event) => change(i, { name: event.target.value })} autoFocus={i === settings.length - 1} />
          <span aria-hidden="true">=</span>
          <input aria-label={`Value ${i + 1}`} placeholder={value_in_file(one.name) || "value"} value={one.value} onChange={(event) => change(i, { value: event.target.value })} />
          <button type="button" className="unset" aria-label={`Set ${one.name || "it"} no more`} onClick={() => remove(i)}>×</button>
        </div>
      ))}
      <div className="group">
        <button type="button" className="small" onClick={() => run.set({ settings: [...settings, kEmpty] })}>Another</button>
        <button type="submit" className="small">Done</button>
      </div>
    </form>
  );
}

/** What may be set: parameters first, then properties. */
function Names() {
  const components = project.use((all) => all.shown?.components);
  const texts = project.use((all) => all.texts);
  const properties = (components ?? []).flatMap((one) => one.properties.map(({ name }) => `${one.name}.${name}`));
  const names = [...parameters_of(texts).keys(), ...properties].slice(0, kMostNames);
  return <datalist id="settable">{names.map((name) => <option key={name} value={name} />)}</datalist>;
}

function value_in_file(name: string): string {
  const { shown, texts } = project.get();
  const dot = name.lastIndexOf(".");
  if (dot < 0) return parameters_of(texts).get(name) ?? "";
  return shown?.components.find((one) => one.name === name.slice(0, dot))?.properties.find((one) => one.name === name.slice(dot + 1))?.value ?? "";
}
