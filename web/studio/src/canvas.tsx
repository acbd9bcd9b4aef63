// SPDX-License-Identifier: Apache-2.0
import {
  applyNodeChanges, Background, BackgroundVariant, type Connection, ConnectionMode, ControlButton, Controls, type Edge, type EdgeChange, MiniMap, type NodeChange,
  type OnConnectEnd, type OnConnectStart, ReactFlow, ReactFlowProvider, useReactFlow, useStore, ViewportPortal,
} from "@xyflow/react";
import { useCallback, useEffect, useMemo, useRef, useState } from "react";
import { WireEdge } from "./wire_edge.tsx";
import { BoxNode, type BoxData, type BoxNodeType } from "./box_node.tsx";
import { Breadcrumb } from "./breadcrumb.tsx";
import { port_place, size_of } from "./geometry.ts";
import { has_nothing_yet } from "./checked.ts";
import { is_elsewhere, useElsewhere } from "./elsewhere.ts";
import type { Box, Graph, Wire } from "./graph.ts";
import type { Lane } from "./lanes.ts";
import { on_grid, type Point } from "./layout.ts";
import { is_off } from "./modes.ts";
import { ShownMode, useShownMode } from "./modes_view.tsx";
import { kMostWithPorts, lanes_of, places_of } from "./placing.ts";
import { change, edit, project } from "./project.ts";
import { arrange, arrangements } from "./remembered.ts";
import { add_model, box_called, connect, is_source, look_for_ends, port_of, remove_selected, useScene, why_not } from "./scene.ts";
import { open_composite, selection, tell, toggle_opened } from "./selection.ts";

const kFar = 0.3;           ///< zoomed out further, boxes have no ports
const kManyBoxes = 100;     ///< from here on only what is in sight is drawn
const kMostWithoutMap = 10;
const kDelete = ["Delete", "Backspace"];
const kSnap: [number, number] = [8, 8];
const kDragged = "application/x-armature-model";
const kFitMany = { padding: 0.06, maxZoom: 1 };
/** Beside the buttons at the left. */
const kFit = { padding: { left: "56px", right: "20px", y: "20px" } as const, maxZoom: 1, minZoom: 0.4 };
const kFitInside = { ...kFit, padding: { x: "64px", y: "24px" } as const };  ///< ports tell what they are connected with outside
const kFitLanes = { ...kFit, padding: 0.12 };
const node_types = { box: BoxNode };
const edge_types = { wire: WireEdge };

export const drag_model = (event: React.DragEvent, model: string): void => event.dataTransfer.setData(kDragged, model);

export function Canvas() {
  return (
    <ReactFlowProvider>
      <Breadcrumb />
      <Flow />
    </ReactFlowProvider>
  );
}

function Flow() {
  const graph = useScene();
  const stale = project.use((state) => state.stale);
  const nodes = useNodes(graph);
  const edges = useEdges(graph);
  const reaching = selection.use((state) => state.reach !== undefined);
  const in_lanes = selection.use((state) => state.lanes);
  const many = graph.boxes.length > kManyBoxes;
  const fixed = useElsewhere() !== "";
  useReveal();
  useNewInSight(graph);
  const drop = useDrop();
  const wire_end = useWireEnd();
  return (
    <div className={`canvas${stale ? " stale" : ""}${reaching ? " reaching" : ""}`}>
      <ReactFlow<BoxNodeType>
        nodes={nodes.all} edges={edges} nodeTypes={node_types} edgeTypes={edge_types} onNodesChange={nodes.changed} onEdgesChange={wires_changed}
        onConnect={wire_made} onConnectStart={wire_begun} onConnectEnd={wire_end} isValidConnection={may_connect}
        connectionMode={ConnectionMode.Loose} connectionRadius={16} onNodeDoubleClick={(_, node) => open_box(node.data.box)}
        onPaneClick={() => selection.set({ boxes: [], wires: [], port: undefined, menu: undefined, commanding: undefined })}
        onBeforeDelete={async () => (void remove_selected(), false)} deleteKeyCode={fixed ? null : kDelete} nodesConnectable={!fixed}
        onKeyDown={open_with_key} onDrop={drop} onDragOver={(event) => event.preventDefault()} nodesDraggable={!in_lanes} snapToGrid snapGrid={kSnap} minZoom={0.05} maxZoom={2}
        fitView fitViewOptions={graph.boxes.length > kManyBoxes ? kFitMany : kFit} onlyRenderVisibleElements={many} zoomOnDoubleClick={false}
        ariaLabelConfig={{ "node.a11yDescription.default": `Arrows move the box, Enter opens a composite${fixed ? "" : ", Delete removes it"}` }}
        proOptions={{ hideAttribution: false }} colorMode="system">
        <Background variant={BackgroundVariant.Dots} gap={24} size={1} />
        <LaneBands lanes={nodes.lanes} />
        <Controls showInteractive={false}>
          <ControlButton onClick={arrange} title="Lay out anew all boxes that nobody moved" aria-label="Arrange">⇶</ControlButton>
          <ControlButton onClick={() => selection.set({ lanes: !in_lanes })} title="Threads as lanes: places of boxes stay as they are" aria-label="Threads as lanes" aria-pressed={in_lanes}>☰</ControlButton>
        </Controls>
        <ShownMode />
        {graph.boxes.length > kMostWithoutMap && <MiniMap pannable zoomable ariaLabel="Overview" />}
      </ReactFlow>
      {graph.boxes.length === 0 && <Empty />}
      {stale && <p className="stale-note" role="status">The text has a mistake that hides its components. The canvas shows them as they were; mend the text, or take it back with Undo.</p>}
    </div>
  );
}

