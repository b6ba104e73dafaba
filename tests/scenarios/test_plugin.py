import subprocess
import sys
import textwrap

import pytest

import cowalk.scenarios.expect.margin
import cowalk.scenarios.running.runner
import cowalk.sim.unicycle.plant  # noqa: F401  pytester forgets what is imported within it

GOOD = """\
name: good
duration: 2.0
plant: unicycle
world: {path: {points: [[0.0, 0.0], [30.0, 0.0]]}}
human: steady
automation: never-yields
expect:
  walks on: eventually (x >= 1.0)
  stays in the middle: always (abs(y) <= 0.01)
"""


@pytest.fixture
def scenarios(pytester):
    def write(**texts):
        for name, text in texts.items():
            (pytester.path / f"{name}.scenario.yaml").write_text(text)
        return pytester

    return write


def test_a_good_and_a_broken_scenario_side_by_side(scenarios):
    broken = GOOD.replace("human: steady", "human: stedy").replace("2.0", "-2.0")
    result = scenarios(good=GOOD, broken=broken).runpytest_subprocess("-W", "error")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(
        [
            "*broken.scenario.yaml is broken, 2 faults:",
            "*line 2: duration = -2.0 s: must lie between*",
            "*line 5: human.name: unknown human 'stedy'; did you mean 'steady'?*",
        ]
    )
    result.stdout.no_fnmatch_line("*Traceback*")
    result.stdout.no_fnmatch_line("*.py:*")


def test_each_expectation_is_a_test_with_a_short_failure(scenarios):
    text = GOOD + "  goes far: eventually (x >= 10.0)\n"
    result = scenarios(good=text).runpytest_inprocess("-v", "-W", "error")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(["*good.scenario.yaml::walks on PASSED*"])
    result.stdout.fnmatch_lines(
        [
            "expectation: goes far",
            "formula:     eventually (x >= 10.0)",
            "fails:       margin -8.*, closest at t = 2 s with x = 1.6",
            "run:         seed 0; human steady; automation never-yields; *plant unicycle",
            "to see the run: cowalk run *good.scenario.yaml",
        ]
    )
    result.stdout.no_fnmatch_line("*Failure*")


def test_what_holds_vacuously_is_warned_of(scenarios):
    text = GOOD + "  is slow far out: always ((x >= 10.0) implies (v <= 0.1))\n"
    pytester = scenarios(good=text)
    warned = pytester.runpytest_inprocess("-W", "default")
    warned.assert_outcomes(passed=3, warnings=1)
    said = "it would hold even if v <= 0.1 never did: x >= 10.0 never holds"
    warned.stdout.fnmatch_lines([f"*good.scenario.yaml:10: VacuousExpectation: *{said}"])
    strict = pytester.runpytest_inprocess("-W", "error")
    strict.assert_outcomes(passed=2, failed=1)
    strict.stdout.fnmatch_lines([f"*{said}"])
    strict.stdout.no_fnmatch_line("*.py:*")


@pytest.mark.parametrize(
    ("formula", "words"),
    [
        ("always (x + y <= 30", "the formula ends too early"),
        ("always[0:1e9s] (x > 0)", "the bound 1e+09 s lies beyond the end of the run"),
    ],
)
def test_a_bad_formula_keeps_no_other_file_from_running(scenarios, formula, words):
    bad = GOOD + f"  bad: {formula}\n"
    result = scenarios(good=GOOD, bad=bad).runpytest_inprocess("-W", "error")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines([f"*line 10: expect.bad*{words}*"])
    result.stdout.no_fnmatch_line("*Traceback*")


def test_a_file_that_is_no_text_keeps_no_other_from_running(scenarios):
    pytester = scenarios(good=GOOD)
    (pytester.path / "bytes.scenario.yaml").write_bytes(b"name: \xff\xfe")
    result = pytester.runpytest_inprocess("-W", "error")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(["*this is not text in UTF-8*"])
    result.stdout.no_fnmatch_line("*Traceback*")


def test_a_file_that_cowalk_stumbles_over_keeps_no_other_from_running(scenarios):
    pytester = scenarios(good=GOOD, odd=GOOD.replace("name: good", "name: odd"))
    pytester.makeconftest(
        """
        from cowalk.scenarios.files import loading

        known = loading.faults

        def faults(file, **more):
            if file.name.startswith("odd"):
                raise AttributeError("a fault of cowalk's own")
            return known(file, **more)

        loading.faults = faults
        """
    )
    result = pytester.runpytest_subprocess("-W", "error")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(["*AttributeError: a fault of cowalk's own"])


def test_one_expectation_can_be_chosen(scenarios):
    result = scenarios(good=GOOD).runpytest_inprocess("good.scenario.yaml::walks on")
    result.assert_outcomes(passed=1)


def test_a_scenario_without_expectations_must_run_through(scenarios):
    text = GOOD.partition("expect:")[0]
    models = textwrap.dedent(
        """
        import numpy as np
        from cowalk.agents import Truth

        class TurnsToNan:
            def reset(self, rng, situation): pass
            def act(self, observation): return np.full(2, np.nan)
            def truth(self): return Truth(np.zeros(2), np.zeros(2))
        """
    )
    pytester = scenarios(good=text, astray=text.replace("steady", "astray_models:TurnsToNan"))
    pytester.makepyfile(astray_models=models)
    result = pytester.runpytest_inprocess("-v", "--cowalk-trust")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["*good.scenario.yaml::runs to its end PASSED*"])
    result.stdout.fnmatch_lines(["the run was aborted: *nan*"])
    result.stdout.no_fnmatch_line("*Traceback*")


def test_the_run_is_made_once_a_file(scenarios):
    counting = """
        from cowalk.agents.humans.steady import SteadyHuman
        from pathlib import Path

        class Counted(SteadyHuman):
            def reset(self, rng, situation):
                with Path("resets.txt").open("a") as file:
                    file.write("reset\\n")
                super().reset(rng, situation)
        """
    pytester = scenarios(good=GOOD.replace("steady", "counting_models:Counted"))
    pytester.makepyfile(counting_models=counting)
    pytester.makeini("[pytest]\ncowalk_trust = true")
    pytester.runpytest_inprocess().assert_outcomes(passed=2)
    assert (pytester.path / "resets.txt").read_text() == "reset\n"


def test_the_fixture_runs_names_and_files_beside_the_test(scenarios):
    pytester = scenarios()
    folder = pytester.mkdir("deeper")
    (folder / "good.scenario.yaml").write_text(GOOD)
    (folder / "test_walk.py").write_text(
        textwrap.dedent(
            """
            import pytest

            def test_file(run_scenario):
                result = run_scenario("good.scenario.yaml", "duration=1.5", seed=5)
                assert result.passed and result.summary["seed"] == 5
                assert len(result.trace) == 30

            def test_name(run_scenario):
                result = run_scenario("paper-open-loop", "duration=1.0", "expect={}")
                assert result.trace["t"][-1] == pytest.approx(1.0)
            """
        )
    )
    result = pytester.runpytest_inprocess("-W", "error", "deeper/test_walk.py")
    result.assert_outcomes(passed=2)


def test_the_plugin_imports_nothing_heavy():
    code = (
        "import sys, cowalk.scenarios.pytest_plugin\n"
        "print(sorted({'numpy', 'pydantic', 'yaml', 'rtamt', 'pybullet'} & set(sys.modules)))"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert shown.stdout == "[]\n"
