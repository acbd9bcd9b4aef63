// SPDX-License-Identifier: Apache-2.0
import { type Diagnostic, has_nothing_yet } from "./checked.ts";
import { apply_fix, clear_refusal, project } from "./project.ts";
import { scene } from "./scene.ts";
import { select_box, selection, show_text } from "./selection.ts";

/** What the check found, and why the last edit on the canvas was refused. */
export function Problems() {
  const checked = project.use((state) => state.checked);
  const refusal = project.use((state) => state.refusal);
  const behind = project.use((state) => state.state.checked < state.state.version);
  const empty = checked !== undefined && has_nothing_yet(checked);
  const found = empty ? [] : checked?.diagnostics ?? [];
  return (
    <div className="problems scroll" tabIndex={0} aria-label="Problems">
      {refusal && refusal.diagnostics.map((one, i) => (
        <div key={i} className={`problem ${one.severity}`}>
          <b>{one.severity === "error" ? "The edit was refused" : one.severity}</b>
          <span className="message">{one.message}{one.hint && <small>{one.hint}</small>}</span>
          <button type="button" className="small" onClick={clear_refusal}>Dismiss</button>
        </div>
      ))}
      {found.map((one, i) => <Problem key={i} problem={one} />)}
      {found.length === 0 && <p className="hint">{empty ? "Nothing to check yet: mistakes are told here as soon as there are components." : checked ? "No problems: the application can run." : "Being checked …"}</p>}
      {behind && checked && <p className="hint" role="status">Being checked …</p>}
    </div>
  );
}

function Problem({ problem }: { problem: Diagnostic }) {
  const { severity, message, hint, file, line, column, fix } = problem;
  return (
    <div className={`problem ${severity}`}>
      <b>{severity}</b>
      <span className="message">
        <button type="button" className="link" onClick={() => go_to(problem)}>{message}{others_text(problem)}</button>
        {hint && <small>{hint}</small>}
      </span>
      {fix && <button type="button" className="small" onClick={() => void apply_fix(fix)}>{`Write ${fix.by}`}</button>}
      {file && <button type="button" className="link place" onClick={() => show_text(file, line, column)}>{`${file.split("/").pop()}${line ? `:${line}` : ""}`}</button>}
    </div>
  );
}

/** For whom else it stands. */
function others_text({ likewise }: Diagnostic): string {
  if (!likewise) return "";
  if (likewise.count === 1) return `, likewise ${likewise.first}`;
  return `, likewise ${likewise.count} others, ${likewise.first} to ${likewise.last}`;
}

/** To the box that stands at the place, to the wire, or to the text. */
function go_to({ message, file, line, column }: Diagnostic): void {
  const { boxes, wires } = scene();
  const box = boxes.find((one) => one.file === file && one.line === line) ?? boxes.find((one) => message.includes(`'${one.title}'`));
  const wire = wires.find((one) => one.file === file && one.line === line);
  if (box) select_box(box.id, true);
  else if (wire) selection.set({ boxes: [], wires: [wire.id], port: undefined });
  if (file && !box && !wire) show_text(file, line, column);
}