/** Behind the boxes. */
function LaneBands({ lanes }: { lanes: Lane[] }) {
  return (
    <ViewportPortal>
      {lanes.map(({ title, number, x, y, width, height }) => (
        <div key={title} className="lane" data-lane={number} style={{ translate: `${x}px ${y}px`, width, height }}>{title}</div>
      ))}
    </ViewportPortal>
  );
}

function Empty() {
  const checked = project.use((state) => state.checked);
  const loaded = project.use((state) => state.loaded);
  const elsewhere = useElsewhere();
  if (!loaded || !checked) return <div className="empty"><p><strong>Reading the deployment …</strong></p></div>;
  if (elsewhere) return <div className="empty"><p><strong>The application has no component that this studio may read.</strong></p></div>;
  if (!has_nothing_yet(checked)) {
    return (
      <div className="empty">
        <p><strong>The text cannot be read as it is.</strong></p>
        <p>Problems, below, say where and why. Press Text, at the top, and mend it there: the components then stand here.</p>
      </div>
    );
  }
  return (
    <div className="empty">
      <p className="invitation">Drag a model here</p>
      <p>or press <kbd>Enter</kbd> in the list on the left. Then drag wires from outputs, on the right of a box, to inputs, on its left.</p>
      <p>A robot or a controller of another file? Include it: under Included files, on the right.</p>
    </div>
  );
}

/** Boxes as nodes. While one is dragged its place is here; once it is dropped, in the project. */
function useNodes(graph: Graph) {
  const places = project.use((state) => state.places);
  const diagnostics = project.use((state) => state.checked?.diagnostics);
  const chosen = selection.use((state) => state.boxes);
  const far = useStore((state) => state.transform[2] < kFar);
  const ports = !far && graph.boxes.length <= kMostWithPorts;
  const [moved, set_moved] = useState<ReadonlyMap<string, Point>>(new Map());
  useEffect(() => set_moved(new Map()), [places, graph]);
  const { modes, mode } = useShownMode();
  const arranged = arrangements.use((state) => state.count);
  const in_lanes = selection.use((state) => state.lanes);
  const laid = useMemo(() => (in_lanes ? lanes_of(graph) : { places: places_of(graph, places), lanes: [] }), [graph, places, arranged, in_lanes]);
  const all = useMemo(
    () => graph.boxes.map((box) => node_of(moved.get(box.id) ?? laid.places.get(box.id)!, chosen.includes(box.id), { box, ports, lane: lane_of(box), errors: errors_of(box, diagnostics), off: is_off(box, modes, mode) })),
    [graph, moved, laid, ports, chosen, diagnostics, modes, mode],
  );
  const changed = useCallback((changes: NodeChange<BoxNodeType>[]) => {
    select_nodes(changes);
    const moves = changes.filter((one) => one.type === "position" && one.position);
    if (moves.length === 0) return;
    const now = applyNodeChanges(moves, all);
    set_moved((before) => new Map([...before, ...moves.map((one) => place_in(now, (one as { id: string }).id))]));
    const dropped = moves.filter((one) => one.type === "position" && !one.dragging).map((one) => place_in(now, (one as { id: string }).id));
    if (dropped.length > 0) void edit(dropped.map(([id, [x, y]]) => change("place", id, String(x), String(y))));
  }, [all]);
  return { all, changed, lanes: laid.lanes };
}

