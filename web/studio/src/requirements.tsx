// SPDX-License-Identifier: Apache-2.0
// Whom a component knows, and which of them serves what it calls.
import { useState } from "react";
import type { Requirement } from "./checked.ts";
import { Field } from "./field.tsx";
import type { Box } from "./graph.ts";
import { change, edit, project } from "./project.ts";
import { peers_of } from "./written.ts";

export function Requirements({ box }: { box: Box }) {
  const requirements = box.components[0]!.requirements ?? [];
  return (
    <>
      <Peers box={box} />
      {requirements.length > 0 && <h3>Calls and hears</h3>}
      {requirements.map((one) => <Binding key={one.name} box={box} requirement={one} />)}
    </>
  );
}

function Peers({ box }: { box: Box }) {
  const texts = project.use((state) => state.texts);
  const names = project.use((state) => state.shown?.components);
  const [wanted, set_wanted] = useState("");
  const peers = box.file && box.line ? peers_of(texts, { name: box.title, file: box.file, line: box.line }) : [];
  const about = { field: `${box.id} peers`, file: box.file };
  const add = async () => {
    if (wanted && (await edit([change("peer", box.edited, wanted)], about))) set_wanted("");
  };
  const refusal = project.use((state) => (state.refusal?.about === about.field ? state.refusal : undefined));
  return (
    <section className="peers" aria-label="Peers">
      <h3>Peers</h3>
      <ul className="chips">
        {peers.map((peer) => (
          <li key={peer}>{peer}<button type="button" aria-label={`Remove the peer ${peer}`} onClick={() => void edit([change("no_peer", box.edited, peer)], about)}>×</button></li>
        ))}
      </ul>
      <form className="row" onSubmit={(event) => (event.preventDefault(), void add())}>
        <input aria-label="New peer" placeholder="a component it may use" list="components" value={wanted} onChange={(event) => set_wanted(event.target.value)} />
        <button type="submit" disabled={!wanted}>Add</button>
      </form>
      <datalist id="components">{names?.map((one) => <option key={one.name} value={one.name} />)}</datalist>
      {refusal?.diagnostics.map((one, i) => <p key={i} className={one.severity} role="alert">{one.message}</p>)}
    </section>
  );
}

function Binding({ box, requirement }: { box: Box; requirement: Requirement }) {
  const connections = project.use((state) => state.shown?.connections);
  const own = `${box.names[0]}.${requirement.name}`;
  const served = connections?.find((one) => one.kind !== "data" && (one.from === own || one.to === own));
  const target = served ? (served.from === own ? served.to : served.from) : "";
  const about = `${own} binding`;
  const bind = (text: string) =>
    edit([text ? change("bind", box.edited, requirement.name, text) : change("unbind", box.edited, requirement.name)], { field: about, file: box.file });
  return (
    <Field wide label={requirement.name} about={about} value={target} take={bind} title={requirement.signature}
      list={offers(requirement)} hint={[requirement.doc, requirement.optional ? "may stay open" : ""].filter(Boolean).join(" · ")} />
  );
}

/** Operations or events of other components with the same signature. */
function offers({ kind, signature }: Requirement): string[] {
  const components = project.get().shown?.components ?? [];
  const of_kind = (one: (typeof components)[number]) =>
    kind === "event" ? (one.events ?? []) : (one.operations ?? []).filter(({ command }) => command === (kind === "command"));
  return components.flatMap((one) => of_kind(one).filter((member) => member.signature === signature).map((member) => `${one.name}.${member.name}`));
}
