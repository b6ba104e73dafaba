import tracemalloc

import numpy as np
import pytest

from cowalk.scenarios.expect.verdict import explain, judge, syntax_error
from cowalk.scenarios.trace.columns import UNITS
from cowalk.sim.basics.errors import InputError

PERIOD = 0.05
T = (np.arange(100) + 1) * PERIOD
COLUMNS = {
    "t": T,
    "ramp": T - 2.0,
    "wave": np.sin(T),
    "zero": np.zeros(100),
    "count": np.floor(T),
    "nowhere": np.full(100, np.inf),
    "unknown": np.full(100, np.nan),
    "late": np.where(T < 0.29, np.nan, T),
}


def verdict(formula, columns=COLUMNS):
    (found,) = judge({"it": formula}, columns, PERIOD)
    return found


@pytest.mark.parametrize(
    ("formula", "robustness"),
    [
        ("always (ramp >= -2.0)", 0.05),
        ("eventually (ramp > 2.9)", 0.1),
        ("always[0:2s] (ramp <= 1.0)", 0.95),
        ("eventually[1s:2s] (t >= 2.0)", 0.05),
        ("always ((t < 2.0) implies (ramp < 0.5))", 0.25),
        ("always (abs(wave) <= 1.5)", 0.5),
        ("(t < 1) until[0:3s] (ramp > -1.5)", 0.25),
        ("not (ramp > 0)", 1.95),
        ("always (2 * count - count <= 5)", 0.0),
        ("always (nowhere >= 0.3)", np.inf),
        ("(zero == 1) iff (ramp > 100)", 1.0),
        ("always (ramp + zero + 1 <= 5)", 1.0),
        ("always (count - (zero + 1) >= -1)", 0.0),
        ("always (min(ramp, wave) <= 0.8)", 0.8 - np.max(np.minimum(T - 2.0, np.sin(T)))),
        ("always (max(ramp, 0) >= 0)", 0.0),
        ("always (abs(rate(ramp) - 1) <= 0.1)", 0.1),
        ("always (rate(count) <= 20.5)", 0.5),
        ("eventually (rate(count) >= 19.5)", 0.5),
        ("always ((t >= 1) implies (rate(t - ramp) <= 0.1))", 0.1),
        ("(ramp <= 0) unless[0:2s] (t >= 1)", 0.5),
        ("(ramp <= 3.5) unless[1s:2s] (t >= 99)", 3.45),
        ("(ramp <= 0) unless (t >= 1)", 0.5),
        ("(ramp <= 3.5) unless (t >= 99)", 0.5),
    ],
)
def test_what_holds_passes_with_its_margin(formula, robustness):
    found = verdict(formula)
    assert found.passed
    assert found.robustness == pytest.approx(robustness, abs=1e-3)
    assert found.violated_at is None
    assert found.reason is None


@pytest.mark.parametrize(
    ("formula", "robustness", "violated_at"),
    [
        ("always (ramp <= 1.0)", -2.0, 3.05),
        ("always[1s:2s] (ramp <= -1.5)", -1.55, 1.05),
        ("always ((ramp > 0.0) implies eventually[0:1s] (wave > 0.5))", None, 2.65),
        ("ramp > 0.0", -1.95, 0.05),
        ("always (ramp <= 2.0) and always (ramp <= 1.0)", -2.0, 3.05),
        ("always (ramp <= 1.0) and always (wave <= 2.0)", -2.0, 3.05),
        ("(ramp <= 0) unless[0:2s] (t >= 3)", -0.05, 2.05),
        ("always (ramp + t <= 3)", -5.0, 2.55),
    ],
)
def test_what_does_not_hold_fails_where_it_first_does_not(formula, robustness, violated_at):
    found = verdict(formula)
    assert not found.passed
    assert found.violated_at == pytest.approx(violated_at)
    assert found.robustness < 0.0
    if robustness is not None:
        assert found.robustness == pytest.approx(robustness, abs=1e-3)
    assert f"first violated at t = {violated_at:g} s" in explain(found)