function place_in(nodes: BoxNodeType[], id: string): [string, Point] {
  const { x, y } = nodes.find((node) => node.id === id)!.position;
  return [id, [on_grid(x), on_grid(y)]];
}

function node_of([x, y]: Point, selected: boolean, data: BoxData): BoxNodeType {
  const { box, ports, off } = data;
  const size = size_of(box, ports);
  const handles = [...box.inputs, ...box.outputs].map((port) => {
    const at = port_place(box, port, ports);
    const source = is_source(port);
    return {
      id: port.id, type: source ? ("source" as const) : ("target" as const), position: source ? ("right" as never) : ("left" as never),
      x: at.x - 5, y: at.y - 5, width: 10, height: 10,
    };
  });
  const label = `${box.title}, ${box.model}${box.names.length > 1 ? `, ${box.names.length} of them` : ""}${off ? ", off in this mode" : ""}`;
  return { id: box.id, type: "box", position: { x, y }, ...size, measured: size, selected, data, handles, ariaLabel: label, domAttributes: { "aria-roledescription": "box" } };
}

/** The number of its thread's colour. */
function lane_of(box: Box): number {
  const threads = project.get().shown?.threads ?? [];
  return threads.findIndex((thread) => thread.name === box.thread);
}

function errors_of(box: Box, diagnostics: readonly { severity: string; file?: string; line?: number }[] = []): number {
  return diagnostics.filter((one) => one.severity === "error" && one.file === box.file && one.line === box.line).length;
}

function select_nodes(changes: NodeChange<BoxNodeType>[]): void {
  const selects = changes.filter((one) => one.type === "select");
  if (selects.length === 0) return;
  const chosen = new Set(selection.get().boxes);
  for (const one of selects) {
    if (one.selected) chosen.add(one.id);
    else chosen.delete(one.id);
  }
  const another = selects.some((one) => one.selected) ? { commanding: undefined } : {};
  selection.set({ boxes: [...chosen], port: undefined, ...another });
}

function useEdges(graph: Graph): Edge[] {
  const chosen = selection.use((state) => state.wires);
  const boxes = selection.use((state) => state.boxes);
  return useMemo(() => graph.wires.map((wire) => edge_of(wire, chosen.includes(wire.id), boxes)), [graph, chosen, boxes]);
}

function edge_of(wire: Wire, selected: boolean, boxes: string[]): Edge {
  const near = boxes.includes(wire.from.box) || boxes.includes(wire.to.box);
  const classes = [wire.kind, wire.triggers && "triggers", wire.delayed && "delayed", near && "near"];
  return {
    id: wire.id, type: "wire", source: wire.from.box, sourceHandle: wire.from.port, target: wire.to.box, targetHandle: wire.to.port, selected,
    className: classes.filter(Boolean).join(" "), ariaLabel: label_of(wire), interactionWidth: 14,
  };
}

function label_of({ written: [from, to], parameter, between, connections }: Wire): string {
  return parameter ? `${connections[0]!.from} to ${between}.${parameter}` : `${from} to ${to}`;
}

function wires_changed(changes: EdgeChange[]): void {
  const selects = changes.filter((one) => one.type === "select");
  if (selects.length === 0) return;
  const chosen = new Set(selection.get().wires);
  for (const one of selects) {
    if (one.selected) chosen.add(one.id);
    else chosen.delete(one.id);
  }
  selection.set({ wires: [...chosen] });
}

const wire_begun: OnConnectStart = (_, { nodeId, handleId }) => {
  if (nodeId && handleId && !is_elsewhere()) void look_for_ends(nodeId, handleId);
};

function wire_made({ source, sourceHandle, target, targetHandle }: Connection): void {
  if (!sourceHandle || !targetHandle) return;
  void connect({ box: source, port: sourceHandle }, { box: target, port: targetHandle });
}

