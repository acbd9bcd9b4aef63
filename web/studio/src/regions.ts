// SPDX-License-Identifier: Apache-2.0
// The parts of the page, for the keyboard: a canvas has a stop of Tab for each box and wire, and nobody has to pass all of them.

/** In the order of the page. */
const kRegions = [".top-bar", ".palette", ".outline", "main", ".beside", ".inspector", ".panel"];
const kFocusable = "input:not(:disabled), select:not(:disabled), button:not(:disabled), [tabindex='0']";

/** Moves the focus to the next part of the page, or with -1 to the one before. */
export function go_to_region(by: 1 | -1): void {
  const firsts = kRegions.flatMap((selector): { region: Element; first: HTMLElement }[] => {
    const region = document.querySelector(selector);
    const first = region?.querySelector<HTMLElement>(kFocusable);
    return region && first ? [{ region, first }] : [];
  });
  if (firsts.length === 0) return;
  const here = firsts.findIndex(({ region }) => region.contains(document.activeElement));
  const next = here < 0 ? 0 : (here + by + firsts.length) % firsts.length;
  firsts[next]!.first.focus();
}
