// SPDX-License-Identifier: Apache-2.0
import { lazy, type ReactNode, Suspense } from "react";
import { useElsewhere } from "./elsewhere.ts";
import { has_nothing_yet } from "./checked.ts";
import { CycleView } from "./cycle_view.tsx";
import { Log } from "./log.tsx";
import { Modes } from "./modes_view.tsx";
import { Operate } from "./operate.tsx";
import { Problems } from "./problems.tsx";
import { project } from "./project.ts";
import { type Tab, selection } from "./selection.ts";
import { Threads } from "./threads.tsx";

const Plot = lazy(() => import("./plot.tsx"));

const kTabs: [Tab, string][] = [["problems", "Problems"], ["log", "Log"], ["threads", "Threads"], ["cycle", "Cycle"], ["plot", "Plot"], ["modes", "Modes"], ["operate", "Operate"]];

const views: Record<Tab, () => ReactNode> = {
  problems: () => <Problems />, log: () => <Log />, threads: () => <Threads />, cycle: () => <CycleView />, operate: () => <Operate />, modes: () => <Modes />,
  plot: () => <Suspense fallback={<p className="hint">Opening the plot …</p>}><Plot /></Suspense>,
};

/** What is about a file. */
const kOfFiles: readonly Tab[] = ["problems", "modes"];

const tabs_of = (elsewhere: boolean): [Tab, string][] => kTabs.filter(([tab]) => !elsewhere || !kOfFiles.includes(tab));

/** Below the canvas. */
export function Panel() {
  const elsewhere = useElsewhere() !== "";
  const tabs = tabs_of(elsewhere);
  const chosen = selection.use((state) => state.tab);
  const tab = tabs.some(([key]) => key === chosen) ? chosen : "log";
  return (
    <section className="panel" aria-label="Panel">
      <div role="tablist" aria-label="Panel" onKeyDown={(event) => on_key(event, tabs, tab)}>
        {tabs.map(([key, label]) => (
          <button key={key} type="button" role="tab" id={`tab-${key}`} aria-selected={tab === key} aria-controls="panel-view" tabIndex={tab === key ? 0 : -1}
            onClick={() => selection.set({ tab: key })}>{label}{key === "problems" && <Count />}</button>
        ))}
      </div>
      <div role="tabpanel" id="panel-view" aria-labelledby={`tab-${tab}`} className="view">{views[tab]()}</div>
    </section>
  );
}

function on_key(event: React.KeyboardEvent<HTMLElement>, tabs: [Tab, string][], tab: Tab): void {
  const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
  if (by === 0) return;
  const at = tabs.findIndex(([key]) => key === tab);
  const [next] = tabs[(at + by + tabs.length) % tabs.length]!;
  selection.set({ tab: next });
  event.currentTarget.querySelector<HTMLElement>(`#tab-${next}`)?.focus();
}

function Count() {
  const errors = project.use((state) => (state.checked && !has_nothing_yet(state.checked) ? state.checked.errors : 0));
  const others = project.use((state) => (state.checked?.diagnostics.length ?? 0) - (state.checked?.errors ?? 0));
  const refused = project.use((state) => (state.refusal?.diagnostics.some((one) => one.severity === "error") ? 1 : 0));
  const count = errors + Math.max(0, others) + refused;
  return count === 0 ? null : <span className={`count ${errors + refused > 0 ? "bad" : ""}`}>{count}</span>;
}
