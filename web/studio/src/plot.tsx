// SPDX-License-Identifier: Apache-2.0
// The last 60 s of chosen items. It comes with uPlot, so it is loaded when it is opened.
import { useEffect, useRef, useState } from "react";
import uPlot from "uplot";
import { project } from "./project.ts";
import { run } from "./run.ts";
import { type Plotted, selection, toggle_plotted } from "./selection.ts";
import { watch, with_unit } from "./values.ts";

const kWindow = 60;       ///< [s]
const kMostSamples = 60 * 60;
const kColours = 6;
const kDashes = [undefined, [8, 4], [2, 3]];  ///< of as many curves as there are colours
const kMostCurves = kColours * kDashes.length;
const kRedraw = 50;       ///< [ms]

/** Curves in one time; each has a value at each time, or null. */
class Curves {
  readonly times: number[] = [];
  readonly values = new Map<string, (number | null)[]>();
  private latest = new Map<string, number>();

  take(curve: string, value: number): void {
    this.latest.set(curve, value);
  }

  /** Puts what was taken last at a time. */
  sample(time: number): void {
    if (this.times.length > 0 && time < this.times[this.times.length - 1]!) this.clear();
    const known = this.times.length;
    this.times.push(time);
    for (const [curve, value] of this.latest) {
      const all = this.values.get(curve) ?? Array<null>(known).fill(null);
      while (all.length < known) all.push(null);
      all.push(Number.isFinite(value) ? value : null);
      this.values.set(curve, all);
    }
    while (this.times.length > kMostSamples || (this.times[0] ?? time) < time - kWindow) this.drop_first();
  }

  private drop_first(): void {
    this.times.shift();
    for (const all of this.values.values()) all.shift();
  }

  clear(): void {
    this.times.length = 0;
    this.values.clear();
  }
}

export default function Plot() {
  const plotted = selection.use((state) => state.plotted);
  const [curves, set_curves] = useState<string[]>([]);
  const items = plotted.flatMap((one) => one.items);
  const drawn = curves.slice(0, kMostCurves);
  return (
    <div className="plot">
      {plotted.length === 0
        ? <p className="hint">Choose what is drawn: Plot in the inspector of a port, or the key P on a port in the outline.</p>
        : <Diagram items={items.slice(0, kMostCurves)} tell={set_curves} />}
      <div className="legend scroll">
        {plotted.map((one) => (
          <div key={one.name}>
            <span className="chips"><span>{one.name}{unit_of(one.items[0]!) && <small>{unit_of(one.items[0]!)}</small>}<button type="button" aria-label={`Plot ${one.name} no more`} onClick={() => toggle_plotted(one.name)}>×</button></span></span>
            <ul aria-label={`Curves of ${one.name}`}>
              {drawn.map((curve, i) => one.items.includes(item_of(curve)) && <li key={curve} data-lane={i % kColours} data-dash={Math.floor(i / kColours)}>{short_name(curve, one)}</li>)}
            </ul>
          </div>
        ))}
        {left_out(items, curves) > 0 && <p className="hint">{`${left_out(items, curves)} more are not drawn: ${kMostCurves} are the most.`}</p>}
      </div>
    </div>
  );
}

/** Of elements of a vector, the vector. */
const item_of = (curve: string): string => curve.replace(/\[\d+\]$/, "");

/** What tells a curve from the others of its port: `Joint3`, `[2]`. */
function short_name(curve: string, { items }: Plotted): string {
  const item = item_of(curve);
  const component = items.length > 1 ? item.slice(0, item.lastIndexOf(".")) : "";
  const is_alone = new Set(items.map((one) => one.slice(one.lastIndexOf(".")))).size === 1;
  return `${is_alone ? component : item}${curve.slice(item.length)}` || item.slice(item.lastIndexOf(".") + 1);
}

/** Of a port's values; empty: they are plain numbers. */
function unit_of(item: string): string {
  const dot = item.lastIndexOf(".");
  const component = project.get().shown?.components.find(({ name }) => name === item.slice(0, dot));
  return [...(component?.outputs ?? []), ...(component?.inputs ?? [])].find(({ name }) => name === item.slice(dot + 1))?.unit ?? "";
}

