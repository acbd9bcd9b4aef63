// SPDX-License-Identifier: Apache-2.0
import { project } from "./project.ts";

/** Why the last edit there was refused, or what it tells. */
export function Refused({ about }: { about: string }) {
  const refusal = project.use((state) => (state.refusal?.about === about ? state.refusal : undefined));
  return refusal?.diagnostics.map((one, i) => (
    <p key={i} className={one.severity} role={one.severity === "error" ? "alert" : "status"}>{one.message}{one.hint && ` (${one.hint})`}</p>
  ));
}
