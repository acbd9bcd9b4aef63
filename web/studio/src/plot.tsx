// SPDX-License-Identifier: Apache-2.0
// The last 60 s of chosen items. It comes with uPlot, so it is loaded when it is opened.
import { useEffect, useRef } from "react";
import uPlot from "uplot";
import { run } from "./run.ts";
import { selection, toggle_plotted } from "./selection.ts";
import { watch } from "./values.ts";

const kWindow = 60;       ///< [s]
const kMostSamples = 60 * 60;
const kMostCurves = 6;
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
  return (
    <div className="plot">
      {plotted.length === 0
        ? <p className="hint">Choose what is drawn: Plot in the inspector of a port, or the key P on a port in the outline.</p>
        : <Diagram items={plotted} />}
      <ul className="chips">
        {plotted.map((item, i) => <li key={item} data-lane={i % kMostCurves}>{item}<button type="button" aria-label={`Plot ${item} no more`} onClick={() => toggle_plotted(item)}>×</button></li>)}
      </ul>
    </div>
  );
}

function Diagram({ items }: { items: string[] }) {
  const place = useRef<HTMLDivElement>(null);
  const key = items.join("\n");
  useEffect(() => draw(key.split("\n"), place.current!), [key]);
  return <div className="diagram" ref={place} role="img" aria-label={`Curves of ${items.join(", ")}, the last 60 s`} />;
}

function draw(items: string[], place: HTMLElement): () => void {
  const curves = new Curves();
  const ends = items.map((item) => watch(item, (numbers) => {
    numbers.slice(0, kMostCurves).forEach((value, i) => curves.take(numbers.length > 1 ? `${item}[${i + 1}]` : item, value));
  }));
  let chart: uPlot | undefined;
  const redraw = () => {
    const now = time_now();
    if (now === undefined) return;
    curves.sample(now);
    chart = shown(curves, chart, items, place);
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

const size_of = (place: HTMLElement) => ({ width: place.clientWidth, height: Math.max(80, place.clientHeight - (place.querySelector(".u-legend")?.clientHeight ?? 0)) });

function shown(curves: Curves, chart: uPlot | undefined, items: string[], place: HTMLElement): uPlot | undefined {
  const known = [...curves.values.keys()];
  const names = items.flatMap((item) => known.filter((name) => name.replace(/\[\d+\]$/, "") === item));
  if (names.length === 0) return chart;
  const data: uPlot.AlignedData = [curves.times, ...names.map((name) => curves.values.get(name)!)];
  if (chart && chart.series.length === names.length + 1) {
    chart.setData(data);
    return chart;
  }
  chart?.destroy();
  return new uPlot(options_of(names, names.length > items.length, place), data, place);
}

/** Constant values stand in the middle. */
function with_room(_: uPlot, low: number | null, high: number | null): [number, number] {
  const [least, most] = [low ?? 0, high ?? 0];
  const room = most > least ? (most - least) * 0.08 : Math.abs(most) * 0.1 || 1;
  return [least - room, most + room];
}

/** @param legend  of vectors, whose elements are told by it */
function options_of(names: string[], legend: boolean, place: HTMLElement): uPlot.Options {
  const style = getComputedStyle(place);
  const axis: uPlot.Axis = { stroke: style.getPropertyValue("--soft"), grid: { stroke: style.getPropertyValue("--grid"), width: 1 }, ticks: { show: false } };
  return {
    ...size_of(place), scales: { x: { time: false }, y: { range: with_room } }, axes: [{ ...axis, values: (_, all) => all.map((one) => `${one} s`) }, { ...axis, size: 60 }],
    legend: { show: legend, live: false }, cursor: { points: { show: false } },
    series: [{ label: "time" }, ...names.map((label, i) => ({ label, stroke: style.getPropertyValue(`--lane-${i % kMostCurves}`), width: 1.5, points: { show: false } }))],
  };
}