/** The unit of all of them; empty: they differ, or have none. */
function common_unit(items: string[]): string {
  const units = new Set(items.map(unit_of));
  return units.size === 1 ? [...units][0]! : "";
}

const left_out = (items: string[], curves: string[]): number => Math.max(items.length, curves.length) - Math.min(kMostCurves, Math.max(items.length, curves.length));

function Diagram({ items, tell }: { items: string[]; tell(curves: string[]): void }) {
  const place = useRef<HTMLDivElement>(null);
  const key = items.join("\n");
  useEffect(() => draw(key.split("\n"), place.current!, tell), [key]);
  return <div className="diagram" ref={place} role="img" aria-label={`Curves of ${items.join(", ")}, the last 60 s`} />;
}

/** @param tell  told which curves there are, whenever that changes */
function draw(items: string[], place: HTMLElement, tell: (curves: string[]) => void): () => void {
  const curves = new Curves();
  const ends = items.map((item) => watch(item, (numbers) => {
    numbers.forEach((value, i) => curves.take(numbers.length > 1 ? `${item}[${i + 1}]` : item, value));
  }));
  const unit = common_unit(items);
  let chart: uPlot | undefined;
  let told = 0;
  const redraw = () => {
    const now = time_now();
    if (now === undefined) return;
    curves.sample(now);
    const names = names_of(curves, items);
    if (names.length !== told) tell(names);
    told = names.length;
    chart = shown(curves, chart, names.slice(0, kMostCurves), unit, place);
  };
  const timer = setInterval(redraw, kRedraw);
  const sized = new ResizeObserver(() => chart?.setSize(size_of(place)));
  sized.observe(place);
  return () => {
    ends.forEach((end) => end());
    clearInterval(timer);
    sized.disconnect();
    chart?.destroy();
  };
}

/** In the order of their items. */
function names_of(curves: Curves, items: string[]): string[] {
  const known = [...curves.values.keys()];
  return items.flatMap((item) => known.filter((name) => item_of(name) === item));
}

/** The application's time, which is asked for a few times a second, carried on between. */
let seen = { time: -1, at: 0 };

function time_now(): number | undefined {
  const { application, now } = run.get();
  if (!application) return undefined;
  const here = performance.now() / 1000;
  if (seen.time !== application.time) seen = { time: application.time, at: here };
  const rate = now ? (now.paused ? 0 : Math.min(now.rate, 10)) : 1;
  return seen.time + (here - seen.at) * rate;
}

const size_of = (place: HTMLElement) => ({ width: place.clientWidth, height: Math.max(80, place.clientHeight) });

function shown(curves: Curves, chart: uPlot | undefined, names: string[], unit: string, place: HTMLElement): uPlot | undefined {
  if (names.length === 0) return chart;
  const data: uPlot.AlignedData = [curves.times, ...names.map((name) => curves.values.get(name)!)];
  if (chart && chart.series.length === names.length + 1) {
    chart.setData(data);
    return chart;
  }
  chart?.destroy();
  return new uPlot(options_of(names, unit, place), data, place);
}

/** Constant values stand in the middle. */
function with_room(_: uPlot, low: number | null, high: number | null): [number, number] {
  const [least, most] = [low ?? 0, high ?? 0];
  const room = most > least ? (most - least) * 0.08 : Math.abs(most) * 0.1 || 1;
  return [least - room, most + room];
}

function options_of(names: string[], unit: string, place: HTMLElement): uPlot.Options {
  const style = getComputedStyle(place);
  const axis: uPlot.Axis = { stroke: style.getPropertyValue("--soft"), grid: { stroke: style.getPropertyValue("--grid"), width: 1 }, ticks: { show: false } };
  return {
    ...size_of(place), scales: { x: { time: false }, y: { range: with_room } }, axes: [{ ...axis, size: 30, values: (_, all) => all.map((one) => `${one} s`) }, { ...axis, size: unit ? 90 : 60, values: (_, all) => all.map((one) => with_unit(String(one), unit)) }],
    legend: { show: false }, cursor: { points: { show: false } },
    series: [{ label: "time" }, ...names.map((label, i) => ({ label, stroke: style.getPropertyValue(`--lane-${i % kColours}`), dash: kDashes[Math.floor(i / kColours)], width: 1.5, points: { show: false } }))],
  };
}
