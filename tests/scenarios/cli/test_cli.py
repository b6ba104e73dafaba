import json
import os
import pty
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from cowalk.scenarios.cli import output as cli_output
from cowalk.scenarios.studies import calibration, paper
from cowalk.scenarios.trace.trace import Trace


@pytest.fixture
def refused(cowalk):
    """Run the command, which must end with code 2 and one line; return the line."""

    def call(*arguments):
        code, out, err = cowalk(*arguments)
        assert code == 2
        assert out == ""
        assert err.startswith("cowalk: ")
        assert err.count("\n") == 1
        return err

    return call


def test_help_answers_within_half_a_second():
    started = time.perf_counter()
    shown = subprocess.run(
        [sys.executable, "-c", "from cowalk.scenarios.cli.main import main; main()", "--help"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert time.perf_counter() - started < 0.5 * _slowness()
    assert all(word in shown.stdout for word in ("run", "list", "paper", "compare", "check"))


def _slowness():
    """Return how much slower than usual this machine starts Python just now, at least 1."""
    started = time.perf_counter()
    subprocess.run([sys.executable, "-c", "pass"], check=True)
    return max(1.0, (time.perf_counter() - started) / 0.05)


def test_help_imports_nothing_heavy():
    code = (
        "import sys\nfrom cowalk.scenarios.cli.main import main\n"
        "try: main()\nexcept SystemExit: pass\n"
        "print(sorted({'numpy', 'pydantic', 'rtamt', 'rich', 'yaml'} & set(sys.modules)))"
    )
    command = [sys.executable, "-c", code, "--help"]
    shown = subprocess.run(command, capture_output=True, text=True, check=True)
    assert shown.stdout.splitlines()[-1] == "[]"


@pytest.mark.parametrize(
    "command",
    [
        "run",
        "list",
        "check",
        "paper",
        "compare",
        "compare smoothers",
        "compare observers",
        "compare front-ends",
        "compare automations",
        "compare humans",
        "new",
        "humans sample",
        "humans show",
        "humans table",
    ],
)
def test_every_command_explains_itself(cowalk, command):
    code, out, _ = cowalk(*command.split(), "--help")
    assert code == 0
    assert "Usage: cowalk " + command in out
    assert command == "compare" or "Examples:\n    cowalk " + command in out


def test_without_a_command_there_is_help(cowalk):
    code, out, _ = cowalk()
    assert code == 0
    assert out.startswith("Usage: cowalk")


def test_a_run_writes_its_folder_and_ends_with_table_picture_and_speed(
    cowalk, scenario_file, folder
):
    expect = "expect:\n  walks on: eventually (x >= 1.0)\n"
    code, out, err = cowalk("run", scenario_file(more=expect))
    assert (code, err) == (0, "")
    written = {file.name for file in (folder / "runs/walk").iterdir()}
    assert written == {"trace.parquet", "summary.json", "scenario.yaml", "figure.png"}
    for words in ("smallest clearance", "walks on", "holds", "runs/walk/figure.png", "real time"):
        assert words in out


@pytest.mark.parametrize("options", [(), ("--json",)])
def test_results_are_there_before_the_picture(options, cowalk, scenario_file, monkeypatch, capfd):
    shown = []

    def draw(result, file):
        shown.append(capfd.readouterr().out)
        file.touch()

    monkeypatch.setattr("cowalk.scenarios.figures.run.draw_run", draw)
    code, after, _ = cowalk("run", scenario_file(), *options)
    assert code == 0
    assert "smallest clearance" in shown[0]
    assert "picture" not in shown[0]
    assert after == ("" if options else "picture:  runs/walk/figure.png\n")


def test_without_a_figure_there_is_none_nor_that_of_an_earlier_run(
    cowalk, scenario_file, folder, monkeypatch
):
    monkeypatch.setattr(
        "cowalk.scenarios.figures.run.draw_run", lambda _, file: file.write_bytes(b"drawn")
    )
    figure = folder / "runs/walk/figure.png"
    cowalk("run", scenario_file())
    assert figure.exists()
    code, out, err = cowalk("run", scenario_file(), "--no-figure")
    assert (code, err) == (0, "")
    assert "picture" not in out
    assert not figure.exists()


def test_the_kept_scenario_runs_again_to_the_same_trace(cowalk, scenario_file, folder):
    cowalk("run", scenario_file(), "--human", "escalating", "--seed", 4, "--out", "first")
    code, _, _ = cowalk("run", "first/scenario.yaml", "--out", "second")
    assert code == 0
    first, second = (
        Trace.read(folder / name / "trace.parquet").values for name in ("first", "second")
    )
    np.testing.assert_array_equal(first, second)


def test_a_failed_expectation_is_named_with_margin_and_time(cowalk, scenario_file):
    expect = "expect:\n  not far: always (x <= 1.02)\n"
    code, out, err = cowalk("run", scenario_file(more=expect))
    assert (code, err) == (1, "")
    (line,) = [line for line in out.splitlines() if "FAILS" in line]
    assert "not far" in line
    assert "margin -1.38" in line
    assert "first violated at t = 1.3 s" in line
    (parts,) = [line for line in out.splitlines() if line.startswith("run: ")]
    assert all(part in parts for part in ("seed", "human", "automation", "plant")), parts
    _, out, _ = cowalk("run", scenario_file())
    assert "run: " not in out


def test_json_alone_is_on_standard_output_even_with_the_engine(scenario_file):
    expect = "expect:\n  hangs on NaN: always (est_v >= 0.0 * est_v)\n"
    command = [sys.executable, "-c", "from cowalk.scenarios.cli.main import main; main()"]
    arguments = ["run", str(scenario_file(more=expect)), "--plant", "bullet", "--json"]
    shown = subprocess.run([*command, *arguments], capture_output=True, text=True, check=False)
    summary = json.loads(shown.stdout)
    assert summary["plant"] == "bullet"
    assert summary["folder"] == "runs/walk"
    assert summary["passed"] is (shown.returncode == 0)
    assert shown.stderr == ""


def test_parts_are_swapped_and_values_set(cowalk, scenario_file):
    code, out, _ = cowalk(
        *("run", scenario_file(), "--json", "--automation", "stubbornness", "--smoother", "kalman"),
        *("--human", "my_models:Quiet", "--seed", 9, "--set", "duration=1.0", "--set", "pace=0.5"),
    )
    summary = json.loads(out)
    assert code == 0
    assert (summary["human"], summary["automation"]) == ("my_models:Quiet", "stubbornness")
    assert (summary["smoother"], summary["seed"]) == ("kalman", 9)
    assert summary["simulated_time_s"] == pytest.approx(1.0)


def test_bad_input_is_one_line_that_names_what_would_be_right(refused, scenario_file):
    file = scenario_file()
    for arguments, words in {
        ("run", "pudle"): "did you mean 'puddle'?",
        ("run", "no.yaml"): "no.yaml: this scenario file does not exist",
        ("run", file, "--human", "stedy"): "--human stedy: human.name: unknown human 'stedy'; did",
        ("run", file, "--smoother", "x"): "--smoother x: automation.smoother.name: unknown",
        ("run", file, "--set", "humn.x=1"): "--set humn.x=1: humn: unknown key; did you mean 'hum",
        ("run", file, "--set", "pace=fast"): "pace = 'fast': a number is expected, not text",
        ("run", file, "--set", "rates.control=7"): "7 Hz; 238 would be",
        ("run", file, "--seed", "-3"): "--seed -3: seed = -3: it must be at least 0",
        ("run", file, "--seed", "x"): "'--seed'",
        ("run", file, "--sed", "3"): "No such option: --sed",
        ("run", file, "--human", "my_models:Unbuildable"): "it cannot be built: KeyError",
        ("run", file, "--human", "my_models:Picky"): "human.parameters.push is missing",
        ("run", file, "--human", "my_models:Nobody"): "cannot be imported",
        ("run",): "Missing argument",
        ("runn", file): "No such command",
        ("list", "robots"): "'robots' is not one of 'scenarios', 'humans'",
        ("compare", "smoothers", file, "-n", "0"): "'-n'",
    }.items():
        assert words in refused(*arguments)


def test_a_run_is_filmed_and_recorded_on_demand(cowalk, scenario_file, folder):
    pytest.importorskip("rerun", reason="the extra 'rerun' is not installed")
    watched = ("--video", "films/walk.mp4", "--rerun", "walk.rrd")
    code, out, err = cowalk("run", scenario_file(), "--set", "duration=0.2", *watched)
    assert (code, err) == (0, "")
    assert "video:    films/walk.mp4" in out
    assert "rerun:    walk.rrd" in out
    assert (folder / "films/walk.mp4").stat().st_size > 1000
    assert (folder / "walk.rrd").stat().st_size > 1000
    code, out, _ = cowalk("run", scenario_file(), "--json", "--set", "duration=0.2", *watched[:2])
    assert json.loads(out)["video"] == "films/walk.mp4"


def test_a_robot_that_cannot_be_read_is_refused_where_it_is_named(refused, tmp_path):
    robot = tmp_path / "own.urdf"
    robot.write_text(
        '<robot name="own"><link name="base"/><link name="grip"/><joint name="j" type="fixed">'
        '<parent link="base"/><child link="grip"/><origin xyz="0 nan 1"/></joint></robot>'
    )
    said = refused("run", "walk", "--set", f"plant.parameters.robot.urdf={robot}")
    place = (
        """plant.parameters.robot: joint 'j': <origin xyz="0 nan 1">: must be 3 finite numbers"""
    )
    assert place in said


def test_a_run_that_cannot_be_watched_is_refused(refused, scenario_file, monkeypatch):
    words = "--video walk.avi: the name must end in .mp4"
    assert words in refused("run", scenario_file(), "--video", "walk.avi")
    words = "--rerun walk.txt: the name must end in .rrd"
    assert words in refused("run", scenario_file(), "--rerun", "walk.txt")
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    assert "pip install imageio-ffmpeg" in refused("run", scenario_file(), "--video", "a.mp4")
    monkeypatch.setitem(sys.modules, "rerun", None)
    assert "pip install 'cowalk[rerun]'" in refused("run", scenario_file(), "--rerun", "a.rrd")


@pytest.mark.skipif(sys.platform != "linux", reason="a display is needed on Linux alone")
@pytest.mark.parametrize("plant", ["bullet", "unicycle"])
def test_no_window_without_a_display(refused, scenario_file, monkeypatch, plant):
    monkeypatch.setenv("DISPLAY", ":4711")
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    said = refused("run", scenario_file(), "--gui", "--plant", plant)
    assert "no window can be opened" in said


def test_a_folder_that_cannot_be_written_is_refused_before_the_run(
    refused, scenario_file, folder, monkeypatch
):
    monkeypatch.setattr("cowalk.scenarios.running.runner.run", None)  # would fail if it were called
    (folder / "taken").write_text("a regular file")
    words = "--out taken/below: cannot write there"
    assert words in refused("run", scenario_file(), "--out", "taken/below")
    assert words in refused("paper", "--out", "taken/below")


@pytest.mark.parametrize(
    ("human", "words"),
    [
        ("TurnsToNan", "nan"),
        ("Interrupted", "human 'my_models:Interrupted' failed at t = 1.05 s: KeyboardInterrupt"),
        ("Refuses", "human 'my_models:Refuses' failed at t = 1.05 s: InputError: no more"),
        ("Leaves", "human 'my_models:Leaves' failed at t = 1.05 s: GeneratorExit: gone"),
    ],
)
def test_a_run_that_dies_keeps_its_trace_so_far(refused, scenario_file, folder, human, words):
    message = refused("run", scenario_file(), "--human", f"my_models:{human}", "--out", "kept")
    assert words in message
    assert "21 rows, is in kept/trace.parquet" in message
    assert len(Trace.read(folder / "kept/trace.parquet")) == 21
    assert json.loads((folder / "kept/summary.json").read_text())["error"]
    assert (folder / "kept/scenario.yaml").exists()


def test_an_aborted_run_still_gives_its_json(cowalk, scenario_file):
    code, out, err = cowalk("run", scenario_file(), "--human", "my_models:TurnsToNan", "--json")
    assert code == 2
    assert json.loads(out)["passed"] is False
    assert err.count("\n") == 1


def test_list_gives_a_line_each(cowalk):
    code, out, _ = cowalk("list")
    assert code == 0
    for words in ("puddle", "escalating", "never-yields", "moving-average", "unicycle"):
        assert words in out
    _, out, _ = cowalk("list", "smoothers", "--json")
    (names,) = json.loads(out).values()
    assert [entry["name"] for entry in names] == ["kalman", "moving-average"]
    assert all(entry["description"].endswith(".") for entry in names)


def test_check_reports_every_fault_of_every_file(cowalk, scenario_file):
    good = scenario_file(name="good.yaml")
    bad = scenario_file(("duration: 3.0", "duration: x\npaec: 1"), name="bad.yaml")
    code, out, _ = cowalk("check", good, bad, "missing.yaml")
    assert code == 2
    lines = out.splitlines()
    assert lines[0] == f"{good}: no fault"
    assert lines[1].startswith(f"{bad}:2: duration = 'x'")
    assert lines[2].startswith(f"{bad}:3: paec: unknown key; did you mean 'pace'?")
    assert lines[3].startswith("missing.yaml: ")
    assert cowalk("check", good, "puddle")[0] == 0


def test_unless_within_bounds_is_judged(cowalk):
    expect = 'expect={waits: "(v >= 0.2) unless[0:2s] (x >= 1.0)", sums: "always (x + y <= 30)"}'
    arguments = ("puddle", "--plant", "unicycle", "--set", "duration=4", "--set", expect)
    code, out, _ = cowalk("run", *arguments, "--no-figure", "--json")
    assert code == 0
    assert [verdict["passed"] for verdict in json.loads(out)["expectations"]] == [True, True]


def test_check_strict_runs_and_reports_what_fails_or_holds_vacuously(cowalk, scenario_file):
    more = (
        "expect:\n  walks: eventually (x >= 1.0)\n  arrives: eventually (x >= 10.0)\n"
        "  rests there: always ((x >= 10.0) implies (v <= 0.1))\n"
    )
    file = scenario_file(more=more)
    assert cowalk("check", file)[0] == 0
    code, out, _ = cowalk("check", "--strict", file)
    assert code == 1
    arrives, rests = out.splitlines()
    line = Path(file).read_text().splitlines().index("  arrives: eventually (x >= 10.0)") + 1
    assert arrives.startswith(f"{file}:{line}: expect.arrives = 'eventually (x >= 10.0)' fails: ")
    assert "closest at t = 3 s with x = 2.4" in arrives
    assert "(seed 0; human steady; automation never-yields; " in arrives
    assert rests.startswith(f"{file}:{line + 1}: expect.rests there = ")
    assert "holds: margin 7.6, vacuously: it would hold even if v <= 0.1 never did" in rests
    assert cowalk("check", "--strict", file, "missing.yaml")[0] == 2


def test_check_strict_finds_nothing_where_all_holds(cowalk, scenario_file):
    file = scenario_file(more="expect: {walks: eventually (x >= 1.0)}\n")
    assert cowalk("check", "--strict", file) == (0, f"{file}: no fault\n", "")


def test_check_strict_reports_a_run_that_was_aborted(cowalk, scenario_file):
    file = scenario_file(("name: steady", "name: my_models:TurnsToNan"))
    code, out, _ = cowalk("check", "--strict", "--trust", file)
    assert code == 2
    assert out.startswith(f"{file}: the run was aborted: ")


def _rows(passed):
    return [paper.Row("turns", 0.4, 0.41, 0.03, "rad/s", passed)]


@pytest.mark.parametrize("passed", [True, False])
def test_paper_prints_rows_constants_and_the_verdict(cowalk, monkeypatch, passed):
    monkeypatch.setattr(paper, "reproduce", lambda: _rows(passed))
    monkeypatch.setattr(paper, "constants", lambda: {"tau, s": 2.5})
    code, out, _ = cowalk("paper")
    assert code == (0 if passed else 1)
    assert "0.41" in out
    assert "inferred" in out
    assert "tau, s" in out
    _, out, _ = cowalk("paper", "--json")
    shown = json.loads(out)
    assert shown["rows"][0]["passed"] is shown["passed"] is passed
    assert shown["inferred"] == {"tau, s": 2.5}


def test_paper_searches_with_the_seed_given(cowalk, monkeypatch):
    def search(seed, progress):
        progress(1, 2)
        return {"horizon tau, s": float(seed)}, _rows(True)

    monkeypatch.setattr(calibration, "calibrate", search)
    code, out, _ = cowalk("paper", "--calibrate", "--seed", 3, "--json")
    assert code == 0
    shown = json.loads(out)
    assert shown["inferred"] == {"horizon tau, s": 3.0}
    low, high = shown["searched"]["horizon tau, s"]
    _, out, _ = cowalk("paper", "--calibrate", "--seed", 3)
    assert "--set 'automation.negotiation.horizon=3'" in out
    assert re.search(rf"horizon tau, s +3 +{low:g} +{high:g}\b", out)


@pytest.mark.parametrize("kind", ["smoothers", "observers", "automations"])
def test_compare_lets_people_walk(cowalk, kind):
    given = ("compare", kind, "puddle", "-n", 4, "--plant", "unicycle", "--set", "duration=8")
    code, out, _ = cowalk(*given)
    assert code == 0
    if kind == "automations":
        assert "healthy-adults" in out
        return
    assert "% of rows identifiable" in out
    assert "(calibrated paper)" in out
    assert out.index("(prior)") < out.index("(oracle)")
    assert ("wish, rad/s" in out) == (kind == "observers")
    found = json.loads(cowalk(*given, "--json")[1])
    assert (found["population"], found["people"], found["worlds"]) == ("healthy-adults", 4, 3)
    (prior,) = (
        score
        for each in found["dimensions"]
        for score in each["scores"]
        if (each["dimension"], score["name"]) == ("omega", "prior")
    )
    assert prior["rmse"]["low"] <= prior["rmse"]["value"] <= prior["rmse"]["high"]
    assert prior["gap_closed"] is None


def test_compare_refuses_what_people_bring_along(cowalk):
    for given in (("--human", "steady"), ("--set", "human.parameters.gain=3")):
        code, _, error = cowalk("compare", "smoothers", "puddle", *given)
        assert code == 2
        assert "people of a population bring their own" in error
    code, _, error = cowalk("compare", "smoothers", "--population", "helthy-adults")
    assert (code, "did you mean" in error) == (2, True)


def test_long_work_says_how_far_it_is_where_there_is_no_terminal(capsys, monkeypatch):
    clock = iter((0.0, 4.0, 11.0, 11.0, 15.0, 22.0, 22.0))
    monkeypatch.setattr(cli_output.time, "monotonic", lambda: next(clock))
    with cli_output.progress_bar("filming walk") as progress:
        for done in (1, 2, 3, 4):
            progress(done, 8)
    said = capsys.readouterr().err
    assert said == "cowalk: filming walk: 25 %\ncowalk: filming walk: 50 %\n"


@pytest.mark.parametrize(
    ("factor", "said"), [(0.318, "0.32"), (4.56, "4.6"), (44.4, "44"), (1234.0, "1200")]
)
def test_a_speed_has_two_digits(factor, said):
    assert cli_output.two_digits(factor) == said


def test_progress_is_shown_on_a_terminal_alone(scenario_file):
    command = [sys.executable, "-c", "from cowalk.scenarios.cli.main import main; main()"]
    arguments = ["run", str(scenario_file()), "--json"]
    ours, theirs = pty.openpty()
    with subprocess.Popen([*command, *arguments], stdout=subprocess.PIPE, stderr=theirs) as process:
        out, _ = process.communicate(timeout=60)
    os.close(theirs)
    shown = os.read(ours, 100_000).decode()
    os.close(ours)
    assert json.loads(out)["passed"] is True
    assert "walk" in shown
