"""How commands end: their exit codes, and what is kept when a signal or a fault ends them."""

import json
import os
import signal
from pathlib import Path

import numpy as np
import pytest

from cowalk.agents.humans.steady import SteadyHuman as Steady
from cowalk.scenarios import load, run
from cowalk.scenarios.running.signals import SIGNALS
from cowalk.scenarios.trace.trace import Trace

SIGNALLING = """
import signal
import numpy as np
from cowalk.agents import Truth

class Signalling:
    def __init__(self, numbers: list[int], swallow: bool = False):
        self.numbers, self.swallow = numbers, swallow

    def reset(self, rng, situation): pass

    def truth(self): return Truth(np.zeros(2), np.zeros(2))

    def act(self, observation):
        if observation["time"][0] > 1.0:
            try:
                for number in self.numbers:
                    signal.raise_signal(number)
            except BaseException:
                if not self.swallow: raise
        return np.zeros(2)
"""


@pytest.fixture
def signalled(cowalk, scenario_file, folder):
    """Run a scenario whose human sends these signals to the process after a second."""
    (folder / "signalling.py").write_text(SIGNALLING)

    def call(*numbers, swallow=False, options=()):
        chosen = [
            *("--human", "signalling:Signalling", "--no-figure", "--out", "kept"),
            *("--set", f"human.parameters.numbers={[int(number) for number in numbers]}"),
            *("--set", f"human.parameters.swallow={json.dumps(swallow)}"),
        ]
        return cowalk("run", scenario_file(), *chosen, *options)

    return call


@pytest.mark.parametrize(
    ("numbers", "expected"),
    [
        ([signal.SIGINT], 130),
        ([signal.SIGTERM], 143),
        ([signal.SIGHUP], 129),
        ([signal.SIGTERM, signal.SIGINT], 143),
    ],
)
def test_a_signal_ends_a_run_with_its_trace(signalled, numbers, expected):
    before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
    code, out, err = signalled(*numbers)
    assert (code, out) == (expected, "")
    assert err == (
        "cowalk: walk: interrupted by the user; the trace so far, 21 rows, is in "
        "kept/trace.parquet\n"
    )
    assert len(Trace.read(Path("kept/trace.parquet"))) == 21
    assert json.loads(Path("kept/summary.json").read_text())["end"] == "interrupted"
    assert before == [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]


def test_signals_wait_while_results_are_written(signalled, monkeypatch):
    usual = Trace.write

    def write(trace, file):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.raise_signal(number)
        usual(trace, file)
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(Trace, "write", write)
    code, _, err = signalled(signal.SIGINT)
    assert (code, err.count("\n")) == (130, 1)
    assert len(Trace.read(Path("kept/trace.parquet"))) == 21
    code, out, _ = signalled()  # one that comes as a whole run is written is not forgotten
    assert code == 130
    assert len(Trace.read(Path("kept/trace.parquet"))) == 60
    assert "ended by: time" in out


def test_a_part_that_swallows_a_signal_is_ended_all_the_same(signalled):
    code, _, _ = signalled(signal.SIGINT, swallow=True)
    assert code == 130
    assert len(Trace.read(Path("kept/trace.parquet"))) == 22


def test_a_signal_that_is_ignored_from_the_start_stays_so(signalled):
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        code, out, _ = signalled(signal.SIGHUP)
    finally:
        signal.signal(signal.SIGHUP, before)
    assert code == 0
    assert "ended by: time" in out


def test_in_python_an_interrupt_that_comes_late_waits_and_is_raised(monkeypatch):
    scenario = load("puddle", ["plant=unicycle", "duration=1", "expect={}"])
    monkeypatch.setattr(
        "cowalk.scenarios.running.measured.metrics",
        lambda *given: signal.raise_signal(signal.SIGINT) or {},
    )
    with pytest.raises(KeyboardInterrupt):
        run(scenario)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert SIGNALS.received is None


def stumbles(self, observation):
    if observation["time"][0] > 1.0:
        raise KeyError("a bug")
    return np.zeros(2)


