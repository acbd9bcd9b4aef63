// SPDX-License-Identifier: Apache-2.0
// The rover's control program as the acts of a user who assembles it in the studio (docs/rover.md): they are made of the file that is
// shipped, in its order, and so is the text that they are to lead to.
import { cpSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { folder } from "./session.mjs";

const { parse } = createRequire(new URL("../../web/package.json", import.meta.url))("yaml");
const rover = fileURLToPath(new URL("../../robots/rover", import.meta.url));

/** What is typed before anything is on the canvas: the robot's interface, and what stands above its components. */
export const kHeader = "include: elsewhere.yaml\napplication: rover-pilot\nbefore_stop: [Vision.stop]\n";

/** The rover's files, as a user has them beside the new one. */
export const lay_out = () => cpSync(rover, join(folder, "rover"), { recursive: true });

const shipped = (name) => readFileSync(join(rover, "deployments", name), "utf8");

/** Numbers stay as they are written. */
const said_in = (text) => parse(text, { schema: "failsafe" });

/** As a user types it: `[1, -1]`. */
function typed(value) {
  if (Array.isArray(value)) return `[${value.map(typed).join(", ")}]`;
  if (typeof value === "object") return `{${Object.entries(value).map(([key, one]) => `${key}: ${typed(one)}`).join(", ")}}`;
  return value;
}

const fields = (map = {}) => Object.entries(map).map(([label, value]) => [label, typed(value)]);

function component([name, { model, activity, properties, calls = [] }]) {
  const call = (one) => (typeof one === "string" ? { to: one, parameters: [] } : { to: one.call, parameters: fields(one.with) });
  return { name, model, fields: [...fields(activity && { Activity: activity }), ...fields(properties)], calls: calls.map(call) };
}

function connection(one) {
  if (typeof one === "string") {
    const [from, to] = one.split(" -> ");
    return { from, to, parameters: [] };
  }
  const { on: from, do: to, with: given, ...others } = one;
  return { from, to, name: one.name, parameters: fields(given), settings: typed({ with: given, ...others }).slice(1, -1) };
}

const program = said_in(shipped("control_program.yaml"));

export const components = Object.entries(program.components).map(component);

export const connections = [...program.connections, ...said_in(shipped("pilot.yaml")).connections].map(connection);

/** Of those that have a name, and others know them by it: they are opened, so that wires lead from what they tell. */
export const is_opened = ({ name }) => name !== undefined && connections.some(({ from }) => from.startsWith(`${name}.`));

/** The form of a command names units, too: `left [m/s]`. */
export const labelled = (parameter) => new RegExp(`^${parameter}( \\[.*\\])?$`);

/** The lines that say something. */
export const without_comments = (text) => text.split("\n").map((line) => line.replace(/(^|\s+)#.*$/, "")).filter((line) => line !== "");

/** The lines of the two files that are shipped, as the studio has them in one. */
export function expected_lines() {
  const lines = without_comments(shipped("control_program.yaml"));
  const pilot = without_comments(shipped("pilot.yaml"));
  const [last] = lines.splice(lines.indexOf("before_stop: [Vision.stop]"));
  return [...without_comments(kHeader).slice(0, -1), ...lines, ...pilot.slice(pilot.indexOf("connections:") + 1), last];
}
