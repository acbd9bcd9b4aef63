// SPDX-License-Identifier: Apache-2.0
// How a run has ended, in words.

export const has_failed = (state: string, exit_code: number): boolean => state === "ended" && exit_code > 0;

const kSignals = 128;  ///< codes above are of what a signal ended
const kCrashes = new Map([[4, "illegal instruction"], [6, "aborted"], [7, "bus error"], [8, "division by zero"], [11, "segmentation fault"]]);
const kKilled = [9, 15];

/** As docs/command_line.md has the codes. -1: a run that an earlier studio has started; nobody knows how it ended. */
export function end_text(exit_code: number): string {
  if (exit_code <= 0) return "ended";
  const crash = kCrashes.get(exit_code - kSignals);
  if (crash) return `crashed: ${crash}`;
  if (kKilled.includes(exit_code - kSignals)) return "was killed";
  if (exit_code === 1) return "failed";
  if (exit_code === 4) return "ended by a safety reaction";
  return `ended with code ${exit_code}`;
}
