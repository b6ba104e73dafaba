"""The checks shipped for users' classes: each fault is found, and named with its cure."""

import numpy as np
import pytest

from cowalk.agents import (
    AUTOMATIONS,
    HUMANS,
    Agreement,
    Belief,
    Strategy,
    Truth,
    check_automation,
    check_human,
)
from cowalk.agents.checks.conformance import automation_problems, human_problems
from cowalk.agents.checks.walk import observations
from cowalk.estimation import Estimate
from cowalk.sim.basics.errors import InputError


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
        return np.array([observation["twist"][0], np.nan])


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


class Lawful(Good):
    """Pushes by the common definition, and says so."""

    share = 0.3

    def act(self, observation):
        missing = (np.array([0.8, 0.0]) - observation["twist"]) / (1.2, 0.5)
        return 7.5 * np.clip(2.0 * 0.3 * missing, -1.0, 1.0)

    def truth(self):
        strength, shares = np.array([7.5, 7.5]), np.full(2, self.share)
        return Truth(np.array([0.8, 0.0]), shares, strength, 2.0)


class Liar(Lawful):
    share = 0.9


class NegativeDelay(Good):
    def truth(self):
        return Truth(np.array([0.8, 0.0]), np.array([0.0, 0.5]), delay=-0.1)


class TwoGains(Good):
    def truth(self):
        return Truth(np.array([0.8, 0.0]), np.array([0.0, 0.5]), gain=np.ones(2))


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


class Whispers(Good):
    def act(self, observation):
        self.twist = observation["twist"]
        return np.array([0.0, 2.0 + 1e-12 * self.twist[1]])


class DividesAtRest(Good):
    def act(self, observation):
        super().act(observation)
        return np.array([0.0, 0.1 / float(self.twist[0])])


class NeedsObstacles(Good):
    def act(self, observation):
        present = observation["obstacles"][:, 0] == 1.0
        return super().act(observation) * observation["obstacles"][present, 1].min() / 10.0


class AveragesValidSamples(Good):
    def act(self, observation):
        count = int(observation["force_valid"].sum())
        return super().act(observation) + 0.01 * observation["force"].sum() * (1 / count)


class CountsResets(Good):
    resets = 0

    def reset(self, rng, situation):
        super().reset(rng, situation)
        self.resets += 1

    def act(self, observation):
        return super().act(observation) * (1.0 if self.resets < 4 else 2.0)


class Kilonewtons(Good):
    def act(self, observation):
        return 1e-3 * super().act(observation)


class AlwaysTheSame(Good):
    def reset(self, rng, situation):
        self.rng = np.random.default_rng(3)


class ResetAlone(Good):
    def reset(self): ...


class ActAlone(Good):
    def act(self):
        return np.zeros(2)


class ByAttribute(Good):
    def act(self, observation):
        return -observation.twist


class TwoLines(Good):
    def act(self, observation):
        raise ValueError("one thing\nand another")


class Leaves(Good):
    def act(self, observation):
        raise SystemExit(1)


class LeavesAtOnce(Good):
    def __init__(self):
        raise SystemExit("no\nlicence")


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
    DividesByZero: "act returned a force that is not finite: every one must be",
    Millinewtons: "more than 100 N",
    OddKey: "act fails at step 0: KeyError.*has the keys twist, force",
    Remembers: "differ from step 0 on: set all state in reset",
    OwnGenerator: "draw only from the rng",
    GlobalState: "touches the global random state",
    Deaf: "closed_loop = False in the class",
    Modest: "yet its force answers the base",
    Stubborn: r"leaves \[0, 1\]",
    Degrees: r"leaves the situation's bounds, here \[0.0, -0.5\] to \[1.2, 0.5\] .*; clip it",
    Liar: r"pushes forward with 0.33 times what truth\(\) stands for, .*: say the stubbornness",
    NegativeDelay: r"truth\(\).delay is not 0 s or more",
    TwoGains: r"truth\(\).gain is .*: return one number",
    PlainTruth: r"return Truth\(wish=",
    Scribbles: r"act changes observation\['twist'\]",
    OneArray: "return a fresh one",
    NeedsArguments: "check an instance of it",
    Whispers: "the same however the base moves",
    DividesAtRest: "act fails at step 0: ZeroDivisionError",
    NeedsObstacles: "act fails at step 0: ValueError: zero-size",
    AveragesValidSamples: "act fails at step 60: ZeroDivisionError",
    CountsResets: "two walks after resets with equal generators differ",
    Kilonewtons: r"at most 0.0012 N, too faint .* return N; is it in kN\?",
    AlwaysTheSame: "the generator self.rng starts alike whatever rng reset is given",
    ResetAlone: r"cannot be called as reset\(rng, situation\): declare reset\(self, rng, sit",
    ActAlone: r"declare act\(self, observation\), to return the hand force",
    ByAttribute: r'an observation is a dict: observation\["twist"\]',
    TwoLines: "act fails at step 0: ValueError: one thing and another$",
    Leaves: "act fails at step 0: SystemExit: 1$",
    LeavesAtOnce: r"cannot be built without arguments \(SystemExit: no licence\)",
}


