"""The check of observers finds each fault, and names it with its cure."""

import numpy as np
import pytest

from cowalk.estimation import OBSERVERS, Estimate, check_observer
from cowalk.estimation.checks.observers import observer_problems
from cowalk.sim import InputError


class Good:
    """Stubborn is who pushes; each class below breaks it in one way."""

    columns = {"heard": "N"}  # noqa: RUF012 - as a user writes it

    def reset(self, situation, reading, rng):
        self.rng, self.full, self.bounds = rng, reading.force_max, situation.bounds

    def update(self, sample, own_wish):
        force = sample.force.mean(axis=0) + 0.01 * self.rng.standard_normal()
        share = np.clip(np.abs(force) / self.full, 0.0, 1.0)
        wish = np.clip(sample.twist + 0.1 * force, self.bounds.lower, self.bounds.upper)
        deviation = np.full(2, 0.1)
        return Estimate(share, wish, deviation, extras={"heard": float(force[1])})


def but(estimate, **changed):
    """Return an estimate with some of its fields changed."""
    names = ("stubbornness", "wish", "stubbornness_deviation", "wish_deviation", "extras")
    return Estimate(**({name: getattr(estimate, name) for name in names} | changed))


class Changed(Good):
    def changes(self, estimate):
        return {}

    def update(self, sample, own_wish):
        estimate = super().update(sample, own_wish)
        return but(estimate, **self.changes(estimate))


class OldReset(Good):
    def reset(self, situation):
        self.situation = situation


class AsTuple(Good):
    def update(self, sample, own_wish):
        return np.zeros(2), own_wish


class Lists(Changed):
    def changes(self, estimate):
        return {"stubbornness": [0.0, 0.5]}


class OneShare(Changed):
    def changes(self, estimate):
        return {"stubbornness": np.array([0.5])}


class NoWishYet(Changed):
    def changes(self, estimate):
        return {"wish": np.full(2, np.nan)}


class TooStubborn(Changed):
    def changes(self, estimate):
        return {"stubbornness": 1.5 * estimate.stubbornness}


class TooFast(Changed):
    def changes(self, estimate):
        return {"wish": estimate.wish + 0.3}


class NegativeDeviation(Changed):
    def changes(self, estimate):
        return {"wish_deviation": np.array([0.1, -0.1])}


class InfiniteDeviation(Changed):
    def changes(self, estimate):
        return {"stubbornness_deviation": np.full(2, np.inf)}


class Undeclared(Changed):
    def changes(self, estimate):
        return {"extras": {**estimate.extras, "mood": 0.5}}


class Lacking(Changed):
    def changes(self, estimate):
        return {"extras": {}}


class ManyNumbers(Changed):
    def changes(self, estimate):
        return {"extras": {"heard": np.full(2, estimate.stubbornness[1])}}


class NoUnits(Good):
    columns = ("heard",)


class NumberForUnit(Good):
    columns = {"heard": 1}  # noqa: RUF012


class Deaf(Good):
    def update(self, sample, own_wish):
        return Estimate(np.full(2, 0.5), own_wish, extras={"heard": 0.0})


class Modest(Good):
    reads_force = False


class TwelveSamples(Good):
    def update(self, sample, own_wish):
        sample.force[11]
        return super().update(sample, own_wish)


class DividesByValid(Good):
    def update(self, sample, own_wish):
        1 / int(sample.valid.sum())
        return super().update(sample, own_wish)


class Scribbles(Good):
    def update(self, sample, own_wish):
        sample.wrench[:] *= 0.5
        return super().update(sample, own_wish)


class ScribblesOnTheWish(Good):
    def update(self, sample, own_wish):
        own_wish += 0.01
        return super().update(sample, own_wish)


class OneArray(Good):
    def reset(self, situation, reading, rng):
        super().reset(situation, reading, rng)
        self.share = np.zeros(2)

    def update(self, sample, own_wish):
        estimate = super().update(sample, own_wish)
        self.share[:] = estimate.stubbornness
        return but(estimate, stubbornness=self.share)


class Remembers(Good):
    last = 0.0

    def update(self, sample, own_wish):
        estimate = super().update(sample, own_wish)
        self.last = 0.99 * self.last + 0.01 * estimate.stubbornness
        return but(estimate, stubbornness=self.last)


class AlwaysTheSame(Good):
    def reset(self, situation, reading, rng):
        super().reset(situation, reading, np.random.default_rng(3))