function may_connect({ source, sourceHandle, target, targetHandle }: Connection | Edge): boolean {
  const { reach } = selection.get();
  const other = reach?.box === source && reach.port === sourceHandle ? [target, targetHandle] : [source, sourceHandle];
  const box = box_called(other[0] ?? "");
  const port = box && port_of(box, other[1] ?? "");
  return port !== undefined && (why_not(port) ?? (port.parameter ? "" : undefined)) === "";
}

/** Dropped on nothing a wire offers models; on what does not fit, the reason. */
function useWireEnd(): OnConnectEnd {
  const flow = useReactFlow();
  return useCallback((event, state) => {
    const { reach } = selection.get();
    if (!reach) return;
    const { clientX, clientY } = "changedTouches" in event ? event.changedTouches[0]! : event;
    if (state.toHandle?.id && !state.isValid) tell_why(state.toHandle.nodeId, state.toHandle.id);
    const nothing = !state.toHandle && !state.toNode;
    const at = flow.screenToFlowPosition({ x: clientX, y: clientY });
    const place: Point = [on_grid(at.x), on_grid(at.y)];
    const menu = nothing ? { box: reach.box, port: reach.port, x: clientX, y: clientY, place } : undefined;
    selection.set(menu ? { menu } : { reach: undefined });
  }, [flow]);
}

function tell_why(node: string, handle: string): void {
  const box = box_called(node);
  const port = box && port_of(box, handle);
  if (!port) return;
  const reason = why_not(port);
  if (reason !== "") tell(reason ?? `A wire from here cannot lead to ${port.written}.`);
}

function useDrop() {
  const flow = useReactFlow();
  return useCallback((event: React.DragEvent) => {
    const model = event.dataTransfer.getData(kDragged);
    if (!model) return;
    event.preventDefault();
    const { x, y } = flow.screenToFlowPosition({ x: event.clientX, y: event.clientY });
    void add_model(model, [on_grid(x), on_grid(y)]);
  }, [flow]);
}

function open_box(box: Box): void {
  if (box.composite) open_composite([...selection.get().path, box.title]);
  if (box.opened) toggle_opened(box.names[0]!);
}

function open_with_key(event: React.KeyboardEvent): void {
  const { boxes } = selection.get();
  const box = boxes.length === 1 ? box_called(boxes[0]!) : undefined;
  if (event.key === "Enter" && box?.composite) open_box(box);
}

/** Moves the canvas to the box that was chosen elsewhere. */
function useReveal(): void {
  const flow = useReactFlow();
  const reveal = selection.use((state) => state.reveal);
  const path = selection.use((state) => state.path);
  const beside = selection.use((state) => state.beside);
  const in_lanes = selection.use((state) => state.lanes);
  useEffect(() => {
    const duration = matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 200;
    if (reveal) void flow.fitView({ nodes: [{ id: reveal.box }], maxZoom: 1, minZoom: 0.6, duration, padding: 0.4 });
  }, [flow, reveal]);
  useEffect(() => void setTimeout(() => void flow.fitView(path.length > 0 ? kFitInside : in_lanes ? kFitLanes : kFit), 30), [flow, path, beside, in_lanes]);
}

/** A box that is new and selected comes into sight, with all others if they are not too many. */
function useNewInSight(graph: Graph): void {
  const flow = useReactFlow();
  const width = useStore((state) => state.width);
  const height = useStore((state) => state.height);
  const before = useRef(graph.boxes.length);
  useEffect(() => {
    const more = graph.boxes.length > before.current;
    before.current = graph.boxes.length;
    const [chosen] = selection.get().boxes;
    const node = more && chosen ? flow.getNode(chosen) : undefined;
    if (!node) return;
    const { x, y, zoom } = flow.getViewport();
    const [left, top] = [node.position.x * zoom + x, node.position.y * zoom + y];
    const [right, bottom] = [left + (node.width ?? 0) * zoom, top + (node.height ?? 0) * zoom];
    if (left >= 0 && top >= 0 && right <= width && bottom <= height) return;
    void flow.fitView(graph.boxes.length > kManyBoxes ? { nodes: [{ id: node.id }], maxZoom: 1 } : kFit);
  }, [flow, graph, width, height]);
}