@pytest.mark.parametrize(
    ("formula", "when", "values"),
    [
        ("eventually (ramp > 4.0)", 5.0, {"ramp": 3.0}),
        ("eventually[0:1s] (ramp + 1 > 4.0)", 1.05, {"ramp + 1": 0.05}),
        ("eventually (abs(wave) >= 1.5)", 4.7, {"abs(wave)": -np.sin(4.7)}),
        ("eventually ((t < 3) and (ramp > 2.0))", 3.5, {"t": 3.5, "ramp": 1.5}),
        ("eventually (always[0:1s] (ramp > 4.0))", 5.0, {}),
        ("always ((t > 2) implies eventually[0:1s] (wave > 0.5))", 2.65, {"wave": np.sin(2.65)}),
        ("always (zero == 0) and eventually (rate(count) > 21)", 1.0, {"rate(count)": 20.0}),
        ("always (t > 0) and ((t > 99) or eventually (count > 9))", 5.0, {"count": 5.0}),
    ],
)
def test_an_eventually_that_fails_says_where_it_came_closest(formula, when, values):
    found = verdict(formula)
    assert not found.passed
    assert found.closest_at == pytest.approx(when, abs=0.001)
    assert found.closest == pytest.approx(values)
    assert f"closest at t = {found.closest_at:g} s" in explain(found)
    assert all(f"{name} = {value:.3g}" in explain(found) for name, value in found.closest.items())


@pytest.mark.parametrize(
    "formula",
    [
        "eventually (ramp > 4.0)",
        "eventually[0:1s] (ramp > 4.0)",
        "(t < 0) or eventually (ramp > 4.0)",
        "always (t > 0) and eventually (ramp > 4.0)",
        "not (always (ramp <= 4.0))",
        "(zero == 0) until (ramp > 4.0)",
    ],
)
def test_what_no_row_violates_is_not_said_to_be_violated(formula):
    found = verdict(formula)
    assert not found.passed
    assert found.violated_at is None
    assert "violated" not in explain(found)


@pytest.mark.parametrize("formula", ["always (unknown > 0)", "eventually (unknown > 0)"])
def test_what_is_unknown_in_the_whole_run_fails_as_that(formula):
    found = verdict(formula)
    assert not found.passed
    assert found.reason.startswith("unknown is unknown in this run")


@pytest.mark.parametrize(
    "formula",
    ["always ((unknown > 0) implies (t > 0))", "eventually ((unknown > 0) or (ramp > 0))"],
)
def test_what_holds_whatever_is_unknown_holds_vacuously(formula):
    found = verdict(formula)
    assert found.passed
    assert found.vacuous.startswith("unknown is unknown in this run")


def test_what_fails_by_no_eventually_came_closest_nowhere():
    assert verdict("always (ramp <= 1.0)").closest_at is None
    assert verdict("eventually (unknown > 0)").closest_at is None


def test_the_rate_of_the_first_row_is_that_of_the_second_and_a_single_row_has_none():
    columns = {"x": np.array([0.0, 1.0, 1.0])}
    assert verdict("always (rate(x) >= 0)", columns).passed
    assert verdict("rate(x) >= 20", columns).robustness == pytest.approx(0.0)
    assert np.isnan(verdict("rate(x) >= 20", {"x": np.zeros(1)}).robustness)


def test_what_looks_before_the_first_row_fails_and_says_so():
    found = verdict("once[1s:2s] (zero == 0)")
    assert not found.passed
    assert found.reason.startswith("it looks before the first row")
    assert verdict("always (nowhere < 1)").reason is None


def test_bounds_far_beyond_the_end_take_no_memory():
    tracemalloc.start()
    assert verdict("always[0:1e9s] (zero == 0)").passed
    assert not verdict("eventually[0:1e9s] (zero == 1)").passed
    assert not verdict("(zero == 0) until[0:1e9s] (zero == 1)").passed
    assert tracemalloc.get_traced_memory()[1] < 1e7
    tracemalloc.stop()


@pytest.mark.parametrize(
    ("formula", "passed"),
    [
        ("zero >= 0", True),
        ("zero > 0", False),
        ("not (zero > 0)", True),
        ("not (zero >= 0)", False),
        ("zero == 0", True),
        ("not (zero == 0)", False),
        ("zero != 0", False),
        ("zero != 1", True),
        ("(zero == 0) xor (ramp < 0)", False),
        ("(zero == 0) xor (ramp > 0)", True),
        ("(zero == 0) iff (ramp > 0)", False),
        ("eventually (zero > 0)", False),
        ("always ((count == 3) implies (t >= 3.0))", True),
        ("always ((count == 3) implies (t >= 3.5))", False),
        ("eventually (rise(count >= 3))", True),
        ("eventually (fall(t > 0))", False),
        ("always (nowhere == nowhere)", True),
    ],
)
def test_a_comparison_with_nothing_to_spare_is_still_true_or_false(formula, passed):
    assert verdict(formula).passed is passed


