// SPDX-License-Identifier: Apache-2.0
// The canvas as a tree, for the keyboard and for screen readers.
import { useEffect, useMemo, useRef, useState } from "react";
import { is_elsewhere, useElsewhere } from "./elsewhere.ts";
import type { Box, BoxPort, Graph } from "./graph.ts";
import { change, edit } from "./project.ts";
import { connect_by_name, look_for_ends, remove_selected, useScene } from "./scene.ts";
import { port_name } from "./port_value.tsx";
import { open_composite, select_box, select_port, selection, toggle_plotted } from "./selection.ts";

interface Row {
  key: string;
  box: Box;
  port?: BoxPort;
  set: number;    ///< how many stand beside it
  place: number;  ///< which of them it is
}

function rows_of(graph: Graph, open: ReadonlySet<string>): Row[] {
  return graph.boxes.flatMap((box, i) => {
    const ports = [...box.inputs, ...box.outputs];
    const own: Row = { key: box.id, box, set: graph.boxes.length, place: i + 1 };
    const rows = ports.map((port, k): Row => ({ key: `${box.id} ${port.id}`, box, port, set: ports.length, place: k + 1 }));
    return open.has(box.id) ? [own, ...rows] : [own];
  });
}

export function Outline() {
  const graph = useScene();
  const elsewhere = useElsewhere();
  const [open, set_open] = useState<ReadonlySet<string>>(new Set());
  const [at, set_at] = useState("");
  const [renamed, set_renamed] = useState("");
  const [seeking, set_seeking] = useState(false);
  const reached = useRef("");
  const tree = useRef<HTMLUListElement>(null);
  const rows = useMemo(() => rows_of(graph, open), [graph, open]);
  const current = rows.some((row) => row.key === at) ? at : rows[0]?.key;

  const go = (row: Row | undefined) => {
    if (!row) return;
    set_at(row.key);
    tree.current?.querySelector<HTMLElement>(`[data-key="${CSS.escape(row.key)}"]`)?.focus();
  };
  useEffect(() => {
    if (!reached.current || seeking) return;
    go(rows.find((row) => row.key === reached.current));
    reached.current = "";
  });
  const seek = (text?: string) => {
    const found = text ? row_called(graph, text) : undefined;
    if (found?.port) unfold(found.box, true);
    reached.current = text === undefined ? "" : (found?.key ?? current ?? "");
    set_seeking(false);
  };
  const unfold = (box: Box, unfolded: boolean) => {
    const now = new Set(open);
    if (unfolded) now.add(box.id);
    else now.delete(box.id);
    set_open(now);
  };
  const on_key = (event: React.KeyboardEvent, row: Row, index: number) => {
    const action = action_of(event, row, { go: (by) => go(rows[index + by]), end: (last) => go(last ? rows.at(-1) : rows[0]), unfold, open,
      rename: () => set_renamed(row.box.id), seek: () => set_seeking(true), parent: () => go(rows.find((one) => one.key === row.box.id)) });
    if (!action) return;
    event.preventDefault();
    event.stopPropagation();  // the canvas hears Delete everywhere
    action();
  };
  return (
    <section className="outline" aria-label="Outline">
      <h2>Outline</h2>
      {rows.length === 0 && <p className="hint">Components are listed here.</p>}
      {seeking && <Seek graph={graph} done={seek} />}
      <ul role="tree" aria-label="Boxes and their ports" ref={tree} className="scroll">
        {rows.map((row, index) => (
          row.box.id === renamed && !row.port
            ? <Rename key={row.key} box={row.box} done={() => set_renamed("")} />
            : <RowView key={row.key} row={row} open={open.has(row.box.id)} current={row.key === current}
                on_key={(event) => on_key(event, row, index)} on_focus={() => set_at(row.key)} unfold={unfold} />
        ))}
      </ul>
      {rows.length > 0 && !elsewhere && <p className="keys"><kbd>/</kbd> goes to <kbd>F2</kbd> renames <kbd>C</kbd> connects <kbd>Del</kbd> removes <kbd>Ctrl+G</kbd> groups</p>}
    </section>
  );
}

interface Moves {
  go(by: number): void;
  end(last: boolean): void;
  parent(): void;
  rename(): void;
  seek(): void;
  unfold(box: Box, unfolded: boolean): void;
  open: ReadonlySet<string>;
}

/** Keys that change the deployment. */
const kEditing = ["F2", "Delete", "c", "C"];

