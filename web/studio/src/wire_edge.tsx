// SPDX-License-Identifier: Apache-2.0
import { BaseEdge, type EdgeProps, getBezierPath, getSmoothStepPath } from "@xyflow/react";

const kBack = 24;    ///< from here on a wire leads back
const kAround = 20;
const kBelow = 88;
const kFarApart = 200;

/** Forward a curve; back around the boxes, with corners. */
export function WireEdge({ id, sourceX, sourceY, sourcePosition, targetX, targetY, targetPosition, interactionWidth }: EdgeProps) {
  const ends = { sourceX, sourceY, sourcePosition, targetX, targetY, targetPosition };
  const back = targetX < sourceX - kBack;
  const [path] = back ? getSmoothStepPath({ ...ends, borderRadius: 12, offset: kAround, centerY: between(sourceY, targetY) }) : getBezierPath(ends);
  return <BaseEdge id={id} path={path} interactionWidth={interactionWidth} />;
}

/** Between ends that are far apart; else far enough below both to pass most boxes. */
function between(a: number, b: number): number {
  return Math.abs(a - b) > kFarApart ? (a + b) / 2 : Math.max(a, b) + kBelow;
}
