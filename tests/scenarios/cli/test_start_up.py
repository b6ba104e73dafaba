"""A command imports what it uses, and nothing that is slow to import besides."""

import subprocess
import sys

import pytest

from cowalk.scenarios import scenario_library

SLOW = {
    *("scipy.signal", "scipy.spatial", "scipy.stats", "scipy.optimize", "scipy.interpolate"),
    *("rtamt", "antlr4", "matplotlib", "trimesh", "filterpy", "numba", "joblib", "PIL", "rerun"),
    *("pandas", "IPython", "pytest"),
}
PLAIN = ("run", "puddle", "--no-figure", "--set", "expect={}", "--set", "duration=3")
NO_LOW_PASS = ("--set", "sensor.low_pass=0")
LOW_PASS = ("--set", "sensor.low_pass=20")


def slow_imports(folder, *arguments):
    code = (
        "import sys\nfrom cowalk.scenarios.cli.main import main\n"
        "try: main()\nexcept SystemExit as end: assert end.code in (0, None), end.code\n"
        f"print(*sorted({SLOW} & set(sys.modules)), file=sys.stderr)"
    )
    command = [sys.executable, "-c", code, *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return set(done.stderr.splitlines()[-1].split())


def test_a_plain_run_imports_nothing_slow(tmp_path):
    assert slow_imports(tmp_path, *PLAIN, *NO_LOW_PASS) == set()


@pytest.mark.parametrize(
    ("arguments", "used", "unused"),
    [
        ((*PLAIN, *LOW_PASS), {"scipy.signal"}, {"rtamt", "matplotlib", "PIL"}),
        (
            ("run", "puddle", "--no-figure", *NO_LOW_PASS),
            {"rtamt", "antlr4"},
            SLOW - {"rtamt", "antlr4"},
        ),
        (
            [*(each for each in PLAIN if each != "--no-figure"), *NO_LOW_PASS],
            {"matplotlib", "PIL"},
            {"rtamt", "scipy.signal", "scipy.spatial"},
        ),
        ((*PLAIN, "--smoother", "kalman"), {"filterpy"}, {"rtamt", "matplotlib"}),
    ],
    ids=["low-pass", "expectations", "figure", "kalman"],
)
def test_a_run_imports_what_it_uses(arguments, used, unused, tmp_path):
    found = slow_imports(tmp_path, *arguments)
    assert used <= found
    assert not unused & found


@pytest.mark.parametrize("command", [("list",), ("humans", "list")])
def test_commands_that_only_look_import_nothing_slow(command, tmp_path):
    assert slow_imports(tmp_path, *command) == set()


def test_a_check_imports_what_its_one_step_uses(tmp_path):
    file = tmp_path / "quiet.scenario.yaml"
    shipped = scenario_library()["puddle"].read_text()
    file.write_text(shipped.replace("sensor: industrial", "sensor: none"))
    assert slow_imports(tmp_path, "check", str(file)) <= {"rtamt", "antlr4"}
    assert "scipy.signal" in slow_imports(tmp_path, "check", "puddle"), "its sensor's low-pass"
