// SPDX-License-Identifier: Apache-2.0
import { useElsewhere } from "./elsewhere.ts";
import type { Box, BoxPort } from "./graph.ts";
import { has_numbers, port_name, PortValue } from "./port_value.tsx";
import { is_up, run } from "./run.ts";
import { is_source, look_for_ends, useScene } from "./scene.ts";
import { select_box, select_wire, selection, toggle_plotted } from "./selection.ts";

export function PortView({ box, port }: { box: Box; port: BoxPort }) {
  const graph = useScene();
  const live = run.use((all) => is_up(all.state));
  const plotted = selection.use((state) => state.plotted.some(({ name }) => name === port_name(box, port)));
  const elsewhere = useElsewhere();
  const wires = graph.wires.filter(({ from, to }) => [from, to].some((end) => end.box === box.id && end.port === port.id));
  const open = async (event: React.MouseEvent) => {
    const { left, bottom } = event.currentTarget.getBoundingClientRect();
    await look_for_ends(box.id, port.id);
    if (selection.get().reach) selection.set({ menu: { box: box.id, port: port.id, x: left, y: bottom + 4 } });
  };
  return (
    <>
      <p className="lead"><button type="button" className="link" onClick={() => select_box(box.id)}>{box.title}</button> · {port.kind}</p>
      <h2>{port.name}</h2>
      {port.doc && <p>{port.doc}</p>}
      <dl>
        <dt>Type</dt><dd>{port.type}</dd>
        {port.unit && <><dt>Unit</dt><dd>{port.unit}</dd></>}
        {port.size !== undefined && <><dt>Elements</dt><dd>{port.size}</dd></>}
        {port.triggers && <><dt>Triggers</dt><dd>its data runs the component</dd></>}
        {live && has_numbers(port) && <><dt>Now</dt><dd><PortValue port={port} /></dd></>}
      </dl>
      <h3>{is_source(port) ? "Leads to" : "Comes from"}</h3>
      <ul className="list">
        {wires.map((wire) => (
          <li key={wire.id}><button type="button" className="link" onClick={() => select_wire(wire.id)}>{is_source(port) ? wire.written[1] : wire.written[0]}</button></li>
        ))}
      </ul>
      {wires.length === 0 && <p className="hint">Not connected.</p>}
      <p className="actions">
        {!elsewhere && <button type="button" onClick={(event) => void open(event)}>Connect …</button>}
        {has_numbers(port) && <button type="button" aria-pressed={plotted} title={port.ends.length > 1 ? `Draws all ${port.ends.length}` : "Draws its last 60 s"} onClick={() => toggle_plotted(port_name(box, port), port.ends)}>Plot</button>}
      </p>
    </>
  );
}
