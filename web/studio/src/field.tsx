// SPDX-License-Identifier: Apache-2.0
import { type ReactNode, useEffect, useId, useState } from "react";
import { clear_refusal, project } from "./project.ts";

interface FieldProps {
  label: string;
  about: string;      ///< as refusals name it
  value: string;
  unit?: string;
  hint?: string;
  title?: string;
  list?: string[];
  children?: ReactNode;  ///< behind the text
  wide?: boolean;     ///< the text has a line of its own
  /** @return whether it was taken */
  take(text: string): Promise<boolean>;
}

/** A text that is taken with Enter or on leaving; Escape takes it back. A refusal stands below it. */
export function Field({ label, about, value, unit, hint, title, list, children, wide, take }: FieldProps) {
  const id = useId();
  const [text, set_text] = useState(value);
  const [tried, set_tried] = useState<string>();
  const refusal = project.use((state) => (state.refusal?.about === about ? state.refusal : undefined));
  useEffect(() => {
    set_text(value);
    set_tried(undefined);
  }, [value]);
  const commit = async () => {
    if (text === value || text === tried) return;
    set_tried(text);
    await take(text);
  };
  const on_key = (event: React.KeyboardEvent) => {
    if (event.key === "Enter") {
      event.preventDefault();  // or it presses what is asked next
      void commit();
    }
    if (event.key === "Escape" && !event.shiftKey) {
      set_text(value);
      if (refusal) clear_refusal();
    }
  };
  return (
    <div className={`field${refusal ? " refused" : ""}${wide ? " wide" : ""}`}>
      <label htmlFor={id} title={title}>{label}</label>
      <span className="entry">
        <input id={id} value={text} spellCheck={false} autoComplete="off" aria-invalid={refusal ? true : undefined} list={list ? `${id}-list` : undefined}
          aria-describedby={`${id}-about`} onChange={(event) => set_text(event.target.value)} onBlur={() => void commit()} onKeyDown={on_key} />
        {unit && <span className="unit">{unit}</span>}
        {children}
      </span>
      {list && <datalist id={`${id}-list`}>{list.map((one) => <option key={one} value={one} />)}</datalist>}
      <div id={`${id}-about`} className="about">
        {hint && <small>{hint}</small>}
        {refusal?.diagnostics.map((one, i) => <p key={i} className={one.severity} role={one.severity === "error" ? "alert" : undefined}>{one.message}{one.hint && ` (${one.hint})`}</p>)}
      </div>
    </div>
  );
}
