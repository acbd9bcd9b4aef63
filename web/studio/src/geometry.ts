// SPDX-License-Identifier: Apache-2.0
// How large boxes are; studio.css has the same figures.
import type { Box, BoxPort } from "./graph.ts";
import { is_source } from "./scene.ts";

export const kHeader = 44;
export const kRow = 22;
const kFoot = 8;
const kLeast = 152;
const kMost = 360;
const kCharacter = 6.4;

export function size_of(box: Box, ports: boolean): { width: number; height: number } {
  if (!ports) return { width: kLeast, height: kHeader };
  const rows = Math.max(box.inputs.length, box.outputs.length);
  return { width: width_of(box), height: kHeader + (rows > 0 ? rows * kRow + kFoot : 0) };
}

function width_of(box: Box): number {
  const longest = (ports: BoxPort[]) => Math.max(0, ...ports.map((port) => port.name.length));
  const inner = (longest(box.inputs) + longest(box.outputs)) * kCharacter + 52;
  const title = (box.title.length + (box.names.length > 1 ? 4 : 0)) * 7.4 + 84;
  return Math.min(kMost, Math.max(kLeast, Math.ceil(Math.max(inner, title) / 8) * 8));
}

/** Where the middle of a port is in its box. */
export function port_place(box: Box, port: BoxPort, ports: boolean): { x: number; y: number } {
  const { width, height } = size_of(box, ports);
  const source = is_source(port);
  const row = (source ? box.outputs : box.inputs).indexOf(port);
  return { x: source ? width : 0, y: ports ? kHeader + row * kRow + kRow / 2 : height / 2 };
}
