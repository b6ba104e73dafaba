"""The checks shipped for users' classes: each fault is found, and named with its cure."""

import numpy as np
import pytest

from cowalk.agents import (
    AUTOMATIONS,
    HUMANS,
    Belief,
    Truth,
    check_automation,
    check_human,
)
from cowalk.agents.checks import automation_problems, human_problems
from cowalk.sim.errors import InputError


class Good:
    """A human in a few lines; each class below breaks it in one way."""

    def reset(self, rng, situation):
        self.rng = rng

    def act(self, observation):
        self.twist = observation["twist"]
        return np.array([0.0, -4.0 * self.twist[1] + 0.1 * self.rng.standard_normal()])

    def truth(self):
        return Truth(np.array([0.8, 0.0]), np.array([0.0, 0.5]))


class NoTruth:
    def reset(self, rng, situation): ...

    def act(self, observation): ...


class AsList(Good):
    def act(self, observation):
        return [0.0, 1.0]


class ThreeForces(Good):
    def act(self, observation):
        return np.zeros(3)


class DividesByZero(Good):
    def act(self, observation):
        return np.array([0.0, np.nan])


class Millinewtons(Good):
    def act(self, observation):
        return 1e3 * super().act(observation)


class OddKey(Good):
    def act(self, observation):
        return observation["velocity"]


class Remembers(Good):
    count = 0

    def act(self, observation):
        self.count += 1
        return super().act(observation) + 1e-3 * self.count


class OwnGenerator(Good):
    def act(self, observation):
        return super().act(observation) + 1e-3 * np.random.default_rng().random()


class GlobalState(Good):
    def act(self, observation):
        np.random.seed(3)  # noqa: NPY002 - the fault that the check must find
        return super().act(observation) + 1e-3 * np.random.random()  # noqa: NPY002


class Deaf(Good):
    def act(self, observation):
        return np.array([0.0, 2.0])


class Modest(Good):
    closed_loop = False


class Stubborn(Good):
    def truth(self):
        return Truth(np.array([0.8, 0.0]), np.array([0.0, 1.5]))


class Degrees(Good):
    def truth(self):
        return Truth(np.array([0.8, 20.0]), np.array([0.0, 0.5]))


class PlainTruth(Good):
    def truth(self):
        return (0.8, 0.0), (0.0, 0.5)


class Scribbles(Good):
    def act(self, observation):
        observation["twist"] *= 0.5
        return super().act(observation)


class OneArray(Good):
    force = np.zeros(2)

    def act(self, observation):
        self.force[:] = super().act(observation)
        return self.force


class NeedsArguments(Good):
    def __init__(self, strength):
        self.strength = strength


class AnswersForceAlone(Good):
    def act(self, observation):
        return -0.5 * observation["force"].mean(axis=0)


class AsText(Good):
    def act(self, observation):
        return np.array(["0.0", "1.0"])


class AsObjects(Good):
    def act(self, observation):
        return np.array([0.0, None])


class ListsInTruth(Good):
    def truth(self):
        return Truth([0.8, 0.0], [0.0, 0.5])


class TextInTruth(Good):
    def truth(self):
        return Truth(np.array([0.8, 0.0]), "0.5")


class ObjectsInTruth(Good):
    def truth(self):
        return Truth(np.array([0.8, None]), np.array([0.0, 0.5]))


class OneShare(Good):
    def truth(self):
        return Truth(np.array([0.8, 0.0]), np.array([0.5]))