@pytest.mark.parametrize(
    "formula",
    [
        "always (unknown > 0)",
        "always (not (unknown > 0))",
        "not (unknown > 0)",
        "eventually (unknown > 0)",
        "always ((unknown > 0) implies (t < 0))",
        "always ((t > 0) iff (unknown > 0))",
        "always (late > 0)",
    ],
)
def test_a_verdict_that_hangs_on_nan_fails_and_says_so(formula):
    found = verdict(formula)
    assert not found.passed
    assert np.isnan(found.robustness)
    some = "late is not a number (NaN) in 5 of 100 rows, first at t = 0.05 s"
    none = "unknown is unknown in this run: not a number (NaN) in any row"
    assert found.reason == (some if "late" in formula else none)


@pytest.mark.parametrize(
    ("formula", "passed"),
    [
        ("always ((unknown > 0) or (zero == 0))", True),
        ("always[0.3s:5s] (late > 0)", True),
        ("always (late > 1.0)", False),
        ("eventually (late > 4.0)", True),
    ],
)
def test_nan_beside_the_point_changes_nothing(formula, passed):
    found = verdict(formula)
    assert found.passed is passed
    assert found.reason is None


def test_a_violation_beside_nan_is_dated_where_it_is_certain():
    assert verdict("always (late > 1.0)").violated_at == pytest.approx(0.3)
    assert verdict("always (late > 0.2)").violated_at == pytest.approx(0.05)


def test_arithmetic_without_a_result_fails_and_says_so():
    assert "no number" in verdict("always (sqrt(zero - 1) >= 0)").reason
    assert not verdict("always (zero / zero >= 0)").passed


def test_beyond_the_end_nothing_is_held_against_always_and_nothing_counts_for_eventually():
    assert verdict("always[0:40s] (zero == 0)").passed
    assert not verdict("eventually[0:40s] (zero == 1)").passed
    assert verdict("eventually[0:40s] (t >= 4.0)").passed
    assert verdict("always ((t >= 4.9) implies always[0:3s] (zero == 0))").passed


@pytest.mark.parametrize(
    "formula",
    ["always[40s:50s] (zero > 1)", "(zero == 0) and always[5s:6s] (zero == 0)"],
)
def test_what_looks_only_beyond_the_end_fails(formula):
    found = verdict(formula)
    assert not found.passed
    assert "the run ended at 5 s" in found.reason


def test_a_trace_of_one_row_is_judged_and_an_empty_one_fails():
    assert verdict("always (x > 0)", {"x": np.ones(1)}).passed
    assert verdict("always (x > 0)", {"x": np.ones(0)}).reason == "nothing was recorded"


def test_without_times_they_are_counted_in_periods():
    assert verdict("always (x > 0)", {"x": np.array([1.0, 1.0, -1.0])}).violated_at == (
        pytest.approx(0.15)
    )


def test_every_column_of_a_trace_can_be_used():
    for column in UNITS:
        assert syntax_error(f"always ({column} >= -0.5)", UNITS, PERIOD) is None


@pytest.mark.parametrize(
    ("formula", "words"),
    [
        ("always (x >", "ends too early"),
        ("", "ends too early"),
        ("always (x > 0))", "')' at character 15 cannot stand there"),
        ("x # 3", "'#' at character 3 cannot stand there"),
        ("always (clearence > 0)", "did you mean 'clearance'?"),
        ("x/2 > 3", "put spaces around /"),
        ("x = 3", "write == to compare"),
        ("-x > 3", "write (0 - x)"),
        ("always x", "x is a number; compare it, such as x >= 0"),
        ("0 <= x <= 1", "(0 <= x) and (x <= 1)"),
        ("always (x > 0) y > 0", "join them with and"),
        ("always[5:2] (x > 0)", "must rise from 0 s on"),
        ("always[-1:2] (x > 0)", "must rise from 0 s on"),
        ("always[0:0.33] (x > 0)", "0.33 s is not a whole number of control periods of 0.05 s"),
        ("allways[0:1s] (x > 0)", "unknown operator 'allways'; did you mean 'always'?"),
        ("not (sometimes (x > 0))", "unknown operator 'sometimes'; known: always, eventually,"),
    ],
)
def test_a_broken_formula_is_explained_in_one_line(formula, words, capfd):
    message = syntax_error(formula, UNITS, PERIOD)
    assert words in message
    assert "\n" not in message
    with pytest.raises(InputError, match=r"expect\.it = "):
        judge({"it": formula}, dict.fromkeys(UNITS, T), PERIOD)
    assert capfd.readouterr() == ("", "")  # the parser generator would print


@pytest.mark.parametrize("bounds", ["[0:1s]", "[0s:1]", "[0:1000ms]", "[0,1]", "[0s,1000ms]"])
def test_bounds_may_be_written_in_many_ways(bounds):
    assert verdict(f"eventually{bounds} (t >= 1.05)").passed
    assert not verdict(f"eventually{bounds} (t >= 1.06)").passed
