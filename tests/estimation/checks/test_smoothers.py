"""The check of smoothers finds each fault, and names it with its cure."""

import numpy as np
import pytest

from cowalk.estimation import SMOOTHERS, check_smoother
from cowalk.estimation.checks.smoothers import smoother_problems
from cowalk.sim import InputError, part


class Good:
    """Exponential smoothing in a few lines; each class below breaks it in one way."""

    share = 0.3

    def reset(self, initial):
        self.value = np.asarray(initial, dtype=float)

    def update(self, value):
        self.value = self.value + self.share * (np.asarray(value) - self.value)
        return self.value


class NoReset:
    def update(self, value):
        return value


class ResetAlone(Good):
    def reset(self):
        self.value = 0.0


class ScalarAlone(Good):
    def update(self, value):
        return float(super().update(value))


class AsList(Good):
    def update(self, value):
        return np.asarray(super().update(value)).tolist()


class AsArray(Good):
    def update(self, value):
        return np.atleast_1d(super().update(value))


class NotANumber(Good):
    def update(self, value):
        return super().update(value) / 0.0 * 0.0


class Unstable(Good):
    share = 2.5


class FromZero(Good):
    def reset(self, initial):
        super().reset(np.zeros_like(initial))


class Wrong(Good):
    """It is right after a reset, and never gets to where the values are."""

    def update(self, value):
        return 0.5 * super().update(value) + 0.5 * self.first

    def reset(self, initial):
        super().reset(initial)
        self.first = np.array(initial, dtype=float)


class Asleep(Good):
    share = 0.001


class Remembers(Good):
    count = 0

    def update(self, value):
        self.count += 1
        return super().update(value) + 1e-9 * self.count


class Scribbles(Good):
    def update(self, value):
        value *= 0.5
        return super().update(2.0 * value)


class ScribblesOnTheStart(Good):
    def reset(self, initial):
        super().reset(initial.copy())
        initial += 1.0


class OneArray(Good):
    def update(self, value):
        self.value += self.share * (np.asarray(value) - self.value)
        return self.value

    def reset(self, initial):
        self.value = np.array(initial, dtype=float)


class GlobalState(Good):
    def update(self, value):
        np.random.seed(3)  # noqa: NPY002 - the fault that the check must find
        return super().update(value)


class InTheClass(Good):
    values = {}  # noqa: RUF012 - the fault that the check must find

    def reset(self, initial):
        self.values["last"] = np.asarray(initial, dtype=float)

    def update(self, value):
        self.values["last"] = self.values["last"] + self.share * (value - self.values["last"])
        return self.values["last"]


class Uncopied(Good):
    def __deepcopy__(self, memo):
        raise TypeError("holds a file")


class Fails(Good):
    def update(self, value):
        raise ValueError("one thing\nand another")


class NeedsArguments(Good):
    def __init__(self, window):
        self.window = window


RETURN = "return the smoothed value, of the shape of what update is given"
FAULTS = {
    NoReset: r"there is no method 'reset': add reset\(self, initial\)",
    ResetAlone: r"cannot be called as reset\(initial\): declare reset\(self, initial\)",
    ScalarAlone: r"update fails at value 0 of shape \(2,\): TypeError",
    AsList: r"update returned \[.*\], no NumPy array: " + RETURN,
    AsArray: r"update returned array\(\[.*\]\) for one number: " + RETURN,
    NotANumber: "numbers that are not finite, though all values were",
    Unstable: "grows beyond ten times its input: is it stable?",
    FromZero: r"after reset\(0.7\), values of 0.7 come out as others: behave as if",
    Wrong: "200 values of 1 after a reset to 0 bring it to 0.5: it must follow",
    Asleep: "200 values of 1 after a reset to 0 bring it to 0.181: it must follow",
    Remembers: "two streams after equal resets differ from step 0 on: set all state in reset",
    Scribbles: "update changes the value it is given: work on a copy",
    ScribblesOnTheStart: "reset changes the initial value: work on a copy",
    OneArray: "update changes an array that it returned before: return a fresh one",
    GlobalState: "touches the global random state",
    InTheClass: "a copy of it changes it: keep state in the object, set in reset",
    Uncopied: "copy.deepcopy of it fails: TypeError: holds a file",
    Fails: r"update fails at value 0 of shape \(\): ValueError: one thing and another$",
    NeedsArguments: "check an instance of it",
}


@pytest.mark.parametrize("faulty", list(FAULTS), ids=lambda item: item.__name__)
@pytest.mark.filterwarnings("ignore:divide by zero", "ignore:invalid value", "ignore:overflow")
def test_a_fault_is_named_with_its_cure(faulty):
    with pytest.raises(InputError, match=f"^{faulty.__name__}: .*{FAULTS[faulty]}"):
        check_smoother(faulty)
    found = smoother_problems(faulty)
    assert "\n" not in " ".join(found)
    assert len(found) <= 3, "a fault is named once, not at every step"


def test_a_good_smoother_passes_as_class_as_instance_and_as_marked_function():
    @part("smoother")
    def built():
        return Good()

    for good in (Good, Good(), built):
        check_smoother(good)


def test_one_number_may_be_a_plain_one():
    class Plain(Good):
        def update(self, value):
            smoothed = super().update(value)
            return smoothed if smoothed.ndim else float(smoothed)

    check_smoother(Plain)


def test_all_faults_are_listed_at_once():
    class Both(FromZero, Scribbles):
        pass

    assert len(smoother_problems(Both)) == 2


@pytest.mark.parametrize("name", SMOOTHERS.names())
def test_every_smoother_that_ships_passes(name):
    assert smoother_problems(SMOOTHERS.get(name)) == []
