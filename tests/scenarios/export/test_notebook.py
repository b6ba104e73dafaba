"""A result in a notebook, without one: IPython formats it as it would for a cell."""

import sys
from pathlib import Path

import numpy as np
import pytest
from IPython.core.formatters import DisplayFormatter

from cowalk.scenarios import load, run
from cowalk.sim.basics.errors import InputError


@pytest.fixture(scope="module")
def walked():
    return run(load("walk", ["plant=unicycle", "duration=2", "expect={}"]))


def test_a_cell_shows_the_picture(walked):
    shown, _ = DisplayFormatter().format(walked)
    assert shown["image/png"].startswith(b"\x89PNG")


def test_a_frame_has_the_traces_columns_and_units(walked):
    frame = walked.trace.to_pandas()
    np.testing.assert_array_equal(frame.to_numpy(), walked.trace.values)
    assert frame.attrs["units"] == walked.trace.units
    frame["fy"] = 0.0  # a copy: the trace stays
    assert np.abs(walked.trace["fy"]).max() > 0.0


def test_without_pandas_there_is_a_line_that_says_what_to_install(walked, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(InputError, match=r"pip install 'cowalk\[notebook\]'"):
        walked.trace.to_pandas()


def test_the_pages_code_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    page = Path(__file__).parents[3] / "docs" / "notebook.md"
    blocks = page.read_text().split("```python\n")[1:]
    exec("\n".join(block.partition("```")[0] for block in blocks), {})
    assert (tmp_path / "runs" / "mine" / "figure.png").exists()
