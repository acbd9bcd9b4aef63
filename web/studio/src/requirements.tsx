// SPDX-License-Identifier: Apache-2.0
// Whom a component knows, and which of them serves what it calls.
import { useState } from "react";
import type { Requirement } from "./checked.ts";
import { Field } from "./field.tsx";
import { items_of, map_of, said_in, unquoted } from "./flow_text.ts";
import type { Box } from "./graph.ts";
import { change, edit, project } from "./project.ts";
import { Refused } from "./refused.tsx";

export function Requirements({ box }: { box: Box }) {
  const requirements = box.components[0]!.requirements ?? [];
  return (
    <>
      <Known box={box} kind={kPeers} />
      <Known box={box} kind={kSuperiors} />
      {requirements.length > 0 && <h3>Calls and hears</h3>}
      {requirements.map((one) => <Binding key={one.name} box={box} requirement={one} />)}
    </>
  );
}

interface Kind {
  title: string;
  key: "peers" | "superiors";
  add: string;
  remove: string;
  noun: string;
  hint: string;
  example: string;
}

const kPeers: Kind = { title: "Peers", key: "peers", add: "peer", remove: "no_peer", noun: "peer", hint: "components that it may use", example: "another peer" };
const kSuperiors: Kind = { title: "Superiors", key: "superiors", add: "superior", remove: "no_superior", noun: "superior", hint: "components that command it, and that it uses nevertheless", example: "another superior" };

/** Components that it knows, as chips, and a field for another one. */
function Known({ box, kind }: { box: Box; kind: Kind }) {
  const texts = project.use((state) => state.texts);
  const names = project.use((state) => state.shown?.components);
  const [wanted, set_wanted] = useState("");
  const written = box.file && box.line ? said_in(texts, { name: box.title, file: box.file, line: box.line }, kind.key) : "";
  const known = items_of(written).flatMap((item) => (item.startsWith("{") ? [...map_of(item).keys()] : [unquoted(item)]));
  const about = { field: `${box.id} ${kind.key}`, file: box.file };
  const add = async () => {
    if (wanted && (await edit([change(kind.add, box.edited, wanted)], about))) set_wanted("");
  };
  return (
    <section className="peers" aria-label={kind.title}>
      <h3>{kind.title} <small>{kind.hint}</small></h3>
      {known.length > 0 && (
        <ul className="chips">
          {known.map((one) => (
            <li key={one}>{one}<button type="button" aria-label={`Remove the ${kind.noun} ${one}`} onClick={() => void edit([change(kind.remove, box.edited, one)], about)}>×</button></li>
          ))}
        </ul>
      )}
      <form className="row" onSubmit={(event) => (event.preventDefault(), void add())}>
        <input aria-label={`New ${kind.noun}`} placeholder={kind.example} list={`new-${kind.key}`} value={wanted} onChange={(event) => set_wanted(event.target.value)} />
        <button type="submit" disabled={!wanted}>Add</button>
      </form>
      <datalist id={`new-${kind.key}`}>{names?.map((one) => <option key={one.name} value={one.name} />)}</datalist>
      <Refused about={about.field} />
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
