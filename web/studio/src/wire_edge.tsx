// SPDX-License-Identifier: Apache-2.0
import { BaseEdge, type EdgeProps, getBezierPath, getSmoothStepPath } from "@xyflow/react";

const kBack = 24;    ///< from here on a wire leads back
const kAround = 20;

/** Forward a curve; back around the boxes, with corners. */
export function WireEdge({ id, sourceX, sourceY, sourcePosition, targetX, targetY, targetPosition, interactionWidth }: EdgeProps) {
  const ends = { sourceX, sourceY, sourcePosition, targetX, targetY, targetPosition };
  const back = targetX < sourceX - kBack;
  const [path] = back ? getSmoothStepPath({ ...ends, borderRadius: 12, offset: kAround, centerY: below(sourceY, targetY) }) : getBezierPath(ends);
  return <BaseEdge id={id} path={path} interactionWidth={interactionWidth} />;
}

/** Far enough below both ends to pass most boxes. */
const below = (a: number, b: number): number => Math.max(a, b) + 88;
