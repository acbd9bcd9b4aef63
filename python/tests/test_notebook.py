# SPDX-License-Identifier: Apache-2.0
"""The notebook runs from its first cell to its last, and finds what it says."""
import re
from pathlib import Path

import pytest

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("matplotlib")

NOTEBOOK = Path(__file__).parents[1] / "notebooks/tune_janus.ipynb"


@pytest.fixture(scope="module")
def outputs():
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbclient.NotebookClient(notebook, timeout=280, kernel_name="python3",
                            resources={"metadata": {"path": str(NOTEBOOK.parent)}}).execute()
    return [output for cell in notebook.cells for output in cell.get("outputs", [])]


def test_better_gains_are_found_and_worse_ones_refused(outputs):
    text = "".join(output.get("text", "") for output in outputs)
    assert re.search(r"best: Kp \d+ V/rad, Ki \d+ V/rad", text)
    assert "gain margin" in text
    smaller = int(re.search(r"(\d+)% smaller", text)[1])
    assert smaller > 20


def test_it_has_a_plot(outputs):
    assert any("image/png" in output.get("data", {}) for output in outputs)


def test_it_is_kept_without_outputs():
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells)