class OwnGenerator(Good):
    def update(self, sample, own_wish):
        self.rng = np.random.default_rng()
        return super().update(sample, own_wish)


class GlobalState(Good):
    def update(self, sample, own_wish):
        np.random.seed(3)  # noqa: NPY002 - the fault that the check must find
        return super().update(sample, own_wish)


class HalfAPosterior:
    def quantile(self, share):
        return np.zeros(2), np.zeros(2)


class FlatPosterior(HalfAPosterior):
    def sample(self, rng, count):
        return np.zeros(count), np.zeros(count)


class WithHalf(Good):
    posterior = HalfAPosterior

    def update(self, sample, own_wish):
        estimate = super().update(sample, own_wish)
        return but(estimate, posterior=self.posterior())


class WithFlat(WithHalf):
    posterior = FlatPosterior


PAIR = r"return np\.array\(\[a, b\]\), one number for v, one for omega"
FAULTS = {
    OldReset: r"cannot be called as reset\(situation, reading, rng\): declare reset\(self, situ",
    AsTuple: r"update returned \(array.*\): return Estimate\(stubbornness=np.array\(",
    Lists: r"Estimate.stubbornness is \[0.0, 0.5\], no NumPy array: " + PAIR,
    OneShare: r"Estimate.stubbornness is an array of shape \(1,\): " + PAIR,
    NoWishYet: "Estimate.wish is not finite: give the best there is from the first step on",
    TooStubborn: r"Estimate.stubbornness leaves \[0, 1\]: clip",
    TooFast: "Estimate.wish leaves the situation's bounds: clip to situation.bounds.lower",
    NegativeDeviation: r"wish_deviation is negative or infinite: give a standard deviation, or NaN",
    InfiniteDeviation: "stubbornness_deviation is negative or infinite: give a standard deviation",
    Undeclared: "extras has 'mood', columns declares heard: add it there with its unit",
    Lacking: "columns declares 'heard', Estimate.extras lacks it: give a number, or NaN",
    ManyNumbers: r"Estimate.extras\['heard'\] is array\(.*\): give one number",
    NoUnits: r"columns is \('heard',\): give units by name, \{'urgency': '1'\}",
    NumberForUnit: "columns has 'heard': 1; give a name and its unit",
    Deaf: "the same however hard the human pushes: use sample.wrench, or say reads_force = False",
    Modest: "it says reads_force = False, yet its estimate answers the force: leave that out",
    TwelveSamples: "update fails at step 0 with 3 samples a step: IndexError",
    DividesByValid: "update fails at step 60 with 12 samples a step: ZeroDivisionError",
    Scribbles: "update changes sample.wrench: work on a copy",
    ScribblesOnTheWish: "update changes own_wish: work on a copy",
    OneArray: "update changes an array that it returned before: return a fresh one",
    Remembers: "two walks after resets with equal generators differ from step 0 on",
    AlwaysTheSame: "self.rng starts alike whatever rng reset is given, so that every seed gives",
    OwnGenerator: "differ from step 0 on: set all state in reset, and draw only from the rng",
    GlobalState: "touches the global random state",
    WithHalf: "Estimate.posterior has no method 'sample': see Posterior, or leave it out",
    WithFlat: r"posterior.sample returned an array of shape \(3,\): return two arrays of shape \(3",
}


@pytest.mark.parametrize("faulty", list(FAULTS), ids=lambda item: item.__name__)
def test_a_fault_is_named_with_its_cure(faulty):
    with pytest.raises(InputError, match=f"^{faulty.__name__}: .*{FAULTS[faulty]}"):
        check_observer(faulty)
    found = observer_problems(faulty)
    assert "\n" not in " ".join(found)
    assert len(found) <= 2, "a fault is named once, not at every step"


def test_a_good_observer_passes_as_class_and_as_instance():
    check_observer(Good)
    check_observer(Good())


def test_an_estimate_may_be_held_and_the_force_ignored_if_it_says_so():
    class Held(Good):
        reads_force = False

        def reset(self, situation, reading, rng):
            self.held = Estimate(np.full(2, 0.5), np.zeros(2), extras={"heard": np.nan})

        def update(self, sample, own_wish):
            return self.held

    check_observer(Held)


@pytest.mark.parametrize("name", OBSERVERS.names())
def test_every_observer_that_ships_passes(name):
    assert observer_problems(OBSERVERS.get(name)) == []
