"""Recordings for the Rerun viewer, read back: entities, one timeline, values, places."""

import sys

import numpy as np
import pytest

from cowalk.scenarios import load, run
from cowalk.scenarios.watch.rerun_log import CURVES, RerunLog
from cowalk.sim.basics.errors import InputError

DURATION = "duration=1.0"


@pytest.fixture(scope="module")
def rrd():
    """Reader of recordings."""
    return pytest.importorskip("rerun.chunk", reason="the extra 'rerun' is not installed").RrdReader


def recorded(rrd, file):
    """Return times (s) and components by entity, in order of time, and what is still."""
    moving, still = {}, set()
    for chunk in rrd(str(file)).stream().to_chunks():
        batch = chunk.to_record_batch()
        if chunk.is_static:
            still.add(chunk.entity_path)
            continue
        assert chunk.timeline_names == ["time"]
        rows = moving.setdefault(chunk.entity_path, [])
        names = [name for name in batch.schema.names if ":" in name]
        times = batch.column("time").cast("int64").to_numpy() / 1e9
        columns = [batch.column(name).to_pylist() for name in names]
        for time, *values in zip(times, *columns, strict=True):
            rows.append((time, dict(zip(names, values, strict=True))))
    return {entity: sorted(rows, key=lambda row: row[0]) for entity, rows in moving.items()}, still


@pytest.fixture(scope="module", params=["bullet", "unicycle"])
def recording(request, rrd, tmp_path_factory):
    file = tmp_path_factory.mktemp("recording") / "deep" / "run.rrd"
    scenario = load("puddle", [DURATION, f"plant={request.param}"])
    trace = run(scenario, watchers=[RerunLog(file)]).trace
    assert trace.values.tobytes() == run(scenario).trace.values.tobytes()
    return (trace, *recorded(rrd, file))


def test_every_curve_is_the_traces_column(recording):
    trace, moving, still = recording
    for entity, (column, _, _) in CURVES.items():
        times, values = zip(*moving[f"/{entity}"], strict=True)
        np.testing.assert_allclose(times, trace["t"], atol=1e-6)
        read = [value["Scalars:scalars"][0] for value in values]
        np.testing.assert_array_equal(read, trace[column])
        assert f"/{entity}" in still, "named and coloured"


def test_bodies_move_as_the_trace_says(recording):
    trace, moving, _ = recording
    trunk = "human/trunk" if "/world/human/trunk" in moving else "human/body"
    for part, x, y in (("base/body", "x", "y"), (trunk, "human_x", "human_y")):
        root = moving[f"/world/{part}"]
        assert len(root) == len(trace) + 1, "and where they stood at the start"
        places = [row["Transform3D:translation"][0] for _, row in root[1:]]
        np.testing.assert_allclose(
            np.array(places)[:, :2], np.stack((trace[x], trace[y]), axis=-1), atol=1e-4
        )


def test_force_and_wishes_are_drawn_every_step(recording):
    trace, moving, still = recording
    arrows = moving["/world/force"]
    assert len(arrows) == len(trace)
    lengths = [np.hypot(*row["Arrows3D:vectors"][0][:2]) for _, row in arrows]
    np.testing.assert_allclose(lengths, 0.1 * np.hypot(trace["fx"], trace["fy"]), atol=1e-5)
    horizon = 2.5  # of the scenario
    for entity, prefix in (
        ("human/true", "true"),
        ("human/believed", "est"),
        ("automation", "wish"),
    ):
        for row, (_, drawn) in enumerate(moving[f"/world/wishes/{entity}"]):
            speed = trace[f"{prefix}_v"][row]
            for strip in drawn["LineStrips3D:strips"]:
                length = np.hypot(*np.diff(np.array(strip)[:, :2], axis=0).T).sum()
                assert length == pytest.approx(abs(speed) * horizon, rel=0.01, abs=1e-6)
    assert {"/world/path", "/world/floor"} <= still
    assert any(entity.startswith("/world/scenery/") for entity in still), "walls and puddle"


def test_a_run_that_dies_midway_leaves_a_recording_of_it(rrd, folder, scenario_file):
    scenario = load(str(scenario_file()), ["human=my_models:TurnsToNan"])
    result = run(scenario, watchers=[RerunLog(folder / "a.rrd")])
    moving, _ = recorded(rrd, folder / "a.rrd")
    assert len(moving["/force/left"]) == len(result.trace) == 21


def test_without_rerun_one_line_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "rerun", None)
    with pytest.raises(InputError, match=r"needs Rerun.*: pip install 'cowalk\[rerun\]'"):
        RerunLog(tmp_path / "a.rrd")


def test_another_ending_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"run.txt: the name must end in .rrd"):
        RerunLog(tmp_path / "run.txt")
