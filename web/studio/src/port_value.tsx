// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from "react";
import type { Box, BoxPort } from "./graph.ts";
import { age_text, numbers_text, truth_text, watch, with_unit } from "./values.ts";

const kMostEnds = 16;
const kOld = 1;  ///< from this age on a value is shown as old [s]

/** Whether a port's values are numbers, which can be watched. */
export const has_numbers = (port: BoxPort): boolean =>
  (port.kind === "input" || port.kind === "output") && /double|float|int|bool|Vector|number|long|short|byte/i.test(port.type);

/** The port of the only component, or of all that the box stands for. */
export const port_name = (box: Box, port: BoxPort): string => (port.ends.length > 1 ? `${box.id}.${port.name}` : port.ends[0]!);

/** The numbers of a port, as they come. @param brief  several stand without their unit, which the inspector shows */
export function PortValue({ port, brief = false }: { port: BoxPort; brief?: boolean }) {
  const place = useRef<HTMLOutputElement>(null);
  const items = has_numbers(port) ? port.ends.slice(0, kMostEnds).join("\n") : "";
  useEffect(() => (items ? show_numbers(items.split("\n"), place.current!, port, brief) : undefined), [items, port.unit, port.type, brief]);
  return items ? <output className="value" ref={place} aria-live="off" /> : null;
}

function show_numbers(items: string[], place: HTMLOutputElement, { type, unit }: BoxPort, brief: boolean): () => void {
  const text_of = type === "bool" ? truth_text : numbers_text;
  const known = new Map<string, number[]>();
  let text = "";
  const ends = items.map((item) => watch(item, (numbers, age) => {
    known.set(item, numbers);
    const all = [...known.values()].flat();
    const now = with_unit(text_of(all), brief && all.length > 1 ? "" : unit);
    if (now !== text) place.textContent = text = now;
    place.classList.toggle("old", !(age < kOld));
    place.title = `${now}, ${age_text(age)}`;
  }));
  return () => ends.forEach((end) => end());
}
