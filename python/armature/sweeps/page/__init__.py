# SPDX-License-Identifier: Apache-2.0
"""The page of a sweep: one HTML file that loads nothing, with its runs as data within it.

It shows the best runs, a heat map of any two parameters, parallel coordinates of all of them, and
why runs have no result. Each run leads to its folder, and to the report in it.
"""
from __future__ import annotations

import json
import math
import os
import re
from html import escape
from importlib import resources
from pathlib import Path
from typing import Any

from ..results import Results, text_of
from ..run import Run, is_number


def write_page(results: Results, path: Path) -> None:
    """Writes it in one step: whoever looks meanwhile sees the old one."""
    partial = path.with_suffix(path.suffix + ".partial")
    partial.write_text(page_text(results, path.parent), encoding="utf-8")
    os.replace(partial, path)


def page_text(results: Results, folder: Path) -> str:
    """@param folder  of the page: links to runs begin there"""
    here = resources.files(__package__)
    text = here.joinpath("sweep.html").read_text(encoding="utf-8")
    data = json.dumps(page_data(results, folder), allow_nan=False, separators=(",", ":"))
    parts = {
        "title": escape(title_of(results)),
        "style": here.joinpath("sweep.css").read_text(encoding="utf-8"),
        "data": data.replace("<", "\\u003c"),  # no text of a run ends the element
        "elements": here.joinpath("elements.js").read_text(encoding="utf-8"),
        "heat_map": here.joinpath("heat_map.js").read_text(encoding="utf-8"),
        "parallel": here.joinpath("parallel.js").read_text(encoding="utf-8"),
        "script": here.joinpath("sweep.js").read_text(encoding="utf-8"),
    }
    # All at once: what a part has in braces is no place for another.
    return re.sub(r"\{\{(\w+)\}\}", lambda place: parts[place[1]], text)


def title_of(results: Results) -> str:
    return results.title or "Sweep"


def page_data(results: Results, folder: Path) -> dict[str, Any]:
    """What the script shows. A run is an object with `parameters` and `metrics` as lists."""
    parameters, metrics = results.parameters, results.metrics
    effort = results.effort
    return {
        "title": title_of(results),
        "parameters": [
            {"name": name, "numeric": all(is_number(run.point.get(name)) for run in results)}
            for name in parameters
        ],
        "metrics": metrics,
        "objective": results.objective,
        "outcomes": results.outcomes,
        "effort": {
            "runs": effort.runs,
            "workers": effort.workers,
            "wall_s": effort.wall_s,
            "own_s": effort.own_s,
            "overhead": _finite(effort.overhead),
        },
        "runs": [_data_of(run, parameters, metrics, results, folder) for run in results],
    }


def _data_of(
    run: Run, parameters: list[str], metrics: list[str], results: Results, folder: Path
) -> dict[str, Any]:
    return {
        "number": run.number,
        "outcome": run.outcome,
        "parameters": [_value(run.point.get(name)) for name in parameters],
        "metrics": [_finite(run.metrics.get(name, math.nan)) for name in metrics],
        "reason": run.reason,
        "seconds": round(run.seconds, 4),
        **_links(run, results, folder),
    }


def _links(run: Run, results: Results, folder: Path) -> dict[str, str]:
    """To what the run has left, if it was recorded."""
    recorded = results.folder_of(run)
    if recorded is None:
        return {}
    links = {"folder": Path(os.path.relpath(recorded, folder)).as_posix() + "/"}
    if (recorded / "report.html").exists():
        links["report"] = links["folder"] + "report.html"
    return links


def _value(value: Any) -> Any:
    return float(value) if is_number(value) else text_of(value)


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
