"""The check of front ends finds each fault, and names it with its cure."""

import numpy as np
import pytest

from cowalk.estimation import FRONT_ENDS, check_front_end
from cowalk.estimation.checks.front_ends import front_end_problems
from cowalk.sim import InputError


class Good:
    """A low-pass filter of first order; each class below breaks it in one way."""

    time = 0.1
    delay = time

    def reset(self, rates):
        self.share = 1.0 - np.exp(-1.0 / (self.time * rates.sensor))
        self.value = None

    def update(self, wrench, valid):
        out = np.empty_like(wrench)
        value = wrench[0] if self.value is None else self.value
        for row, sample in enumerate(wrench):
            value = value + self.share * (sample - value)
            out[row] = value
        self.value = value
        return out


class ValidForgotten(Good):
    def update(self, wrench):
        return wrench


class ForceAlone(Good):
    def update(self, wrench, valid):
        return super().update(wrench, valid)[:, :2]


class MeanAlone(Good):
    def update(self, wrench, valid):
        return wrench.mean(axis=0)


class TwelveSamples(Good):
    def update(self, wrench, valid):
        return np.ones((12, 1)) * super().update(wrench, valid).mean(axis=0)


class TwelveRows(Good):
    def update(self, wrench, valid):
        return wrench - wrench[11] + super().update(wrench, valid)[11]


class DividesByValid(Good):
    def update(self, wrench, valid):
        mean = (wrench * valid[:, None]).sum(axis=0) / valid.sum()
        return np.tile(mean, (len(wrench), 1))


class Unstable(Good):
    def reset(self, rates):
        super().reset(rates)
        self.share = 2.1


class TooMuch(Good):
    def update(self, wrench, valid):
        return 1.1 * super().update(wrench, valid)


class SlowStarter(Good):
    """It comes to the constant, but not before most runs are over."""

    time = 10.0

    def reset(self, rates):
        super().reset(rates)
        self.value = np.zeros(6)


class MixedUp(Good):
    def update(self, wrench, valid):
        return super().update(wrench, valid)[:, [1, 0, 2, 3, 4, 5]]


class Silent(Good):
    passes_constant = False

    def update(self, wrench, valid):
        return np.zeros_like(wrench)


class Liar(Good):
    delay = 0.0


class OtherLiar(Good):
    delay = 0.6


class Unstated(Good):
    delay = None


class Early(Good):
    delay = -0.1


class NeverKnown(Good):
    delay = float("nan")


class DelayFails(Good):
    @property
    def delay(self):
        raise ZeroDivisionError("no rate yet")


class Scribbles(Good):
    def update(self, wrench, valid):
        wrench -= 0.5
        return super().update(wrench + 0.5, valid)


class ScribblesOnValid(Good):
    def update(self, wrench, valid):
        valid[:] = 1.0
        return super().update(wrench, valid)


class OneArray(Good):
    out = np.zeros((12, 6))

    def update(self, wrench, valid):
        out = self.out[: len(wrench)]
        out[:] = super().update(wrench, valid)
        return out


class Remembers(Good):
    def __init__(self):
        self.value = None

    def reset(self, rates):
        before = self.value
        super().reset(rates)
        self.value = before


class GlobalState(Good):
    def update(self, wrench, valid):
        np.random.seed(3)  # noqa: NPY002 - the fault that the check must find
        return super().update(wrench, valid)


CURE = "return the cleaned block, an array of the shape of wrench"
FAULTS = {
    ValidForgotten: r"cannot be called as update\(wrench, valid\): declare update\(self, wrench, v",
    ForceAlone: r"update with 12 samples a block returned an array of shape \(12, 2\): " + CURE,
    MeanAlone: r"returned an array of shape \(6,\): " + CURE,
    TwelveSamples: r"with 3 samples a block returned an array of shape \(12, 6\): " + CURE,
    TwelveRows: "update fails at block 0 with 3 samples a block: IndexError",
    DividesByValid: "not finite, though all samples were: do you divide by the number of valid",
    Unstable: "grows beyond ten times its input: is it stable?",
    TooMuch: "a constant -2 in channel 1 comes out as -2.2 after 30 s: pass it on with gain 1",
    SlowStarter: "comes out as .* after 30 s: pass it on with gain 1, after 20 s at the latest",
    MixedUp: "a constant -2 in channel 1 comes out as 3 after",
    Silent: r"a signal of 0\.3 Hz in channel 0 does not come out: pass it on",
    Liar: r"delay says 0 s, a signal of 0\.3 Hz in channel \d comes 0\.0\d+ s later: state that",
    OtherLiar: r"delay says 0\.6 s, a signal of 0\.3 Hz in channel \d comes 0\.0\d+ s later",
    Unstated: "delay is None after reset: state by how many s a slow signal comes later",
    Early: "delay is -0.1 after reset: state by how many s",
    NeverKnown: "delay is nan after reset: state by how many s",
    DelayFails: "delay fails after reset: ZeroDivisionError: no rate yet",
    Scribbles: "update changes the wrench it is given: work on a copy",
    ScribblesOnValid: "update changes valid: work on a copy",
    OneArray: "update changes an array that it returned before: return a fresh one",
    Remembers: "two streams after equal resets differ from step 0 on: set all state in reset",
    GlobalState: "touches the global random state",
}


@pytest.mark.parametrize("faulty", list(FAULTS), ids=lambda item: item.__name__)
@pytest.mark.filterwarnings("ignore:invalid value", "ignore:overflow")
def test_a_fault_is_named_with_its_cure(faulty):
    with pytest.raises(InputError, match=f"^{faulty.__name__}: .*{FAULTS[faulty]}"):
        check_front_end(faulty)
    found = front_end_problems(faulty)
    assert "\n" not in " ".join(found)
    assert len(found) <= 3, "a fault is named once, not at every step"


def test_a_good_front_end_passes_as_class_and_as_instance():
    check_front_end(Good)
    check_front_end(Good())


def test_one_that_takes_out_a_bias_says_so():
    class Bias(Good):
        """What is slower than minutes is taken for the sensor's bias."""

        time, delay = 20.0, 0.0

        def update(self, wrench, valid):
            return wrench - super().update(wrench, valid)

    class SaysSo(Bias):
        passes_constant = False

    assert ["pass it on with gain 1" in fault for fault in front_end_problems(Bias)] == [True]
    check_front_end(SaysSo)


@pytest.mark.parametrize("name", FRONT_ENDS.names())
def test_every_front_end_that_ships_passes(name):
    assert front_end_problems(FRONT_ENDS.get(name)) == []
