// SPDX-License-Identifier: Apache-2.0
// Modes as a table: a row for each component, a column for each mode.
import { useMemo, useState } from "react";
import { type Mode, modes_of, names_entry, rows_of } from "./modes.ts";
import { change, edit, project } from "./project.ts";
import { Refused } from "./refused.tsx";
import { run } from "./run.ts";
import { scene } from "./scene.ts";
import { select_box, selection } from "./selection.ts";

const kAbout = "modes";
const kMostRows = 300;

export function Modes() {
  const texts = project.use((state) => state.texts);
  const modes = useMemo(() => modes_of(texts), [texts]);
  const rows = useMemo(() => rows_of(texts, modes), [texts, modes]);
  return (
    <div className="modes scroll" tabIndex={0} aria-label="Modes">
      <p className="hint">The components of a mode run together, those of other modes are off meanwhile. What no mode names runs in every mode.</p>
      {modes.length > 0 && (
        <table>
          <thead><tr><th scope="col">Component</th>{modes.map((mode) => <Head key={mode.name} mode={mode} />)}</tr></thead>
          <tbody>{rows.slice(0, kMostRows).map((row) => <Row key={row} row={row} modes={modes} />)}</tbody>
        </table>
      )}
      {rows.length > kMostRows && modes.length > 0 && <p className="hint">{`${rows.length - kMostRows} more run in every mode.`}</p>}
      <NewMode rows={rows} />
      <Refused about={kAbout} />
    </div>
  );
}

function Head({ mode }: { mode: Mode }) {
  const shown = selection.use((state) => state.mode === mode.name);
  const initial = project.use((state) => state.shown?.modes.some((one) => one.name === mode.name && one.initial) ?? false);
  const now = run.use((all) => all.application?.mode === mode.name);
  const about = { field: kAbout, file: mode.file };
  const start = async () => {
    if (!initial && (await edit([change("initial_mode", mode.name)], { field: kAbout }))) run.set({ mode: "" });
  };
  return (
    <th scope="col" className={shown ? "shown" : ""}>
      <ModeName mode={mode} />
      <span className="group" role="group" aria-label={mode.name}>
        <button type="button" className="small" aria-pressed={shown} title="Shows on the canvas what runs in it" onClick={() => selection.set({ mode: shown ? "" : mode.name })}>Show</button>
        <button type="button" className="small" aria-pressed={initial} title={initial ? "The application starts in it, as the file says" : "Writes into the file that the application starts in it"} onClick={() => void start()}>
          {initial ? "Starts in it" : "Start in it"}
        </button>
        <button type="button" className="unset" aria-label={`Remove the mode ${mode.name}`} title="Removes the mode; its components stay" onClick={() => void edit([change("no_mode", mode.name)], about)}>×</button>
      </span>
      {now && <small className="now">now</small>}
    </th>
  );
}

function ModeName({ mode }: { mode: Mode }) {
  const rename = (field: HTMLInputElement) => {
    const name = field.value.trim();
    if (name === mode.name) return;
    void edit([change("rename_mode", mode.name, name)], { field: kAbout, file: mode.file }).then((done) => {
      if (!done) field.value = mode.name;
      if (done && selection.get().mode === mode.name) selection.set({ mode: name });
      if (done && run.get().mode === mode.name) run.set({ mode: name });
    });
  };
  return (
    <input defaultValue={mode.name} size={10} spellCheck={false} aria-label={`Name of the mode ${mode.name}`} onBlur={(event) => rename(event.currentTarget)}
      onKeyDown={(event) => {
        if (event.key === "Enter") event.currentTarget.blur();
        if (event.key === "Escape" && !event.shiftKey) event.currentTarget.value = mode.name;
      }} />
  );
}

function Row({ row, modes }: { row: string; modes: readonly Mode[] }) {
  const everywhere = !modes.some((mode) => names_entry(mode, row));
  const go = () => {
    const box = scene().boxes.find((one) => one.title === row);
    if (box) select_box(box.id, true);
  };
  return (
    <tr>
      <th scope="row"><button type="button" className="link" onClick={go}>{row}</button>{everywhere && <small> in every mode</small>}</th>
      {modes.map((mode) => <Cell key={mode.name} row={row} mode={mode} />)}
    </tr>
  );
}

function Cell({ row, mode }: { row: string; mode: Mode }) {
  const runs = names_entry(mode, row);
  return (
    <td>
      <input type="checkbox" checked={runs} aria-label={`${row} stands in ${mode.name}`}
        onChange={() => void edit([change(runs ? "from_mode" : "to_mode", mode.name, row)], { field: kAbout, file: mode.file })} />
    </td>
  );
}

/** A mode begins with its first component. */
function NewMode({ rows }: { rows: readonly string[] }) {
  const selected = selection.use((state) => state.boxes[0] ?? "");
  const [name, set_name] = useState("");
  const [first, set_first] = useState("");
  const component = first || (rows.includes(selected) ? selected : "");
  const add = async () => {
    if (!(await edit([change("to_mode", name.trim(), component)], { field: kAbout }))) return;
    set_name("");
    set_first("");
  };
  return (
    <form className="row" aria-label="New mode" onSubmit={(event) => (event.preventDefault(), void add())}>
      <input aria-label="Name of the new mode" placeholder="new mode" value={name} spellCheck={false} onChange={(event) => set_name(event.target.value)} />
      <span>with</span>
      <select aria-label="Its first component" value={component} onChange={(event) => set_first(event.target.value)}>
        <option value="">choose a component</option>
        {rows.map((one) => <option key={one}>{one}</option>)}
      </select>
      <button type="submit" disabled={!name.trim() || !component}>Add the mode</button>
    </form>
  );
}

const kNone: Mode[] = [];

/** Which mode the canvas shows: the one that was chosen; while the application runs, or else, its own. */
export function useShownMode(): { modes: readonly Mode[]; mode: string } {
  const texts = project.use((state) => state.shownTexts);
  const has_modes = project.use((state) => (state.shown?.modes.length ?? 0) > 0);
  const chosen = selection.use((state) => state.mode);
  const now = run.use((all) => all.application?.mode ?? "");
  const modes = useMemo(() => (has_modes ? modes_of(texts) : kNone), [texts, has_modes]);
  const known = modes.some((one) => one.name === chosen);
  return { modes, mode: known ? chosen : now };
}

/** On the canvas of a deployment that has modes. */
export function ShownMode() {
  const { modes, mode } = useShownMode();
  const chosen = selection.use((state) => state.mode);
  if (modes.length === 0) return null;
  const known = modes.some((one) => one.name === chosen);
  return (
    <label className="shown-mode">Mode shown{" "}
      <select value={known ? chosen : ""} onChange={(event) => selection.set({ mode: event.target.value })}>
        <option value="">{mode && !known ? `${mode}, as it runs` : "all"}</option>
        {modes.map(({ name }) => <option key={name}>{name}</option>)}
      </select>
    </label>
  );
}
