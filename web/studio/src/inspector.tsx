// SPDX-License-Identifier: Apache-2.0
// What is selected, to be read and changed.
import { BoxView } from "./box_view.tsx";
import { PortView } from "./port_view.tsx";
import { CommandView } from "./command_view.tsx";
import { ConnectByName } from "./connect_by_name.tsx";
import { has_nothing_yet } from "./checked.ts";
import { useElsewhere } from "./elsewhere.ts";
import { FarBox, FarWire } from "./far_view.tsx";
import { Includes } from "./includes_view.tsx";
import { project } from "./project.ts";
import { group_selected, may_group } from "./grouping.ts";
import { box_called, counted, port_of, remove_selected, useScene } from "./scene.ts";
import { selection } from "./selection.ts";
import { OpenedView, WireView } from "./wire_view.tsx";

export function Inspector() {
  return (
    <aside className="inspector scroll" aria-label="Inspector" tabIndex={0}>
      <Selected />
    </aside>
  );
}

function Selected() {
  const graph = useScene();
  const commanding = selection.use((state) => state.commanding);
  const elsewhere = useElsewhere();
  const { boxes, wires, port } = selection.use((state) => state);
  if (commanding) return <CommandView key={`${commanding.from} ${commanding.to}`} commanding={commanding} />;
  const port_box = port && box_called(port.box);
  const chosen_port = port_box && port_of(port_box, port.port);
  if (port_box && chosen_port) return <PortView box={port_box} port={chosen_port} />;
  const wire = wires.length === 1 && boxes.length === 0 ? graph.wires.find((one) => one.id === wires[0]) : undefined;
  if (wire && elsewhere) return <FarWire wire={wire} />;
  if (wire) return <WireView wire={wire} />;
  const box = boxes.length === 1 ? box_called(boxes[0]!) : undefined;
  if (box && elsewhere) return <FarBox box={box} />;
  if (box?.opened) return <OpenedView key={box.id} box={box} />;
  if (box) return <BoxView key={box.id} box={box} />;
  if (boxes.length + wires.length > 1) return <Several boxes={boxes} wires={wires.length} />;
  return <Application />;
}

function Several({ boxes, wires }: { boxes: string[]; wires: number }) {
  const elsewhere = useElsewhere();
  return (
    <>
      <h2>{[boxes.length > 0 && counted(boxes.length, "box", "boxes"), wires > 0 && counted(wires, "wire")].filter(Boolean).join(" and ")}</h2>
      {!elsewhere && boxes.length > 1 && <p className="hint">{may_group() ? "A group is a composite: a box with these boxes as its parts, and the ports that others use." : "Boxes inside of a composite are not grouped."}</p>}
      {!elsewhere && <p className="actions">
        {may_group() && <button type="button" title="Ctrl+G" onClick={() => void group_selected()}>Group</button>}
        <button type="button" className="danger" onClick={() => void remove_selected()}>Remove</button>
      </p>}
      {!elsewhere && boxes.length > 0 && <ConnectByName boxes={boxes} />}
    </>
  );
}

/** With nothing selected: the application, and what its colours mean. */
function Application() {
  const shown = project.use((state) => state.shown);
  const elsewhere = useElsewhere();
  if (!shown) return null;
  return (
    <>
      <h2>{shown.application || "Application"}</h2>
      {shown.components.length === 0 && <p className="hint">{has_nothing_yet(shown) ? "Nothing is in it yet." : "Its text has a mistake that hides its components: press Text, at the top, and mend it there."}</p>}
      {shown.components.length > 0 && <p>{`${counted(shown.components.length, "component")}, ${counted(shown.connections.filter((one) => one.kind === "data").length, "connection")}`}</p>}
      {shown.threads.length > 0 && <h3>Threads</h3>}
      <ul className="lanes">
        {shown.threads.map((thread, i) => thread.order.length > 0 && <li key={thread.name} data-lane={i}><b>{thread.name}</b> <small>{counted(thread.order.length, "component")}</small></li>)}
      </ul>
      {!elsewhere && shown.components.length > 1 && <p className="actions"><ConnectByName /></p>}
      {!elsewhere && <Includes />}
      {shown.components.length > 0 && <p className="hint">Select a box, a port or a wire to see what it is{elsewhere ? "" : " and to change it"}.</p>}
    </>
  );
}
