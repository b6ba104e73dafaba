"""What a run leaves on disk, and what a notebook shows of it."""

import pytest

from cowalk.scenarios import load, run, write_run


@pytest.fixture(scope="module")
def walked():
    return run(load("walk", ["plant=unicycle", "duration=2", "expect={}"]))


def test_a_notebook_shows_the_picture_that_the_folder_holds(walked, tmp_path):
    assert walked._repr_png_() == (write_run(walked, tmp_path) / "figure.png").read_bytes()


def test_a_result_is_said_in_one_line(walked):
    assert repr(walked) == "<RunResult walk, seed 4: ended by time, 0 of 0 expectations hold>"


def test_without_a_figure_that_of_an_earlier_run_goes(walked, tmp_path):
    (tmp_path / "figure.png").write_bytes(b"another run's")
    write_run(walked, tmp_path, figure=False)
    written = {file.name for file in tmp_path.iterdir()}
    assert written == {"trace.parquet", "summary.json", "scenario.yaml"}
