# SPDX-License-Identifier: Apache-2.0
"""What docs/python.md shows runs, from its first block to its last."""
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_the_code_of_the_page_runs(tmp_path, monkeypatch, capsys):
    (tmp_path / "robots").symlink_to(ROOT / "robots")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.S)
    names = {"__name__": "page"}
    for block in blocks:
        if "armature.connect" not in block:  # needs an application elsewhere: test_connection.py
            exec(compile(block, "docs/python.md", "exec"), names)
    assert len(blocks) == 4
    assert "rad" in capsys.readouterr().out
    assert names["position"].dropped == 0