@pytest.mark.parametrize("faulty", list(FAULTS), ids=lambda item: item.__name__)
def test_a_fault_is_named_with_its_cure(faulty):
    with pytest.raises(InputError, match=f"^{faulty.__name__}: .*{FAULTS[faulty]}"):
        check_human(faulty)
    found = human_problems(faulty)
    assert "\n" not in " ".join(found)
    assert len(found) <= 3, "a fault is named once, not at every step"


def test_a_human_who_states_what_is_behind_the_force_passes():
    assert human_problems(Lawful) == []


def test_nobody_needs_to_know_what_a_force_is_for():
    class Unknown(Good):
        def truth(self):
            return Truth(np.full(2, np.nan), np.full(2, np.nan))

    assert human_problems(Unknown) == []


def test_a_force_that_is_not_finite_is_one_fault():
    assert len(human_problems(DividesByZero)) == 1


def test_a_kept_generator_may_start_alike_if_nothing_is_drawn_from_it():
    class KeepsOne(Good):
        def __init__(self):
            self.layout = np.random.default_rng(3)

    assert human_problems(KeepsOne) == []


def test_the_made_up_walk_has_what_a_run_has():
    walk = list(observations(1.0, 1.0))
    start = walk[0]
    assert not any(start[key].any() for key in ("twist", "pose", "pose_world", "time", "force"))
    speeds = np.array([seen["twist"][0] for seen in walk])
    assert (speeds[100:112] == 0.0).all()
    assert speeds[112:].min() > 0.0
    assert {int(seen["obstacles"][:, 0].sum()) for seen in walk} == {0, 1, 4}
    assert {int(seen["force_valid"].sum()) for seen in walk} == {12, 9, 0}


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


class NoTwist(Follower):
    def act(self, observation):
        return super().act(observation) / np.array([1.0, np.nan])


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
        (NoTwist, "^NoTwist: act returned a twist that is not finite: every one must be$"),
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


class Conceding(Strategy):
    """A strategy in a few lines; each class below breaks it in one way."""

    columns = {"patience": "1"}  # noqa: RUF012 - as a user writes it

    def __init__(self, share: float = 0.5, **parts):
        super().__init__(**parts)
        self.share = share

    def agree(self, negotiation):
        twist = self.share * negotiation.own + (1.0 - self.share) * negotiation.human
        return Agreement(twist, extras={"patience": self.share})


class Abstract(Strategy):
    pass


class NoDecision(Conceding):
    def agree(self, negotiation):
        return negotiation.own


class Undeclared(Conceding):
    columns = {}  # noqa: RUF012


class ManyExtras(Conceding):
    def agree(self, negotiation):
        return Agreement(negotiation.human, extras={"patience": negotiation.own})


class TextForColumns(Follower):
    columns = "patience"


class Scribbler(Conceding):
    def agree(self, negotiation):
        negotiation.own[1] += 0.01
        return super().agree(negotiation)


class ScribblesOnTheEstimate(Conceding):
    def agree(self, negotiation):
        negotiation.estimate.stubbornness[:] = 0.0
        return super().agree(negotiation)


class Alone(Conceding):
    def __init__(self, share: float = 0.5):
        super().__init__(share)


class Negative(Follower):
    def belief(self):
        return Belief(human_wish_deviation=np.array([-0.1, 0.1]))


class OneDeviation(Follower):
    def belief(self):
        return Belief(stubbornness_deviation=0.1)


class ExtraBelief(Follower):
    def belief(self):
        return Belief(extras={"mood": 0.5})


@pytest.mark.parametrize(
    ("faulty", "message"),
    [
        (Abstract, r"there is no method 'agree': add agree\(self, negotiation\)"),
        (NoDecision, "act fails at step 0: agree.. gave an array of .*; it must be an Agreement"),
        (Undeclared, r"belief\(\).extras has 'patience', columns declares nothing: add it there"),
        (ManyExtras, r"belief\(\).extras\['patience'\] is array\(.*: give one number"),
        (TextForColumns, r"columns is 'patience': give units by name, \{'urgency': '1'\}"),
        (Scribbler, "agree changes negotiation.own: work on a copy"),
        (ScribblesOnTheEstimate, "agree changes negotiation.estimate.stubbornness: work on a copy"),
        (Alone, "does not take negotiation, front_end, observer, smoother, .* no effect: declare"),
        (Negative, r"belief\(\).human_wish_deviation is below 0: give a standard deviation"),
        (OneDeviation, r"belief\(\).stubbornness_deviation is 0.1, no NumPy array: " + PAIR),
        (ExtraBelief, r"belief\(\).extras has 'mood', columns declares nothing: add it there"),
    ],
)
def test_a_faulty_strategy_or_belief_is_told_the_cure(faulty, message):
    with pytest.raises(InputError, match=message):
        check_automation(faulty)


def test_a_good_strategy_passes_and_is_left_as_it_was():
    strategy = Conceding()
    check_automation(strategy)
    assert "agree" not in vars(strategy)
    check_automation(Conceding)


def test_a_strategy_adds_what_its_observer_adds(monkeypatch):
    class Counting:
        columns = {"heard": "1"}  # noqa: RUF012

        def reset(self, situation, reading, rng):
            self.heard = 0

        def update(self, sample, own_wish):
            self.heard += 1
            wish = np.clip(own_wish + 0.1 * sample.force.mean(axis=0), (0.0, -0.5), (1.2, 0.5))
            return Estimate(np.zeros(2), wish, extras={"heard": self.heard})

    check_automation(Conceding(observer=Counting()))
