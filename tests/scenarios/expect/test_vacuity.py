import numpy as np
import pytest

from cowalk.scenarios.expect.verdict import explain, judge

PERIOD = 0.05
T = (np.arange(100) + 1) * PERIOD
COLUMNS = {"t": T, "x": T - 2.0, "late": np.where(T < 0.29, np.nan, T)}


def verdict(formula):
    (found,) = judge({"it": formula}, COLUMNS, PERIOD)
    assert found.passed
    return found


@pytest.mark.parametrize(
    ("formula", "part"),
    [
        ("always ((t > 99) implies (x > 0))", "x > 0 never did: t > 99 never holds"),
        ("(x > 0) implies (x > 99)", "x > 99 never did"),
        ("eventually ((t > 2) implies (x > 99))", "x > 99 never did"),
        ("always ((t > 1) implies ((t < 1) implies (x > 99)))", "x > 99 never did"),
        ("always ((t > 1) implies eventually ((t > 99) implies (x > 0)))", "x > 0 never did"),
        ("eventually (always[1s:2s] (x > 99))", "x > 99 never did"),
        ("historically[1s:2s] (x > 99)", "x > 99 never did"),
        ("prev (x > 99)", "x > 99 never did"),
        ("always ((t >= 4.9) implies always[1s:2s] (x > 99))", "x > 99 never did"),
        ("not (always (eventually[1s:2s] (x > -99)))", "x > -99 always did"),
        ("(x > 99) until (t > 0)", "x > 99 never did"),
        ("(x > 99) until[0:1s] (t > 0)", "x > 99 never did"),
        ("(x > 99) unless (t > 0)", "x > 99 never did"),
        ("(x > 99) unless[0:1s] (t > 0)", "x > 99 never did"),
        ("(x > 99) since (t > 0)", "x > 99 never did"),
        ("always (t > 0) and always ((t > 99) implies (x > 0))", "x > 0 never did"),
    ],
)
def test_what_asks_nothing_of_the_run_holds_vacuously(formula, part):
    found = verdict(formula)
    assert found.vacuous.startswith(f"it would hold even if {part}")
    assert f", vacuously: {found.vacuous}" in explain(found)


@pytest.mark.parametrize(
    "formula",
    [
        "always (x > -3)",
        "always ((t > 3) implies (x > 0))",
        "always[1s:40s] (x > -3)",
        "eventually (x > 2)",
        "eventually ((t > 2) and (x > 0))",
        "not eventually (x > 99)",
        "(x < 0) until (t >= 2)",
        "(x < 0) unless (t >= 2)",
        "(x < 9) unless[1s:2s] (t > 99)",
        "next (x < 0)",
        "always ((x > -3) or (t > 99))",
        "always ((t > 99) iff (x > 99))",
        "always ((t > 99) implies (x > 0)) or always (x > -3)",
    ],
)
def test_what_asks_something_of_the_run_does_not(formula):
    assert verdict(formula).vacuous is None


def test_a_premise_of_which_something_is_unknown_is_not_said_never_to_hold():
    found = verdict("eventually ((late > 9) implies (x > 99))")
    assert found.vacuous == "it would hold even if x > 99 never did"


def test_what_fails_is_not_called_vacuous():
    (found,) = judge({"it": "always ((t > 1) implies (x > 99))"}, COLUMNS, PERIOD)
    assert not found.passed
    assert found.vacuous is None