function action_of(event: React.KeyboardEvent, row: Row, moves: Moves): (() => void) | undefined {
  const { box, port } = row;
  if (event.ctrlKey || event.metaKey || event.altKey) return undefined;
  const open = moves.open.has(box.id);
  if (is_elsewhere() && kEditing.includes(event.key)) return undefined;
  switch (event.key) {
    case "ArrowDown": return () => moves.go(1);
    case "ArrowUp": return () => moves.go(-1);
    case "Home": return () => moves.end(false);
    case "End": return () => moves.end(true);
    case "ArrowRight": return port ? undefined : () => (open ? moves.go(1) : moves.unfold(box, true));
    case "ArrowLeft": return port ? moves.parent : () => moves.unfold(box, false);
    case "Enter": return () => enter(row);
    case " ": return () => choose(row);
    case "F2": return moves.rename;
    case "/": return moves.seek;
    case "Delete": return () => remove(row);
    case "c": case "C": return () => void (port ? open_menu(event.currentTarget, box, port) : connect_by_name([box.id]));
    case "p": case "P": return port ? () => toggle_plotted(port_name(box, port), port.ends) : undefined;
    default: return undefined;
  }
}

/** The box of a name, or `Box.Port`; else the first whose name begins so. */
function row_called(graph: Graph, text: string): Row | undefined {
  const all = rows_of(graph, new Set(graph.boxes.map((box) => box.id))).map((row) => ({ row, name: name_of(row).toLowerCase() }));
  const sought = text.toLowerCase();
  return (all.find(({ name }) => name === sought) ?? all.find(({ name }) => name.startsWith(sought)))?.row;
}

const name_of = ({ box, port }: Row): string => (port ? `${box.title}.${port.name}` : box.title);

function choose({ box, port }: Row): void {
  if (port) select_port(box.id, port.id);
  else select_box(box.id, true);
}

/** A second Enter opens a composite. */
function enter(row: Row): void {
  const { boxes, path } = selection.get();
  if (!row.port && row.box.composite && boxes[0] === row.box.id) open_composite([...path, row.box.title]);
  else choose(row);
}

function remove(row: Row): void {
  if (row.port) return;
  select_box(row.box.id);
  void remove_selected();
}

async function open_menu(row: Element, box: Box, port: BoxPort): Promise<void> {
  const { left, bottom } = row.getBoundingClientRect();
  select_port(box.id, port.id);
  await look_for_ends(box.id, port.id);
  if (selection.get().reach) selection.set({ menu: { box: box.id, port: port.id, x: left + 16, y: bottom } });
}

function RowView({ row, open, current, on_key, on_focus, unfold }: {
  row: Row; open: boolean; current: boolean; on_key(event: React.KeyboardEvent): void; on_focus(): void; unfold(box: Box, unfolded: boolean): void;
}) {
  const { box, port } = row;
  const selected = selection.use((state) => (port ? state.port?.box === box.id && state.port.port === port.id : state.boxes.includes(box.id)));
  return (
    <li role="treeitem" aria-level={port ? 2 : 1} aria-setsize={row.set} aria-posinset={row.place} aria-selected={selected}
      aria-expanded={port ? undefined : open} tabIndex={current ? 0 : -1} data-key={row.key} onKeyDown={on_key} onFocus={on_focus}
      onClick={() => choose(row)} title={port ? `${port.type} ${port.unit}`.trim() : box.model}>
      {!port && <span className="fold" aria-hidden="true" onClick={(event) => (event.stopPropagation(), unfold(box, !open))}>{open ? "▾" : "▸"}</span>}
      {port && <span className={`mark ${port.kind}`} aria-hidden="true" />}
      <span className="name">{port ? port.name : box.title}</span>
      <small>{port ? port.unit || port.kind : box.model}</small>
    </li>
  );
}

/** Asks where to go; with Escape nowhere. */
function Seek({ graph, done }: { graph: Graph; done(text?: string): void }) {
  return (
    <>
      <input autoFocus aria-label="Go to" placeholder="such as Sum, or Sum.Out" list="boxes" spellCheck={false} autoComplete="off" onBlur={() => done()}
        onKeyDown={(event) => {
          if (event.key === "Enter") done(event.currentTarget.value.trim());
          if (event.key === "Escape") done("");
        }} />
      <datalist id="boxes">{graph.boxes.map((box) => <option key={box.id} value={box.title} />)}</datalist>
    </>
  );
}

function Rename({ box, done }: { box: Box; done(): void }) {
  const rename = async (name: string) => {
    done();
    if (name && name !== box.title && (await edit([change("rename", box.edited, name)], { field: `${box.id} name`, file: box.file }))) select_box(name);
  };
  return (
    <li role="treeitem" aria-level={1} aria-selected={true}>
      <input autoFocus defaultValue={box.title} aria-label={`New name of ${box.title}`} onBlur={done}
        onKeyDown={(event) => {
          if (event.key === "Enter") void rename(event.currentTarget.value.trim());
          if (event.key === "Escape") done();
        }} />
    </li>
  );
}
