// SPDX-License-Identifier: Apache-2.0
import { Field } from "./field.tsx";
import type { Place } from "./checked.ts";
import { can_be_opened, parameters_of_command, with_parameter } from "./event_command.ts";
import type { Box, Wire } from "./graph.ts";
import { change, edit, project } from "./project.ts";
import { remove_selected } from "./scene.ts";
import { selection, show_text, toggle_opened } from "./selection.ts";
import { settings_at } from "./written.ts";

export function WireView({ wire }: { wire: Wire }) {
  const texts = project.use((state) => state.texts);
  const [from, to] = wire.written;
  const settings = wire.file && wire.line ? settings_at(texts, wire.file, wire.line, wire.column ?? 1) : "";
  const about = `${from} ${to}`;
  const take = (text: string) => edit([change("connection", from, to, ...(text ? [text] : []))], { field: about, file: wire.file });
  return (
    <>
      <p className="lead">{wire.kind === "data" ? "Connection" : `An event that commands${wire.between ? ` · ${wire.between}` : ""}`}</p>
      <h2 className="ends"><span>{from}</span> <span aria-label="to">→</span> <span>{to}</span></h2>
      <ul className="list">{facts(wire).map((fact) => <li key={fact}>{fact}</li>)}</ul>
      <Field wide label="Settings" about={about} value={settings} take={take}
        hint={wire.kind === "data" ? "such as policy: {fifo: 8}, max_age: 30 ms" : "such as name: Go, with: {height: 2 m}"} />
      {wire.kind === "command" && wire.between && <Parameters between={wire.between} place={wire} written={wire.written} />}
      <p className="actions">
        {wire.kind === "command" && wire.between && <OpenButton between={wire.between} place={wire} />}
        {wire.file && <button type="button" onClick={() => show_text(wire.file!, wire.line, wire.column)}>Show in the text</button>}
        <button type="button" className="danger" onClick={() => void remove_selected()}>Disconnect</button>
      </p>
    </>
  );
}

/** An opened connection from an event to a command. */
export function OpenedView({ box }: { box: Box }) {
  const [from, to] = box.opened!;
  return (
    <>
      <p className="lead">An event that commands</p>
      <h2 className="ends"><span>{from}</span> <span aria-label="to">→</span> <span>{to}</span></h2>
      <Parameters between={box.names[0]!} place={box} written={[from, to]} />
      <p className="actions">
        <OpenButton between={box.names[0]!} place={box} />
        {box.file && <button type="button" onClick={() => show_text(box.file!, box.line, box.column)}>Show in the text</button>}
        <button type="button" className="danger" onClick={() => void remove_selected()}>Disconnect</button>
      </p>
    </>
  );
}

function OpenButton({ between, place }: { between: string; place: Place }) {
  const opened = selection.use((state) => state.opened.includes(between));
  const possible = project.use((state) => can_be_opened(state.texts, place));
  return (
    <button type="button" aria-pressed={opened} disabled={!possible && !opened} onClick={() => toggle_opened(between)}
      title={possible ? "A box on the canvas has a pin for each parameter" : "It is written over several lines: change its parameters in the text"}>Parameters as pins</button>
  );
}

/** Where each parameter of the command comes from. */
function Parameters({ between, place, written }: { between: string; place: Place; written: [string, string] }) {
  const texts = project.use((state) => state.texts);
  const shown = project.use((state) => state.shown);
  if (!shown || !can_be_opened(texts, place)) return null;
  const { file = "", line = 0, column = 1 } = place;
  const settings = settings_at(texts, file, line, column);
  const command = shown.connections.find((one) => one.kind === "command" && one.from === `${between}.Do`)?.to ?? written[1];
  const parameters = parameters_of_command(shown, command, settings);
  if (parameters.length === 0) return null;
  const give = (name: string) => (value: string) => {
    const changed = with_parameter(settings, name, value);
    return edit([change("connection", ...written, ...(changed ? [changed] : []))], { field: `${between} ${name}`, file });
  };
  return (
    <section aria-label="Parameters">
      <h3>Parameters</h3>
      {parameters.map(({ name, type, unit, given }) => (
        <Field key={name} label={name} about={`${between} ${name}`} value={given} unit={unit} take={give(name)}
          hint={given ? "" : "of the event"} title={`${type}: a constant, a port such as Left.Out, or a member of the event`} />
      ))}
    </section>
  );
}

export function facts(wire: Wire): string[] {
  const found: string[] = [];
  if (wire.connections.length > 1) found.push(`stands for ${wire.connections.length} connections`);
  if (wire.triggers) found.push("its data runs the receiver");
  if (wire.delayed) found.push("is seen one cycle later");
  if (wire.crosses_threads) found.push("leads from one thread to another");
  return found;
}
