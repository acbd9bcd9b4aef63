// SPDX-License-Identifier: Apache-2.0
import { useState } from "react";
import { message_of } from "./backend.ts";
import type { Component, Operation } from "./checked.ts";
import { HeldAct } from "./held_act.tsx";
import { inspector } from "./run.ts";

const kFollow = 200;  ///< between two looks at a command [ms]

/** The operations of one component, each to be called. */
export function Operations({ component }: { component: Component }) {
  return (
    <section className="operations" aria-label={`Operations of ${component.name}`}>
      <h3>{component.name}</h3>
      {component.operations.map((one) => <Call key={one.name} component={component.name} operation={one} />)}
      {component.operations.length === 0 && <p className="hint">It has no operations.</p>}
    </section>
  );
}

/** One operation, with what it needs and what it gave. */
export function Call({ component, operation }: { component: string; operation: Operation }) {
  const [words, set_words] = useState<string[]>(() => operation.arguments.map(() => ""));
  const [answer, set_answer] = useState("");
  const [handle, set_handle] = useState(-1);
  const call = async () => {
    set_answer("…");
    try {
      if (operation.command) await command(component, operation.name, words, set_answer, set_handle);
      else set_answer(await result(component, operation.name, words));
    } catch (error) {
      set_answer(message_of(error));
    }
  };
  const label = ({ name, type }: Operation["arguments"][number]) => name || type;
  return (
    <form className="call" onSubmit={(event) => (event.preventDefault(), operation.by_operator ? undefined : void call())} title={`${operation.signature}\n${operation.doc}`}>
      {operation.by_operator ? <HeldAct name={operation.name} act={() => void call()} tell={set_answer} /> : <button type="submit">{operation.name}</button>}
      {operation.arguments.map((one, i) => (
        <input key={i} aria-label={`${operation.name}: ${label(one)}`} placeholder={label(one)} title={one.type} size={Math.max(10, label(one).length)} value={words[i]}
          onChange={(event) => set_words(words.with(i, event.target.value))} />
      ))}
      {handle >= 0 && <button type="button" className="small" onClick={() => void inspector().cancel(handle)}>Cancel</button>}
      <output>{answer}</output>
      <small>{operation.doc}{operation.by_operator && " · needs the operator's seat, and a grant of the deployment"}</small>
    </form>
  );
}

async function result(component: string, operation: string, words: string[]): Promise<string> {
  const { given, value } = await inspector().call(component, operation, words);
  return given ? value : "done";
}

/** Begins a command and shows how it goes until its end. */
async function command(
  component: string, name: string, words: string[], show: (text: string) => void, set_handle: (handle: number) => void,
): Promise<void> {
  let status = await inspector().begin(component, name, words);
  try {
    while (!status.ended) {
      set_handle(status.handle);
      show(status.progress > 0 ? `${status.stage}, ${Math.round(status.progress * 100)} %` : status.stage);
      await new Promise((done) => setTimeout(done, kFollow));
      status = await inspector().follow(status.handle);
    }
    show(status.reason ? `${status.stage}: ${status.reason}` : status.stage);
  } finally {
    set_handle(-1);
  }
}
