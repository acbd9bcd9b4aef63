// SPDX-License-Identifier: Apache-2.0
import { useMemo, useState } from "react";
import type { Property } from "./checked.ts";
import { Field } from "./field.tsx";
import type { Box } from "./graph.ts";
import { map_of, said_in, unquoted } from "./flow_text.ts";
import { change, edit, project } from "./project.ts";
import { number_text } from "./values.ts";

/** @param fallback  what the model has if the deployment says nothing */
export function PropertyField({ box, property, fallback }: { box: Box; property: Property; fallback?: string }) {
  const name = `${box.edited}.${property.name}`;
  const about = `${box.id}.${property.name}`;
  const values = [...new Set(box.components.map((one) => one.properties.find(({ name }) => name === property.name)?.value ?? ""))];
  const value = values[0] ?? "";
  const quantity = useQuantity(box, property);
  const take = (text: string) => edit([text === "" ? change("unset", name) : change("set", name, text)], { field: about, file: box.file });
  const differs = (value !== fallback && fallback !== undefined) || (quantity?.mistaken ?? false);
  const hint = [quantity && !quantity.mistaken && `= ${number_text(Number(value))} ${property.unit}`, property.doc, range_text(property), differs && fallback !== "" && `default ${fallback}`, values.length > 1 && `differs: ${values.slice(0, 7).join("; ")}`];
  return (
    <div className="property">
      <Field label={property.name} about={about} value={quantity?.text ?? value} unit={quantity ? "" : property.unit} list={property.values}
        title={`${property.type}${property.mandatory ? ", has to be set" : ""}`} hint={hint.filter(Boolean).join(" · ")} take={take}>
        {differs && <button type="button" className="unset" title="Unset: takes it out of the file, the default counts" aria-label={`Unset ${property.name}`} onClick={() => void take("")}>↺</button>}
      </Field>
      {slides(property, value) && <Slide property={property} value={Number(value)} take={take} />}
    </div>
  );
}

const kQuantity = /^[-+]?[\d.]+(e[-+]?\d+)?\s*[a-z%]\S*$/i;

/** A number with its unit as the file has it, `45 deg`, and whether its entry has a mistake; undefined if the file says it otherwise. */
function useQuantity({ title, file, line }: Box, { name, unit }: Property): { text: string; mistaken: boolean } | undefined {
  const texts = project.use((state) => state.texts);
  const mistaken = project.use((state) => state.checked?.diagnostics.some((one) => one.severity === "error" && one.file === file && one.line === line) ?? false);
  const text = useMemo(() => (file && line && unit ? unquoted(map_of(said_in(texts, { name: title, file, line }, "properties")).get(name) ?? "") : ""), [texts, title, file, line, name, unit]);
  return kQuantity.test(text) ? { text, mistaken } : undefined;
}

const is_bound = (bound: number | null | undefined): bound is number => typeof bound === "number" && Math.abs(bound) < 1e6;

const kMostWhole = 200;  ///< from here on a slider does not meet each whole number

const is_whole = ({ type }: Property): boolean => /int|long|short/.test(type);

function slides(property: Property, value: string): boolean {
  const [low, high] = property.range ?? [];
  if (!is_bound(low) || !is_bound(high) || value === "" || !Number.isFinite(Number(value))) return false;
  return !is_whole(property) || high - low <= kMostWhole;
}

function range_text({ range }: Property): string {
  if (!range) return "";
  const [low, high] = range;
  if (low === null) return high === null ? "" : `at most ${number_text(high)}`;
  return high === null ? `at least ${number_text(low)}` : `${number_text(low)} to ${number_text(high)}`;
}

/** Moves a number within its range; it is set when it is let go. */
function Slide({ property, value, take }: { property: Property; value: number; take(text: string): Promise<boolean> }) {
  const [moved, set_moved] = useState<number>();
  const [low, high] = property.range as [number, number];
  const let_go = () => {
    if (moved !== undefined && moved !== value) void take(String(Number(moved.toPrecision(6))));
    set_moved(undefined);
  };
  return (
    <input type="range" aria-label={`${property.name}, slider`} min={low} max={high} step={is_whole(property) ? 1 : (high - low) / 200} value={moved ?? value}
      aria-valuetext={`${number_text(moved ?? value)} ${property.unit}`} onChange={(event) => set_moved(Number(event.target.value))}
      onPointerUp={let_go} onKeyUp={let_go} onBlur={let_go} />
  );
}
