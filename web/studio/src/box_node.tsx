// SPDX-License-Identifier: Apache-2.0
import { Handle, type Node, type NodeProps, Position } from "@xyflow/react";
import { memo } from "react";
import { activity_text } from "./checked.ts";
import type { Box, BoxPort } from "./graph.ts";
import { port_place } from "./geometry.ts";
import { PortValue } from "./port_value.tsx";
import { is_source, why_not } from "./scene.ts";
import { is_up, run } from "./run.ts";
import { select_port, selection } from "./selection.ts";
import { boxes_state, state_class } from "./states.ts";

export interface BoxData extends Record<string, unknown> {
  box: Box;
  ports: boolean;
  lane: number;      ///< of its thread; -1: several, or none
  errors: number;
  off: boolean;      ///< in the mode that is shown
}

export type BoxNodeType = Node<BoxData, "box">;

export const BoxNode = memo(({ data, selected }: NodeProps<BoxNodeType>) => {
  const { box, ports, lane, errors, off } = data;
  const state = run.use((all) => boxes_state(box, all.components));
  const dashed = off && !["is-running", "is-faulty"].includes(state_class(state));  // what the run says comes first
  const stacked = box.names.length > 1;
  const classes = ["box", selected && "selected", stacked && "stacked", box.composite && "composite", state_class(state), dashed && "is-off", box.components[0]!.unknown && "is-unknown"];
  return (
    <div className={classes.filter(Boolean).join(" ")} data-lane={lane}>
      <header title={box_title(box)}>
        <strong>{box.title}</strong>
        {stacked && <span className="count">{`×${box.names.length}`}</span>}
        {errors > 0 && <span className="mistakes" title={`${errors} problems`}>!</span>}
        <small>{subtitle(box)}</small>
        {(state || off) && <em className="state">{state || "off"}</em>}
      </header>
      {box.inputs.map((port) => <PortRow key={port.id} box={box} port={port} shown={ports} />)}
      {box.outputs.map((port) => <PortRow key={port.id} box={box} port={port} shown={ports} />)}
    </div>
  );
});

function subtitle(box: Box): string {
  if (box.opened) return "an event that commands";
  if (box.components[0]!.unknown) return `${box.model || "no model"} · has a mistake`;
  if (!box.model) return "switches modes";
  if (box.composite) return `${box.model} · ${box.components.length} parts`;
  return `${box.model} · ${activity_text(box.components[0]!.activity)}`;
}

function box_title(box: Box): string {
  const lines = [`${box.id}: ${box.model}`];
  if (box.composite) lines.push("Double click or Enter shows what is inside");
  if (box.thread) lines.push(`runs in the thread ${box.thread}`);
  if (box.file) lines.push(`${box.file}:${box.line ?? 1}`);
  return lines.join("\n");
}

/** `Position: double [rad], 7 elements` and its doc. */
export function port_title(port: BoxPort): string {
  const size = port.size === undefined ? "" : `, ${port.size} elements`;
  const unit = port.unit ? ` [${port.unit}]` : "";
  const trigger = port.triggers ? "\nIts data runs the component" : "";
  return `${port.kind} ${port.name}: ${port.type}${unit}${size}\n${port.doc}${trigger}`.trim();
}

function PortRow({ box, port, shown }: { box: Box; port: BoxPort; shown: boolean }) {
  const fits = selection.use((state) => (state.reach ? fit_of(box, port) : "plain"));
  const picked = selection.use((state) => state.port?.box === box.id && state.port.port === port.id);
  const live = run.use((state) => is_up(state.state));
  const source = is_source(port);
  const { y } = port_place(box, port, shown);
  const reason = fits === "bad" ? why_not(port) || "A wire cannot lead here" : port_title(port);
  const handle = (
    <Handle id={port.id} type={source ? "source" : "target"} position={source ? Position.Right : Position.Left}
      className={`pin ${port.kind}`} style={{ top: y }} title={reason} />
  );
  if (!shown) return handle;
  return (
    <>
      {handle}
      <div className={`port ${source ? "out" : "in"} ${fits}${picked ? " picked" : ""}${port.triggers ? " triggers" : ""}`}
        style={{ top: y - 11 }} title={reason} onClick={(event) => pick(event, box, port)}>
        <span>{port.name}</span>
        {live && source && <PortValue port={port} brief />}
        {port.outside && <span className="outside" title={port.outside.join("\n")}>{outside_text(port.outside)}</span>}
      </div>
    </>
  );
}

const outside_text = (ends: string[]): string => (ends.length > 1 ? `${ends[0]} +${ends.length - 1}` : ends[0]!);

function pick(event: React.MouseEvent, box: Box, port: BoxPort): void {
  event.stopPropagation();
  select_port(box.id, port.id);
}

function fit_of(box: Box, port: BoxPort): "own" | "good" | "bad" {
  const { reach } = selection.get();
  if (reach?.box === box.id && reach.port === port.id) return "own";
  return why_not(port) === "" ? "good" : "bad";
}
