// SPDX-License-Identifier: Apache-2.0
import { useMemo, useState } from "react";
import { drag_model } from "./canvas.tsx";
import type { Granularity, Model } from "./checked.ts";
import { project } from "./project.ts";
import { add_model, asked_of } from "./scene.ts";
import { composites_of } from "./written.ts";

interface Offer {
  name: string;
  doc: string;
  granularity: Granularity;
}

/** From what gives tasks to what touches hardware. */
const kOrder: readonly Granularity[] = ["application", "composite", "algorithm", "atomic"];

/** Models by library and granularity, and the composites of the deployment. */
export function Palette() {
  const models = project.use((state) => state.models);
  const texts = project.use((state) => state.texts);
  const [sought, set_sought] = useState("");
  const composites = useMemo(() => composites_of(texts), [texts]);
  const { wanted, model, range } = asked_of(sought.trim());
  const groups = useMemo(() => found(models, composites.map((one) => one.name), model), [models, composites, model]);
  return (
    <section className="palette" aria-label="Models">
      <input type="search" placeholder="Find a model" aria-label="Find a model" value={sought}
        onChange={(event) => set_sought(event.target.value)} onKeyDown={(event) => event.key === "Enter" && add_first(groups, wanted, range)} aria-describedby="palette-keys" />
      <div className="scroll">
        {groups.map(([library, offers]) => <Group key={library} library={library} offers={offers} open={sought !== "" || groups.length < 4} />)}
        {groups.length === 0 && <p className="hint">{models.length > 0 ? "No model is called so, nor says so." : "No models yet: libraries are being read. If none come, build a library, and start the studio with it."}</p>}
      </div>
      <p className="keys" id="palette-keys"><kbd>Enter</kbd> adds the first; <code>PID{"{1..2}"}</code> adds two as one box; <code>Pan=PID</code> names it</p>
    </section>
  );
}

function add_first(groups: [string, Offer[]][], wanted: string, range: string): void {
  const first = groups[0]?.[1][0];
  if (first) void add_model(`${wanted ? `${wanted}=` : ""}${first.name}${range}`);
}

function found(models: Model[], composites: string[], sought: string): [string, Offer[]][] {
  const groups = new Map<string, Offer[]>();
  const word = sought.trim().toLowerCase();
  const offer = (library: string, { name, doc, granularity }: Offer) => {
    if (!`${name} ${doc}`.toLowerCase().includes(word)) return;
    groups.set(library, [...(groups.get(library) ?? []), { name, doc, granularity }]);
  };
  for (const name of composites) offer("This deployment", { name, doc: "of this deployment", granularity: "composite" });
  for (const model of models) offer(model.library || "Armature", model);
  for (const offers of groups.values()) offers.sort((a, b) => rank(a, word) - rank(b, word) || level(a) - level(b) || a.name.localeCompare(b.name));
  return [...groups].sort(([, a], [, b]) => (word ? rank(a[0]!, word) - rank(b[0]!, word) : 0));
}

const level = ({ granularity }: Offer): number => kOrder.indexOf(granularity);

/** Names that begin so come first, then those that have it in them. */
function rank({ name }: Offer, word: string): number {
  const at = name.toLowerCase().indexOf(word);
  return at === 0 ? 0 : at > 0 ? 1 : 2;
}

function Group({ library, offers, open }: { library: string; offers: Offer[]; open: boolean }) {
  const used = project.use((state) => (state.shown?.components.some((one) => offers.some(({ name }) => name === one.model)) ?? false));
  return (
    <details open={open || used}>
      <summary>{library}<span className="count">{offers.length}</span></summary>
      <ul>
        {offers.map(({ name, doc, granularity }) => (
          <li key={name}>
            <button type="button" draggable onDragStart={(event) => drag_model(event, name)} title={`${doc} (${granularity})\nEnter adds one; or drag it`}
              onClick={(event) => event.detail === 0 && void add_model(name)} onDoubleClick={() => void add_model(name)}>
              <span>{name}{granularity !== "algorithm" && <em>{granularity}</em>}</span><small>{doc}</small>
            </button>
          </li>
        ))}
      </ul>
    </details>
  );
}
