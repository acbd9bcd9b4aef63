// SPDX-License-Identifier: Apache-2.0
// What fits a port: ends that are there, and models that have one.
import { useEffect, useMemo, useRef, useState } from "react";
import type { Box, BoxPort, Graph } from "./graph.ts";
import { add_and_connect, connect, useScene, why_not } from "./scene.ts";
import { type FitMenu as Menu, type Reach, selection } from "./selection.ts";

interface Choice {
  key: string;
  text: string;
  why_not: string;
  choose(): Promise<unknown>;
}

export function FitMenu() {
  const menu = selection.use((state) => state.menu);
  const reach = selection.use((state) => state.reach);
  const graph = useScene();
  return menu && reach ? <List key={`${menu.box} ${menu.port}`} menu={menu} reach={reach} graph={graph} /> : null;
}

const close = (): void => selection.set({ menu: undefined, reach: undefined });

function List({ menu, reach, graph }: { menu: Menu; reach: Reach; graph: Graph }) {
  const [sought, set_sought] = useState("");
  const [at, set_at] = useState(0);
  const field = useRef<HTMLInputElement>(null);
  const before = useRef(document.activeElement);
  const all = useMemo(() => [...ends_of(graph, menu), ...models_of(reach, menu)], [graph, menu, reach]);
  const shown = all.filter((one) => one.text.toLowerCase().includes(sought.toLowerCase()));
  const fitting = shown.filter((one) => one.why_not === "");
  const others = shown.filter((one) => one.why_not !== "");
  useEffect(() => {
    field.current?.focus();
    return () => (before.current as HTMLElement | null)?.focus?.();
  }, []);
  const choose = (choice: Choice | undefined) => {
    if (!choice) return;
    void choice.choose();
    close();
  };
  const on_key = (event: React.KeyboardEvent) => {
    if (event.key === "ArrowDown") set_at(Math.min(at + 1, fitting.length - 1));
    else if (event.key === "ArrowUp") set_at(Math.max(at - 1, 0));
    else if (event.key === "Enter") choose(fitting[at]);
    else return;
    event.preventDefault();
  };
  const name = graph.boxes.find((box) => box.id === menu.box)?.title ?? "";
  return (
    <div className="fit-menu" role="dialog" aria-label={`What fits ${name}`} style={place_of(menu)} onBlur={(event) => !event.currentTarget.contains(event.relatedTarget) && close()}>
      <input ref={field} role="combobox" aria-expanded="true" aria-controls="fits" aria-activedescendant={fitting[at] ? `fit-${at}` : undefined}
        aria-label="Connect with" placeholder="Connect with …" value={sought}
        onChange={(event) => (set_sought(event.target.value), set_at(0))} onKeyDown={on_key} />
      <ul id="fits" role="listbox" aria-label="What fits">
        {fitting.map((one, i) => (
          <li key={one.key} id={`fit-${i}`} role="option" aria-selected={i === at} onMouseDown={(event) => event.preventDefault()}
            onMouseEnter={() => set_at(i)} onClick={() => choose(one)}>{one.text}</li>
        ))}
      </ul>
      {fitting.length === 0 && <p className="hint">Nothing fits{sought ? " that is called so" : " yet"}.</p>}
      {others.length > 0 && (
        <details>
          <summary>{`${others.length} do not fit`}</summary>
          <ul>{others.slice(0, 60).map((one) => <li key={one.key}><b>{one.text}</b> {one.why_not}</li>)}</ul>
        </details>
      )}
    </div>
  );
}

function place_of({ x, y }: Menu): React.CSSProperties {
  const left = Math.max(8, Math.min(x, innerWidth - 336));
  return y > innerHeight * 0.6 ? { left, bottom: innerHeight - y } : { left, top: y };
}

function ends_of(graph: Graph, menu: Menu): Choice[] {
  const found: Choice[] = [];
  for (const box of graph.boxes) {
    for (const port of [...box.inputs, ...box.outputs]) {
      const reason = why_not(port);
      if (reason !== undefined) found.push(end_choice(box, port, reason, menu));
    }
  }
  return found;
}

const end_choice = (box: Box, port: BoxPort, reason: string, menu: Menu): Choice => ({
  key: `${box.id} ${port.id}`,
  text: `${box.title}.${port.name}`,
  why_not: reason,
  choose: () => connect({ box: menu.box, port: menu.port }, { box: box.id, port: port.id }),
});

function models_of(reach: Reach, menu: Menu): Choice[] {
  return reach.models.filter((one) => !one.why_not).map((end) => ({
    key: `model ${end.component}.${end.member}`,
    text: `new ${end.component}: ${end.member}${end.names ? `, in ${end.names.unit}` : ""}`,
    why_not: "",
    choose: () => add_and_connect(menu, end),
  }));
}

