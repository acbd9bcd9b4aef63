// SPDX-License-Identifier: Apache-2.0
import { Component as ReactComponent, lazy, type ReactNode, Suspense, useEffect } from "react";
import { createRoot } from "react-dom/client";
import type { Backend } from "./backend.ts";
import { Canvas } from "./canvas.tsx";
import { FitMenu } from "./fit_menu.tsx";
import { Inspector } from "./inspector.tsx";
import { useElsewhere, why_fixed } from "./elsewhere.ts";
import { listen_to_keys } from "./keys.ts";
import { Notices } from "./notices.tsx";
import { Outline } from "./outline.tsx";
import { Palette } from "./palette.tsx";
import { Panel } from "./panel.tsx";
import { open_project } from "./project.ts";
import { QuestionView } from "./question.tsx";
import { open_run } from "./run.ts";
import { open_seat } from "./seat.ts";
import { selection } from "./selection.ts";
import { TopBar } from "./top_bar.tsx";
import { start_values } from "./values.ts";

const TextView = lazy(() => import("./text_view.tsx"));
const RobotView = lazy(() => import("./robot_view.tsx"));

export function show_page(backend: Backend): void {
  open_project(backend);
  open_run(backend);
  open_seat(backend);
  start_values();
  createRoot(document.getElementById("page")!).render(<Page />);
}

function Page() {
  const beside = selection.use((state) => state.beside);
  const elsewhere = useElsewhere();
  const operating = selection.use((state) => state.tab === "operate");
  useEffect(listen_to_keys, []);
  return (
    <div className={`studio${beside ? ` with-beside with-${beside}` : ""}${operating ? " operating" : ""}${elsewhere ? " elsewhere" : ""}`}>
      <TopBar />
      <Notices />
      <nav className="left" aria-label="Models and outline">
        {elsewhere ? <p className="hint fixed">{why_fixed(elsewhere)}</p> : <Palette />}
        <Outline />
      </nav>
      <main aria-label="Canvas"><Guard><Canvas /></Guard></main>
      {beside && <BesideView what={beside} />}
      <Guard><Inspector /></Guard>
      <Panel />
      <FitMenu />
      <QuestionView />
    </div>
  );
}

function BesideView({ what }: { what: "text" | "robot" }) {
  const label = what === "text" ? "Text" : "Robot";
  return (
    <section className="beside" aria-label={label}>
      <Guard key={what}><Suspense fallback={<p className="hint">{`Opening the ${what} …`}</p>}>{what === "text" ? <TextView /> : <RobotView />}</Suspense></Guard>
    </section>
  );
}

/** A view that fails leaves the others working, Stop among them. */
export class Guard extends ReactComponent<{ children: ReactNode }, { failed: string }> {
  override state = { failed: "" };

  static getDerivedStateFromError(error: unknown): { failed: string } {
    return { failed: error instanceof Error ? error.message : String(error) };
  }

  override render(): ReactNode {
    if (!this.state.failed) return this.props.children;
    return (
      <div className="empty" role="alert">
        <p>{`This view has failed: ${this.state.failed}`}</p>
        <button type="button" onClick={() => this.setState({ failed: "" })}>Show it again</button>
      </div>
    );
  }
}
