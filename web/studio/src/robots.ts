// SPDX-License-Identifier: Apache-2.0
// The robots that a deployment describes, and the ports whose values move their joints.
import type { Component, Port } from "./checked.ts";

/** A robot by its description (URDF), and the components that name it. */
export interface Robot {
  owner: string;   ///< the first of the components; FILE.studio.json knows the robot by it
  path: string;    ///< of the description, as the component has it
  base: string;    ///< the link that stands still; empty: the root
  tip: string;     ///< the end of the chain of joints; empty: all joints
}

const kProperty = "robot_description";

const value_of = (component: Component, name: string): string => component.properties.find((one) => one.name === name)?.value ?? "";

/** `a/b/../c` as `a/c`: components name one file in several ways. */
function normal(path: string): string {
  const shorter = path.replace(/(^|\/)(?!\.\.\/)[^/]+\/\.\.\//, "$1");
  return shorter === path ? path : normal(shorter);
}

export function robots_of(components: readonly Component[]): Robot[] {
  const found = new Map<string, Robot>();
  for (const one of components) {
    const path = value_of(one, kProperty);
    if (!path || found.has(normal(path))) continue;
    found.set(normal(path), { owner: one.name, path, base: value_of(one, "base_link"), tip: value_of(one, "tip_link") });
  }
  return [...found.values()];
}

/** Where the positions of a robot's joints may come from. */
export interface Source {
  port: string;      ///< `Sensor.Positions`, `Joint{1..7}.Position`
  items: string[];   ///< of the run: one that has the numbers of all joints first, or one for each joint
  score: number;     ///< how much it looks like measured positions
}

const kWanted = /desired|wanted|reference|target|goal|command|limit|Ref\d*\b/i;
const kMeasured = /measured|sensor|encoder|actual/i;
const kPosition = /position|angle|\[q1/i;
const kEnough = 5;

/** How much a port looks like measured positions of joints, by its name, doc and unit. */
function likeness(port: Port): number {
  const text = `${port.name} ${port.doc}`;
  const unit = port.unit === "rad" || port.unit === "m" ? 1 : 0;
  return (kPosition.test(text) ? 2 : 0) + (kMeasured.test(text) ? 2 : 0) + unit - (kWanted.test(text) ? 10 : 0);
}

const is_vector = (port: Port): boolean => /^(vector|array)<(double|float)/.test(port.type);
const is_number = (port: Port): boolean => port.type === "double" || port.type === "float";
const may_be_positions = (port: Port): boolean => ["rad", "m", ""].includes(port.unit);

/** The composite that a component is in, `Arm.` of `Arm.Sensor`. */
const composite_of = (component: string): string => component.slice(0, component.lastIndexOf(".") + 1);

/** All ports that could have the positions of so many joints, the likeliest first. */
export function sources_of(components: readonly Component[], owner: string, joints: number): Source[] {
  const sources = [...vectors(components, joints), ...series(components, joints)];
  const near = (source: Source) => (source.items[0]!.startsWith(composite_of(owner)) ? 0.25 : 0);
  return sources.map((one) => ({ ...one, score: one.score + near(one) })).sort((a, b) => b.score - a.score || a.port.localeCompare(b.port));
}

function vectors(components: readonly Component[], joints: number): Source[] {
  return components.flatMap((component) => component.outputs
    .filter((port) => is_vector(port) && may_be_positions(port) && (port.size ?? joints) >= joints)
    .map((port) => {
      const path = `${component.name}.${port.name}`;
      return { port: path, items: [path], score: likeness(port) + (port.size === joints ? 2 : 0.5) };
    }));
}

/** Ports with one number each that are counted by their names or those of their components: as many as joints. */
function series(components: readonly Component[], joints: number): Source[] {
  const groups = new Map<string, { first: number; items: [number, string][]; score: number }>();
  for (const component of components) {
    for (const port of component.outputs.filter((one) => is_number(one) && may_be_positions(one))) {
      const counted = counted_by(component.name, port.name);
      if (!counted) continue;
      const group = groups.get(counted.pattern) ?? { first: counted.number, items: [], score: likeness(port) + counted.score };
      group.items.push([counted.number, `${component.name}.${port.name}`]);
      groups.set(counted.pattern, group);
    }
  }
  return [...groups].filter(([, { items }]) => items.length === joints).map(([pattern, { items, score }]) => {
    const sorted = items.sort(([a], [b]) => a - b);
    return { port: pattern.replace("{}", `{${sorted[0]![0]}..${sorted.at(-1)![0]}}`), items: sorted.map(([, item]) => item), score };
  });
}

function counted_by(component: string, port: string): { pattern: string; number: number; score: number } | undefined {
  const of_component = /^(.*?)(\d+)$/.exec(component);
  if (of_component) return { pattern: `${of_component[1]}{}.${port}`, number: Number(of_component[2]), score: 1.5 };
  const of_port = /^(.*?)(\d+)$/.exec(port);
  return of_port ? { pattern: `${component}.${of_port[1]}{}`, number: Number(of_port[2]), score: 1 } : undefined;
}

/** What moves a robot, or why nothing does. */
export interface Binding {
  source?: Source;
  chosen: boolean;   ///< by the user, and not found
  trouble: string;   ///< empty if there is a source
}

/** @param chosen  the port that the user chose; undefined: none */
export function binding_of(sources: Source[], chosen: string | undefined): Binding {
  if (chosen) {
    const source = sources.find((one) => one.port === chosen);
    return { source, chosen: true, trouble: source ? "" : `'${chosen}', which was chosen, is there no more, or has too few numbers: choose another port` };
  }
  const [best, next] = sources;
  if (!best || best.score < kEnough) return { chosen: false, trouble: "no port looks like the measured positions of its joints: choose one" };
  if (next && next.score === best.score) return { chosen: false, trouble: `'${best.port}' and '${next.port}' look alike: choose the one that has its joints' positions` };
  return { source: best, chosen: false, trouble: "" };
}

/** What joints are like, by the description's own words. */
export interface JointShape {
  name: string;
  type: string;     ///< `revolute`, `continuous`, `prismatic`, ...
  parent: string;   ///< link
  child: string;    ///< link
}

const kMoving = ["revolute", "continuous", "prismatic"];

export const unit_of = (type: string): string => (type === "prismatic" ? "m" : "rad");

/** The joints that move, from the base to the tip; without a tip all there are, in the order of the description. */
export function moving_joints<Joint extends JointShape>(joints: readonly Joint[], base: string, tip: string): Joint[] {
  const children = new Set(joints.map((one) => one.child));
  const root = base || (joints.find((one) => !children.has(one.parent))?.parent ?? "");
  const chain = tip ? chain_to(joints, root, tip) : behind(joints, root);
  return chain.filter((one) => kMoving.includes(one.type));
}

/** @param known  links on the way, to which a wrong description may lead back */
function behind<Joint extends JointShape>(joints: readonly Joint[], link: string, known: string[] = []): Joint[] {
  if (known.includes(link)) return [];
  return joints.filter((one) => one.parent === link).flatMap((one) => [one, ...behind(joints, one.child, [...known, link])]);
}

function chain_to<Joint extends JointShape>(joints: readonly Joint[], root: string, tip: string): Joint[] {
  const chain: Joint[] = [];
  for (let link = tip; link !== root;) {
    const last = joints.find((one) => one.child === link);
    if (!last || chain.includes(last)) break;
    chain.unshift(last);
    link = last.parent;
  }
  return chain;
}
