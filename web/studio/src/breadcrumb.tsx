// SPDX-License-Identifier: Apache-2.0
import { open_composite, selection } from "./selection.ts";
import { project } from "./project.ts";

/** Which composite is open, and the way back. */
export function Breadcrumb() {
  const path = selection.use((state) => state.path);
  const application = project.use((state) => state.shown?.application);
  if (path.length === 0) return null;
  return (
    <nav className="breadcrumb" aria-label="Open composite">
      <button type="button" onClick={() => open_composite([])}>{application || "Application"}</button>
      {path.map((step, i) => (
        <span key={step}>
          {" › "}
          {i + 1 < path.length
            ? <button type="button" onClick={() => open_composite(path.slice(0, i + 1))}>{step}</button>
            : <strong aria-current="page">{step}</strong>}
        </span>
      ))}
    </nav>
  );
}
