// SPDX-License-Identifier: Apache-2.0
import { Field } from "./field.tsx";
import type { Wire } from "./graph.ts";
import { change, edit, project } from "./project.ts";
import { remove_selected } from "./scene.ts";
import { show_text } from "./selection.ts";
import { settings_at } from "./written.ts";

export function WireView({ wire }: { wire: Wire }) {
  const texts = project.use((state) => state.texts);
  const [from, to] = wire.written;
  const settings = wire.file && wire.line ? settings_at(texts, wire.file, wire.line, wire.column ?? 1) : "";
  const about = `${from} ${to}`;
  const take = (text: string) => edit([change("connection", from, to, ...(text ? [text] : []))], { field: about, file: wire.file });
  return (
    <>
      <p className="lead">{wire.kind === "data" ? "Connection" : "An event that commands"}</p>
      <h2 className="ends"><span>{from}</span> <span aria-label="to">→</span> <span>{to}</span></h2>
      <ul className="list">{facts(wire).map((fact) => <li key={fact}>{fact}</li>)}</ul>
      <Field wide label="Settings" about={about} value={settings} take={take}
        hint={wire.kind === "data" ? "such as policy: {fifo: 8}, max_age: 30 ms" : "such as name: Go, with: {height: 2 m}"} />
      <p className="actions">
        {wire.file && <button type="button" onClick={() => show_text(wire.file!, wire.line, wire.column)}>Show in the text</button>}
        <button type="button" className="danger" onClick={() => void remove_selected()}>Disconnect</button>
      </p>
    </>
  );
}

function facts(wire: Wire): string[] {
  const found: string[] = [];
  if (wire.connections.length > 1) found.push(`stands for ${wire.connections.length} connections`);
  if (wire.triggers) found.push("its data runs the receiver");
  if (wire.delayed) found.push("is seen one cycle later");
  if (wire.crosses_threads) found.push("leads from one thread to another");
  return found;
}
