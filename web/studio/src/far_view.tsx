// SPDX-License-Identifier: Apache-2.0
// What is selected of an application that runs elsewhere, to be read.
import { Live, Parts } from "./box_view.tsx";
import { activity_text, type Component, type Property } from "./checked.ts";
import { useElsewhere, why_fixed } from "./elsewhere.ts";
import type { Box, Wire } from "./graph.ts";
import { project } from "./project.ts";
import { facts } from "./wire_view.tsx";

export function FarBox({ box }: { box: Box }) {
  const model = project.use((state) => state.models.find((one) => one.name === box.model));
  const address = useElsewhere();
  const component = box.components[0]!;
  return (
    <>
      <h2>{box.title}</h2>
      <p className="lead"><b>{box.model}</b>{model?.doc && ` ${model.doc}`}</p>
      <Live box={box} />
      {box.composite ? <Parts box={box} /> : <About component={component} />}
      <p className="hint">{why_fixed(address)}</p>
    </>
  );
}

function About({ component }: { component: Component }) {
  const { activity, thread, properties } = component;
  const listed = properties.filter((one) => one.persistent);
  return (
    <>
      <p>{`${activity_text(activity)}${thread ? `, in the thread ${thread}` : ""}`}</p>
      {listed.length > 0 && <h3>Properties <small>as they were read; Read anew, above, asks again</small></h3>}
      <dl>{listed.map((one) => <Row key={one.name} property={one} />)}</dl>
      <Calls component={component} />
    </>
  );
}

function Row({ property: { name, doc, value, unit } }: { property: Property }) {
  return <><dt title={doc}>{name}</dt><dd>{`${value || "–"} ${unit}`.trim()}</dd></>;
}

/** What it calls and hears, and where that leads. */
function Calls({ component }: { component: Component }) {
  const connections = project.use((state) => state.shown?.connections);
  if (component.requirements.length === 0) return null;
  const other_end = (name: string) => {
    const own = `${component.name}.${name}`;
    const found = connections?.find((one) => one.kind !== "data" && (one.from === own || one.to === own));
    return found ? (found.from === own ? found.to : found.from) : "not connected";
  };
  return (
    <>
      <h3>Calls and hears</h3>
      <dl>{component.requirements.map(({ name, doc }) => <Pair key={name} name={name} doc={doc} value={other_end(name)} />)}</dl>
    </>
  );
}

function Pair({ name, doc, value }: { name: string; doc: string; value: string }) {
  return <><dt title={doc}>{name}</dt><dd>{value}</dd></>;
}

export function FarWire({ wire }: { wire: Wire }) {
  const [from, to] = wire.written;
  const address = useElsewhere();
  return (
    <>
      <p className="lead">{wire.kind === "data" ? "Connection" : "An event that commands"}</p>
      <h2 className="ends"><span>{from}</span> <span aria-label="to">→</span> <span>{to}</span></h2>
      <ul className="list">{facts(wire).map((fact) => <li key={fact}>{fact}</li>)}</ul>
      <p className="hint">{why_fixed(address)}</p>
    </>
  );
}
