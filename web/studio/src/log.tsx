// SPDX-License-Identifier: Apache-2.0
import { useEffect, useMemo, useRef, useState } from "react";
import { run } from "./run.ts";

const kMostShown = 1000;

/** What the run says; it follows the end unless somebody reads further up. */
export function Log() {
  const log = run.use((all) => all.log);
  const begin = run.use((all) => all.logBegin);
  const number = run.use((all) => all.state.number);
  const [filter, set_filter] = useState("");
  const place = useRef<HTMLDivElement>(null);
  const [follows, set_follows] = useState(true);
  const shown = useMemo(() => matching(log, begin, filter), [log, begin, filter]);
  useEffect(() => {
    if (follows) place.current?.scrollTo(0, place.current.scrollHeight);
  }, [shown, follows]);
  const on_scroll = ({ currentTarget: { scrollTop, clientHeight, scrollHeight } }: React.UIEvent) => set_follows(scrollHeight - scrollTop - clientHeight < 24);
  return (
    <div className="log">
      <div className="row">
        <input type="search" aria-label="Filter the log" placeholder="Filter" value={filter} onChange={(event) => set_filter(event.target.value)} />
        {!follows && <button type="button" className="small" onClick={() => set_follows(true)}>Follow</button>}
        {shown.length === kMostShown && <small>{`the last ${kMostShown} lines`}</small>}
      </div>
      <div className="lines scroll" ref={place} tabIndex={0} role="log" aria-label="Log of the run" onScroll={on_scroll}>
        {shown.map(([line, text]) => <div key={line} className={severity_of(text)}>{text}</div>)}
        {shown.length === 0 && <p className="hint">{number === 0 ? "Run the application: what it says stands here." : "No lines."}</p>}
      </div>
    </div>
  );
}

function matching(log: readonly string[], begin: number, filter: string): [number, string][] {
  const word = filter.toLowerCase();
  const numbered = log.map((text, i): [number, string] => [begin + i, text]);
  return numbered.filter(([, text]) => text.toLowerCase().includes(word)).slice(-kMostShown);
}

/** Of a line of the application, its level; of others, what they say. */
function severity_of(text: string): string {
  const level = /^\s*\d+\.\d+ (\w+)/.exec(text)?.[1];
  if (level) return /error|fatal/.test(level) ? "error" : level === "warning" ? "warning" : "";
  if (/\b(error|fatal|fault)\b/i.test(text)) return "error";
  return /\bwarning\b/i.test(text) ? "warning" : "";
}
