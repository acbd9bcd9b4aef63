// SPDX-License-Identifier: Apache-2.0
// What generated services use, and what hosts them. Pages that only ask need nothing of it.
export * from "@armature/ride";
export { Host, type HostOptions, type Question } from "./host.ts";
export { policy } from "./policy.ts";
export { type Access, type Call, Parameters, Service } from "./served.ts";
