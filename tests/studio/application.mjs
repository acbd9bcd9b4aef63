// SPDX-License-Identifier: Apache-2.0
import { execFileSync } from "node:child_process";
import { program } from "./session.mjs";

/** The application of a deployment as the check has it, without the places where a file says it. */
export function application(file) {
  const { ok, components, connections, threads } = JSON.parse(execFileSync(program, ["check", "--json", file], { encoding: "utf8" }));
  const sorted = (lines) => lines.map((line) => JSON.stringify(line)).sort();
  return {
    ok,
    components: sorted(components.map(({ name, model, activity, thread, properties }) => [name, model, activity, thread, properties.map((one) => [one.name, one.value])])),
    connections: sorted(connections.map(({ kind, from, to, triggers, delayed, crosses_threads }) => [kind, from, to, triggers, delayed, crosses_threads])),
    threads: sorted(threads.map(({ name, activity, order }) => [name, activity, [...order].sort()])),
  };
}
