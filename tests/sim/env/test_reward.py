"""What the seats are rewarded for: the equation, its weights, and what is refused."""

import math

import numpy as np
import pytest

from cowalk.sim import RewardParameters, parallel_env
from cowalk.sim.basics.errors import InputError
from cowalk.sim.env.reward import TERMS, Reward
from cowalk.sim.plant.protocol import PlantState

RELATIVE = (3.0, 0.4, 0.2)
STATE = PlantState(
    pose=(3.0, 0.4, 0.2),
    twist=(0.6, 0.1),
    human_pose=(3.0, -0.2, 0.2),
    wrench_on_base=np.array([[3.0, -1.0, 0, 0, 0, 0], [5.0, -3.0, 0, 0, 0, 0]]),
)


def rewards(given=None, clearance=0.1, collision=False, goal=False):
    reward = Reward(0.8, 0.05, given or RewardParameters())
    return reward, reward.terms(STATE, RELATIVE, clearance, collision, goal)


def test_by_default_the_human_spares_effort_and_the_automation_keeps_to_path_and_pace():
    reward, terms = rewards()
    progress, effort = 0.6 * math.cos(0.2) / 0.8, (4.0**2 + 2.0**2) / 7.5**2
    closeness = 1.0 - 0.1 / 0.3
    assert reward.of_each_seat(terms) == pytest.approx(
        {
            "human": 0.05 * (progress - effort - 2.0 * closeness),
            "automation": 0.05 * (progress - effort - 0.4**2 - 0.25**2),
        }
    )


def test_ends_count_whole_and_not_by_the_second():
    before, after = (rewards(**end) for end in ({}, {"goal": True}))
    gained = after[0].of_each_seat(after[1])["human"] - before[0].of_each_seat(before[1])["human"]
    assert gained == pytest.approx(1.0)
    reward, terms = rewards(RewardParameters(human={"collision": 3.0}), collision=True)
    assert reward.by_name(terms)["human"]["collision"] == -3.0
    assert reward.by_name(terms)["automation"]["collision"] == -10.0


@pytest.mark.parametrize("term", TERMS)
@pytest.mark.parametrize("seat", ["human", "automation"])
def test_a_weight_scales_its_term_for_its_seat_alone(seat, term):
    def by_name(weight):
        reward, terms = rewards(RewardParameters(**{seat: {term: weight}}), goal=True)
        return reward.by_name(terms)

    one, three = by_name(1.0), by_name(3.0)
    assert three[seat].pop(term) == pytest.approx(3.0 * one[seat].pop(term))
    assert three == one


def test_scales_say_what_costs_as_much_as_standing_still():
    given = RewardParameters(force_scale=math.hypot(4.0, 2.0), offset_scale=0.4, comfort=0.2)
    _, terms = rewards(given)
    assert terms[1] == pytest.approx(1.0)
    assert terms[3] == pytest.approx(1.0)
    assert terms[4] == pytest.approx(0.5)


@pytest.mark.parametrize("plant", ["unicycle", "bullet"])
def test_an_environment_keeps_the_terms_of_its_last_step(plant):
    env = parallel_env(plant=plant, reward={"human": {"effort": 4.0}, "comfort": 3.0})
    env.reset(seed=0)
    assert set(env.reward_terms["human"].values()) == {0.0}
    act = {"human": np.array([5.0, 3.0]), "automation": np.array([0.7, 0.1])}
    for _ in range(10):
        given = env.step(act)[1]
    kept = env.reward_terms
    assert set(kept) == {"human", "automation"}
    for seat, terms in kept.items():
        assert tuple(terms) == TERMS
        assert sum(terms.values()) == pytest.approx(given[seat], abs=1e-12)
    assert kept["human"]["effort"] == pytest.approx(4.0 * kept["automation"]["effort"])
    assert kept["human"]["effort"] < 0.0 < kept["human"]["progress"]
    saved = env.save()
    env.step(act)
    assert env.reward_terms != kept
    env.restore(saved)
    assert env.reward_terms == kept
    env.close()


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (3, "reward = 3: give a mapping or RewardParameters of human, automation"),
        ({"force": 1.0}, "reward.force: unknown key; did you mean 'force_scale'"),
        ({"force_scale": 0.0}, "reward.force_scale = 0.0 N: must lie between 0.01 and 1000 N"),
        ({"comfort": "wide"}, "reward.comfort = 'wide': a number is expected, in m"),
        ({"human": 2}, "reward.human = 2: give a mapping or RewardWeights of progress"),
        ({"human": {"efort": 2.0}}, "reward.human.efort: unknown key; did you mean 'effort'"),
        (
            {"automation": {"pace": math.nan}},
            "reward.automation.pace = nan: must lie between -1000 and 1000",
        ),
    ],
)
def test_rewards_without_sense_are_refused(given, words):
    with pytest.raises(InputError, match=f"^{words}") as refused:
        parallel_env(plant="unicycle", reward=given)
    assert "\n" not in str(refused.value)
