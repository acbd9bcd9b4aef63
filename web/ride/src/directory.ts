// SPDX-License-Identifier: Apache-2.0
import { int, string, struct, unsignedInt } from "./types.ts";

/** What a directory says of a component. */
export interface ComponentEntry {
  identifier: number;
  name: string;
  interface: string;
  digest: number;
}
export const ComponentEntry = struct<ComponentEntry>("ComponentEntry", {
  identifier: int,
  name: string,
  interface: string,
  digest: unsignedInt,
});

/** Component 0 of every node. */
export const Directory = {
  identifier: 0,
  find: 0x12e3685b,
  list: 0x265c5890,
  subscribe: 0x5e363bed,
  unsubscribe: 0x61b16eb5,
} as const;