def test_a_fault_of_cowalks_own_in_a_run_is_3_with_trace_and_report(
    cowalk, scenario_file, folder, monkeypatch
):
    monkeypatch.setattr(Steady, "act", stumbles)
    code, out, err = cowalk("run", scenario_file(), "--out", "kept")
    assert (code, out, err.count("\n")) == (3, "", 1)
    assert err.startswith(
        "cowalk: a fault of cowalk's own: human 'steady' failed at t = 1.05 s: KeyError: 'a bug'; "
        "the trace so far, 21 rows, is in kept/trace.parquet; report: kept/fault.txt; please file"
    )
    report = (folder / "kept/fault.txt").read_text()
    for words in ("command:  cowalk run ", "numpy ", "Traceback", "in stumbles", "KeyError"):
        assert words in report
    assert len(Trace.read(folder / "kept/trace.parquet")) == 21
    monkeypatch.undo()
    os.chdir(folder)
    assert cowalk("run", scenario_file(), "--out", "kept", "--no-figure")[0] == 0
    assert not (folder / "kept/fault.txt").exists()


class Nameless(Exception):
    def __str__(self):
        raise RuntimeError("no text")


@pytest.mark.parametrize(
    "failure", [RuntimeError("a bug"), Nameless(), SystemExit(0), RecursionError()]
)
def test_a_fault_outside_a_run_is_3_with_a_report(cowalk, monkeypatch, tmp_path, failure):
    def list_parts(*given):
        raise failure

    monkeypatch.setattr("cowalk.scenarios.cli.humans.list_parts", list_parts)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    code, out, err = cowalk("humans", "list")
    assert (code, out, err.count("\n")) == (3, "", 1)
    assert err.startswith("cowalk: a fault of cowalk's own: ")
    (report,) = tmp_path.iterdir()
    assert str(report) in err
    assert type(failure).__name__ in report.read_text()


def test_scoring_that_fails_does_not_cost_the_trace(cowalk, scenario_file, folder, monkeypatch):
    def fails(*given):
        raise ZeroDivisionError("a bug")

    monkeypatch.setattr("cowalk.scenarios.running.outcome.judge", fails)
    code, _, err = cowalk("run", scenario_file(), "--out", "kept", "--no-figure")
    assert (code, err.count("\n")) == (3, 1)
    assert "walk: scoring the run failed: ZeroDivisionError: a bug" in err
    assert len(Trace.read(folder / "kept/trace.parquet")) == 60


NOISY = """
import ctypes
import os
import numpy as np
from cowalk.agents import Truth

def shout():
    print("from Python")
    os.write(1, b"from the system\\n")
    ctypes.CDLL(None).puts(b"from C")

class Noisy:
    def __init__(self): shout()
    def reset(self, rng, situation): shout()
    def act(self, observation): shout(); return np.zeros(2)
    def truth(self): return Truth(np.zeros(2), np.zeros(2))
"""


def test_what_parts_print_never_reaches_the_json(cowalk, scenario_file, folder):
    (folder / "noisy.py").write_text(NOISY)
    options = ("--human", "noisy:Noisy", "--json", "--no-figure")
    code, out, err = cowalk("run", scenario_file(), *options)
    assert code == 0
    assert json.loads(out)["end"] == "time"
    assert "from Python" in err
    code, out, _ = cowalk("run", scenario_file(), *options, "--show")
    assert json.loads(out)["scenario"]["name"] == "walk"


def test_a_complaint_is_one_line_that_no_terminal_obeys(cowalk, folder):
    (folder / "bad.yaml").write_text('"\\e[2J\\u202ename\\r\\n\\x85": 1\n')
    code, _, err = cowalk("run", "bad.yaml")
    assert code == 2
    assert err.endswith("\n")
    assert err[:-1].isprintable()


def test_documents_say_what_the_codes_mean():
    text = Path(__file__).parents[3].joinpath("docs/exit-codes.md").read_text()
    for code in ("| 0 |", "| 1 |", "| 2 |", "| 3 |", "| 129, 130, 143 |"):
        assert code in text
