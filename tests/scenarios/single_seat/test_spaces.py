"""What a learner perceives and does, against the PettingZoo environment's own."""

import gymnasium
import numpy as np
import pytest

from cowalk.scenarios import load, scenario_library
from cowalk.scenarios.single_seat.spaces import BEYOND, scales

both_seats = pytest.mark.parametrize("seat", ["automation", "human"])


def stepped(env, actions):
    env.reset(seed=7)
    return [env.step(action)[0] for action in actions][-1]


@both_seats
@pytest.mark.parametrize("name", ["puddle", "doorway"])
def test_every_form_says_the_same(name, seat, seat_of):
    forms = {
        (form, normal): seat_of(name, seat=seat, observation=form, normalise=normal)
        for form in ("flat", "dict")
        for normal in (True, False)
    }
    plain = forms["dict", False]
    done = [plain.action_space.sample() for _ in range(25)]
    box = plain.action_space
    scaled = [2.0 * (action - box.low) / (box.high - box.low) - 1.0 for action in done]
    seen = {key: stepped(env, scaled if key[1] else done) for key, env in forms.items()}
    layout, of_one = plain.layout, scales(plain.scenario)
    assert list(layout) == list(of_one)
    for entry, place in layout.items():
        raw = seen["dict", False][entry]
        expected = np.clip(raw / of_one[entry], -BEYOND, BEYOND)
        assert np.allclose(seen["dict", True][entry], expected, rtol=1e-6, atol=1e-6)
        for normal in (True, False):
            assert np.array_equal(seen["flat", normal][place], seen["dict", normal][entry].ravel())
    for key, env in forms.items():
        assert seen[key] in env.observation_space
        assert env.observation_space.contains(seen[key])


@both_seats
def test_without_scales_it_is_what_the_pettingzoo_environment_gives(seat, seat_of):
    env = seat_of("puddle", seat=seat, observation="dict", normalise=False)
    seen, _ = env.reset(seed=1)
    restored = env.parallel.restore(env.parallel.save())[seat]
    # The force samples of a restored state are void; all else is known.
    assert all(np.array_equal(seen[name], restored[name]) for name in ("pose", "obstacles", "time"))
    assert env.action_space == env.parallel.action_space(seat)
    assert seen["force"].dtype == np.float64


@pytest.mark.parametrize(
    ("seat", "least", "most"),
    [("automation", (0.0, -0.5), (1.2, 0.5)), ("human", (-30,) * 2, (30,) * 2)],
)
def test_actions_reach_from_bound_to_bound_and_not_beyond(seat, least, most, seat_of):
    env = seat_of("puddle", seat=seat)
    applied = []
    for level in (-1.0, 0.0, 1.0, 7.0):
        env.reset(seed=0)
        env.step(np.full(2, level, np.float32))
        applied.append(env.parallel.applied[seat == "automation"])
    middle = tuple(np.add(least, most) / 2.0)
    assert np.allclose(applied, [least, middle, most, most])


@pytest.mark.parametrize("name", sorted(scenario_library()))
def test_a_usual_walk_stays_well_within_the_scales(name, seat_of):
    env = seat_of(name)
    assert isinstance(env.observation_space, gymnasium.spaces.Box)
    observation, _ = env.reset(seed=0)
    largest = np.abs(observation)
    for _ in range(200):
        observation, _, over, late, _ = env.step(np.array([0.3, 0.0], np.float32))
        largest = np.maximum(largest, np.abs(observation))
        if over or late:
            break
    assert largest.max() < BEYOND
    assert largest[env.layout["time"]] <= 1.0


def test_scales_follow_the_scenario():
    scenario = load("puddle", ["force_limit=12.0", "duration=10.0"])
    of_one = scales(scenario)
    assert of_one["force"] == 12.0
    assert of_one["time"] == 10.0
    assert of_one["pose"][0] == scenario.world.path.length
    assert of_one["twist"].tolist() == [1.2, 0.5]