PAIR = r"return np\.array\(\[a, b\]\), one number for v, one for omega"
FORCE = r"return the hand force on the base in N, np\.array\(\[fx, fy\]\)"
FAULTS = {
    AnswersForceAlone: "the same however the base moves: use the observation's twist or pose",
    AsText: "act returned an array of <U3 instead of numbers: " + FORCE,
    AsObjects: "act returned an array of object instead of numbers: " + FORCE,
    ListsInTruth: r"truth\(\).wish is \[0.8, 0.0\], no NumPy array: " + PAIR,
    TextInTruth: r"truth\(\).stubbornness is '0.5', no NumPy array: " + PAIR,
    ObjectsInTruth: r"truth\(\).wish is an array of object instead of numbers: " + PAIR,
    OneShare: r"truth\(\).stubbornness is an array of shape \(1,\): " + PAIR,
    NoTruth: "there is no method 'truth': add truth",
    AsList: r"act returned \[0.0, 1.0\], no NumPy array: " + FORCE,
    ThreeForces: r"act returned an array of shape \(3,\): " + FORCE,
    DividesByZero: "must be finite",
    Millinewtons: "more than 100 N",
    OddKey: "act fails at step 0: KeyError.*has the keys twist, force",
    Remembers: "differ from step 0 on: set all state in reset",
    OwnGenerator: "draw only from the rng",
    GlobalState: "touches the global random state",
    Deaf: "closed_loop = False in the class",
    Modest: "yet its force answers the base",
    Stubborn: r"leaves \[0, 1\]",
    Degrees: "rad/s",
    PlainTruth: r"return Truth\(wish=",
    Scribbles: r"act changes observation\['twist'\]",
    OneArray: "return a fresh one",
    NeedsArguments: "check an instance of it",
}


@pytest.mark.parametrize("faulty", list(FAULTS), ids=lambda item: item.__name__)
def test_a_fault_is_named_with_its_cure(faulty):
    state = np.random.get_state()  # noqa: NPY002 - one of the classes changes it
    with pytest.raises(InputError, match=f"^{faulty.__name__}: .*{FAULTS[faulty]}"):
        check_human(faulty)
    np.random.set_state(state)  # noqa: NPY002
    assert "\n" not in " ".join(human_problems(faulty))


def test_a_good_human_passes_as_class_and_as_instance():
    check_human(Good)
    check_human(Good())


def test_all_faults_are_listed_at_once():
    class Both(Stubborn, Millinewtons):
        pass

    assert len(human_problems(Both())) == 2


@pytest.mark.parametrize("name", HUMANS.names())
def test_every_human_that_ships_passes(name, new_human):
    assert human_problems(new_human(name)) == []


class Follower:
    """An automation that goes where it is pushed."""

    def reset(self, rng, situation):
        self.situation = situation

    def act(self, observation):
        push = observation["force"].mean(axis=0)
        bounds = self.situation.bounds
        return np.clip([0.8, 0.1 * push[1]], bounds.lower, bounds.upper)

    def belief(self):
        return Belief()


class Unbounded(Follower):
    def act(self, observation):
        return 10.0 * super().act(observation)


class Certain(Follower):
    def belief(self):
        return Belief(target_utility=1.4)


class Blind(Follower):
    def act(self, observation):
        return np.array([0.8, 0.0])


class AsTuple(Follower):
    def act(self, observation):
        return 0.8, 0.0


class TextBelief(Follower):
    def belief(self):
        return Belief(utility_loss="none")


class ListBelief(Follower):
    def belief(self):
        return Belief(wish=[0.8, 0.0])


class PairBelief(Follower):
    def belief(self):
        return Belief(interaction=np.array([1.0, 2.0]))


class NoBelief(Follower):
    def belief(self):
        return None


@pytest.mark.parametrize(
    ("faulty", "message"),
    [
        (Unbounded, "clip to situation.bounds"),
        (Certain, r"target_utility leaves \[0, 1\]"),
        (Blind, "its twist is the same however the base moves and is pushed"),
        (AsTuple, r"act returned \(0.8, 0.0\), no NumPy array: return the twist .* np.array\("),
        (TextBelief, r"belief\(\).utility_loss is 'none': return one number, NaN for no opinion"),
        (ListBelief, r"belief\(\).wish is \[0.8, 0.0\], no NumPy array: " + PAIR),
        (PairBelief, r"belief\(\).interaction is array\(\[1., 2.\]\): return one number"),
        (NoBelief, r"belief returned None: return Belief\(\), NaN where"),
    ],
)
def test_a_faulty_automation_is_told_the_cure(faulty, message):
    with pytest.raises(InputError, match=message):
        check_automation(faulty)


def test_a_good_automation_passes():
    check_automation(Follower)


@pytest.mark.parametrize("name", AUTOMATIONS.names())
def test_every_automation_that_ships_passes(name):
    assert automation_problems(AUTOMATIONS.get(name)()) == []
