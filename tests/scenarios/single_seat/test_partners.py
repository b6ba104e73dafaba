"""Who sits in the other seat, and how often."""

from collections import Counter

import numpy as np
import pytest

from cowalk.agents.humans.escalating import EscalatingHuman
from cowalk.agents.humans.steady import SteadyHuman
from cowalk.scenarios import load
from cowalk.scenarios.people.population import Population


def names(env, episodes, seed=0):
    drawn = [env.reset(seed=seed)[1]["partner"]]
    return drawn + [env.reset()[1]["partner"] for _ in range(episodes - 1)]


@pytest.mark.parametrize("given", [None, "escalating"])
def test_the_scenarios_own_keeps_its_parameters(given, seat_of):
    env = seat_of("puddle", partner=given)
    env.reset(seed=0)
    assert isinstance(env.partner, EscalatingHuman)
    assert (env.partner.initial, env.partner.gain) == ((0.4, 0.4), 2.0)


def test_another_one_has_its_own_defaults_and_the_scenarios_intention(seat_of):
    env = seat_of("puddle", partner="steady")
    assert names(env, 1) == ["steady"]
    assert isinstance(env.partner, SteadyHuman)
    env = seat_of("puddle", seat="human", partner="never-yields")
    assert names(env, 1) == ["never-yields"]


def test_of_several_each_is_drawn_as_often_as_the_others_and_again_from_the_same_seed(seat_of):
    own = SteadyHuman()
    env = seat_of("walk", partner=["steady", "escalating", own])
    drawn = names(env, 300)
    counted = Counter(drawn)
    assert set(counted) == {"steady", "escalating", "SteadyHuman"}
    assert min(counted.values()) > 70
    assert drawn == names(env, 300)
    assert drawn != names(env, 300, seed=1)


def test_an_agent_is_copied_so_that_environments_can_share_it(seat_of):
    own = SteadyHuman(gain=1.3)
    one, other = (seat_of("walk", partner=own) for _ in range(2))
    one.reset(seed=0)
    other.reset(seed=0)
    assert one.partner is not other.partner
    assert one.partner.gain == 1.3


def test_a_person_of_a_population_is_drawn_for_every_episode(seat_of):
    env = seat_of("puddle", population="healthy-adults")
    drawn = names(env, 12)
    assert len(set(drawn)) > 1
    env.reset(seed=0)
    forces = []
    for _ in range(3):
        env.reset()
        for _ in range(5):
            env.step(np.zeros(2))
        forces.append(env.parallel.applied[0])
    assert len(set(forces)) == 3
    assert drawn == names(env, 12)


CALM = {"name": "steady", "intention": {"margin": 0.9}}


@pytest.mark.parametrize("human", [{"name": "steady"}, CALM], ids=["plain", "own intention"])
def test_people_go_where_the_scenario_says_in_their_own_way(human, seat_of):
    later = "human.intention.changes=[{at_time: 0.1, pace: 0.3}]"
    scenario = load("walk", ["human.intention.margin=0.5", later])
    people = Population.model_validate({"name": "calm", "groups": [{"human": human}]})
    env = seat_of(scenario, population=people)
    env.reset(seed=0)
    for _ in range(20):
        env.step(np.zeros(2))
    assert env.partner.truth().wish[0] == pytest.approx(0.3)
    assert env.partner.intention.margin == (0.9 if human is CALM else 0.5)
