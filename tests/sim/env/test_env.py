import math
import warnings

import numpy as np
import pytest
from pettingzoo.test import parallel_api_test, parallel_seed_test

from cowalk.sim import parallel_env
from cowalk.sim.basics.errors import InputError, SimulationError
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.env.env import STRAIGHT_CORRIDOR
from cowalk.sim.plant.registry import PLANTS
from cowalk.sim.sensor.presets import sensor_preset
from cowalk.sim.sensor.sensor import SensorParameters
from cowalk.sim.sensor.wrench import SensorMount, in_base_frame
from cowalk.sim.world.world import Corridor, Obstacle, World

NOISY = SensorParameters(noise_density=0.02, drop_rate=0.02, low_pass=60.0, latency=0.01)


def episode(env, seed, steps=None):
    """Play seeded random actions; return every number that comes out."""
    actions = np.random.default_rng(123)
    numbers = []
    observations, _ = env.reset(seed=seed)
    while env.agents and (steps is None or len(numbers) < steps):
        observations, rewards, *_, infos = env.step(
            {
                "human": actions.normal(scale=4.0, size=2),
                "automation": np.array([0.8, 0.3 * actions.normal()]),
            }
        )
        row = [part.ravel() for seat in observations.values() for part in seat.values()]
        row += [np.array(list(rewards.values())), np.array([infos["human"]["clearance"]])]
        numbers.append(np.concatenate(row))
    return np.array(numbers)


@pytest.mark.parametrize("plant", PLANTS.names())
def test_pettingzoo_api_without_a_warning(plant):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = parallel_env(plant=plant, duration=5.0)
        parallel_api_test(env, num_cycles=150)
        parallel_seed_test(lambda: parallel_env(plant=plant, duration=2.0))
        env.close()


@pytest.mark.parametrize("plant", PLANTS.names())
def test_one_seed_one_episode_bit_for_bit(plant):
    first_env = parallel_env(plant=plant, sensor=NOISY, duration=8.0)
    first = episode(first_env, seed=3)
    again = episode(first_env, seed=3)
    fresh = episode(parallel_env(plant=plant, sensor=NOISY, duration=8.0), seed=3)
    other = episode(first_env, seed=4)
    assert len(first) > 50
    assert first.tobytes() == again.tobytes() == fresh.tobytes()
    assert first.tobytes() != other.tobytes()


def test_spaces_are_the_same_for_both_seats_and_hold_the_observations():
    env = parallel_env(plant="unicycle", rates=Rates(sensor=120))
    observations, _ = env.reset(seed=0)
    assert env.observation_space("human") == env.observation_space("automation")
    for seat in env.agents:
        assert env.observation_space(seat).contains(dict(observations[seat]))
    assert observations["human"]["force"].shape == (6, 2)
    assert observations["human"]["wrench"].shape == (6, 6)


def test_only_the_human_sees_what_only_the_human_sees():
    world = World(STRAIGHT_CORRIDOR.path, obstacles=(Obstacle(3, 0, 0.4, seen_by=("human",)),))
    observations, _ = parallel_env(world, plant="unicycle").reset(seed=0)
    assert observations["human"]["obstacles"][0, 0] == 1.0
    assert not observations["automation"]["obstacles"].any()


def test_the_automation_reads_the_sensor_and_the_human_feels_the_force():
    env = parallel_env(plant="unicycle", sensor=NOISY)
    env.reset(seed=0)
    observations, *_ = env.step({"human": np.array([1.0, 2.0]), "automation": np.zeros(2)})
    np.testing.assert_array_equal(observations["human"]["force"], [[1.0, 2.0]] * 12)
    assert observations["human"]["force_valid"].all()
    assert observations["automation"]["force"].std(axis=0).min() > 0.05
    # Points have no torque, on either seat.
    np.testing.assert_array_equal(observations["human"]["wrench"], [[1.0, 2.0, 0, 0, 0, 0]] * 12)
    assert observations["automation"]["wrench"][:, :3].std(axis=0).min() > 0.05
    assert not observations["automation"]["wrench"][:, 3:].any()


@pytest.mark.parametrize("sensor", [SensorParameters(), sensor_preset("laboratory")])
def test_what_is_read_and_what_is_felt_are_about_the_handle_in_base_axes(sensor):
    mount = SensorMount((0.02, 0.0, -0.1), (0.1, -0.2, math.pi / 3))
    body = {"grip": {"turn_stiffness": (0.0, 0.0, 2.0)}, "gait": {"enabled": True}}
    env = parallel_env(sensor=sensor, plant_parameters={"mount": mount, **body})
    env.reset(seed=0)
    actions = {"human": np.array([3.0, 5.0]), "automation": np.array([0.6, 0.1])}
    exact, twisted = sensor == SensorParameters(), 0.0
    for _ in range(20):  # the push sets in, and the low-pass settles
        env.step(actions)
    for _ in range(40):
        observations, *_ = env.step(actions)
        felt, read = (observations[seat]["wrench"] for seat in ("human", "automation"))
        np.testing.assert_array_equal(felt, env.plant_state.wrench_on_base)
        np.testing.assert_array_equal(felt[:, :2], observations["human"]["force"])
        twisted = max(twisted, np.abs(felt[:, 5]).max())
        # The preset's cross-talk is 0.25 N per N m, and the handle stands 0.1 m off the sensor.
        error = 1e-12 if exact else 0.5
        np.testing.assert_allclose(read, felt, atol=error)
        in_sensor_axes = env.sensor_reading.wrench
        np.testing.assert_allclose(read, in_base_frame(in_sensor_axes, mount), atol=1e-12)
        assert np.abs(read - in_sensor_axes).max() > 1.0, "else the mount says nothing"
        np.testing.assert_array_equal(observations["automation"]["force"], read[:, :2])
    assert twisted > 0.05, "the wrist hands over torque"
    env.close()


def walk(env, twist, force=(0.0, 0.0)):
    env.reset(seed=0)
    total = {"human": 0.0, "automation": 0.0}
    while env.agents:
        _, rewards, terminations, truncations, infos = env.step(
            {"human": np.array(force), "automation": np.array(twist)}
        )
        total = {seat: total[seat] + rewards[seat] for seat in total}
    return total, terminations, truncations, infos


def test_episodes_end_at_the_goal_in_a_wall_and_in_time():
    short = World(Path(((0.0, 0.0), (2.0, 0.0))), Corridor(3.0))
    _, terminations, truncations, infos = walk(parallel_env(short, plant="unicycle"), (0.8, 0.0))
    assert infos["human"]["goal"]
    assert all(terminations.values())
    assert not any(truncations.values())
    _, terminations, _, infos = walk(parallel_env(short, plant="unicycle"), (0.8, -0.5))
    assert infos["human"]["collision"]
    assert all(terminations.values())
    _, terminations, truncations, infos = walk(
        parallel_env(short, plant="unicycle", duration=1.0), (0.0, 0.0)
    )
    assert all(truncations.values())
    assert not any(terminations.values())
    assert not infos["human"]["goal"]


def test_rewards_prefer_walking_without_effort_and_out_of_the_puddle():
    dry = World(Path(((0.0, 0.0), (6.0, 0.0))))
    wet = World(Path(((0.0, 0.0), (6.0, 0.0))), obstacles=(Obstacle(3.0, 0.0, 0.5),))
    calm, *_ = walk(parallel_env(dry, plant="unicycle"), (0.8, 0.0))
    pushed, *_ = walk(parallel_env(dry, plant="unicycle"), (0.8, 0.0), force=(0.0, 5.0))
    splashed, *_ = walk(parallel_env(wet, plant="unicycle"), (0.8, 0.0))
    waiting, *_ = walk(parallel_env(dry, plant="unicycle", duration=7.5), (0.0, 0.0))
    assert calm["human"] > splashed["human"]
    assert calm["human"] > waiting["human"]
    assert calm["human"] > pushed["human"]
    assert calm["automation"] > pushed["automation"]
    assert calm["automation"] > waiting["automation"]


def test_neither_seat_is_paid_for_dawdling():
    short = World(Path(((0.0, 0.0), (8.0, 0.0))))
    returns = {
        speed: walk(parallel_env(short, plant="unicycle", duration=40.0), (speed, 0.0))[0]
        for speed in (0.3, 0.6, 0.8)
    }
    assert returns[0.3]["automation"] < returns[0.6]["automation"] < returns[0.8]["automation"]
    assert returns[0.3]["human"] <= returns[0.8]["human"] + 0.05


def test_stepping_without_an_episode_and_unknown_render_modes_are_refused():
    env = parallel_env(plant="unicycle")
    with pytest.raises(SimulationError, match="call reset before step"):
        env.step({"human": np.zeros(2), "automation": np.zeros(2)})
    with pytest.raises(InputError, match="render_mode = 'foo'"):
        parallel_env(plant="unicycle", render_mode="foo")


@pytest.mark.parametrize("seat", ["human", "automation"])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_an_action_that_is_not_finite_is_named(seat, bad):
    env = parallel_env(plant="unicycle")
    env.reset(seed=0)
    actions = {"human": np.zeros(2), "automation": np.zeros(2)}
    actions[seat] = np.array([0.0, bad])
    with pytest.raises(SimulationError, match=rf"the {seat}'s .* {bad}\] at t = 0 s"):
        env.step(actions)


MALFORMED = [
    *(None, 3.0, "ab", b"ab", True, {}, {"v": 1.0, "omega": 0.0}, object, range(3)),
    *([], [1.0], [1.0, 2.0, 3.0], [[1.0, 2.0]], [[1.0], [2.0]], [[1.0], 2.0], np.zeros((2, 1))),
    *(["1", "2"], [None, 1.0], [1.0, 2.0j], [True, False], np.array(["a", "b"])),
    *(np.array([1.0, 2.0], dtype=object), np.zeros((2, 5)), np.array(1.0)),
]


@pytest.mark.parametrize("seat", ["human", "automation"])
@pytest.mark.parametrize("bad", MALFORMED, ids=repr)
def test_what_is_no_action_is_refused_in_one_line(seat, bad):
    env = parallel_env(plant="unicycle")
    env.reset(seed=0)
    actions = {"human": np.zeros(2), "automation": np.zeros(2)}
    with pytest.raises(SimulationError, match=f"the {seat}'s .* must be 2 numbers") as refused:
        env.step(actions | {seat: bad})
    assert "\n" not in str(refused.value)
    env.step(actions)  # nothing was done


@pytest.mark.parametrize("bad", [None, 3.0, [np.zeros(2), np.zeros(2)], "human"], ids=repr)
def test_actions_that_are_no_mapping_are_refused(bad):
    env = parallel_env(plant="unicycle")
    env.reset(seed=0)
    with pytest.raises(SimulationError, match=r"step: .* is no mapping; give an action to each"):
        env.step(bad)


@pytest.mark.parametrize("good", [[1, 2], (1.0, 2.0), np.array([1, 2], dtype=np.float16)])
def test_any_two_real_numbers_are_an_action(good):
    env = parallel_env(plant="unicycle")
    env.reset(seed=0)
    env.step({"human": good, "automation": np.zeros(2)})
    assert env.applied[0] == (1.0, 2.0)


def test_actions_are_clipped_to_the_action_space():
    env = parallel_env(plant="unicycle", force_limit=10.0)
    env.reset(seed=0)
    observations, *_ = env.step(
        {"human": np.array([99.0, -99.0]), "automation": np.array([9.0, -9.0])}
    )
    np.testing.assert_array_equal(observations["human"]["force"][0], [10.0, -10.0])
    np.testing.assert_array_equal(observations["human"]["twist"], [1.2, -0.5])


@pytest.mark.parametrize("plant", PLANTS.names())
def test_a_picture_is_drawn(plant):
    env = parallel_env(plant=plant, render_mode="rgb_array")
    env.reset(seed=0)
    picture = env.render()
    assert picture.shape == (480, 640, 3)
    assert picture.dtype == np.uint8
    assert picture.std() > 5.0
    env.close()


def test_human_rendering_opens_a_window_for_plants_without_a_viewer(monkeypatch):
    import matplotlib as mpl
    from matplotlib import pyplot as plt

    mpl.use("Agg")
    env = parallel_env(plant="unicycle", render_mode="human", duration=0.2)
    with pytest.raises(InputError, match="no window can be opened"):
        walk(env, (0.8, 0.0))
    # A screen is all that is missing here: drawing itself works without one.
    monkeypatch.setattr(plt, "get_backend", lambda: "TkAgg")
    walk(env, (0.8, 0.0))
    assert plt.fignum_exists("cowalk")
    plt.close("all")


@pytest.mark.parametrize(
    ("rates", "named"),
    [
        ({"physics": 250}, ("250", "20")),
        ({"sensor": 100}, ("240", "100")),
        ({"control": 7}, ("240", "7")),
        ({"control": 0}, ("control = 0 Hz", "between 1 and")),
    ],
)
def test_rates_that_do_not_divide_are_refused_with_both_numbers(rates, named):
    with pytest.raises(InputError) as refused:
        Rates(**rates)
    assert all(number in str(refused.value) for number in named)


def test_unknown_plant_is_refused_with_what_is_known():
    with pytest.raises(InputError, match=r"'bulet'; did you mean 'bullet'\?"):
        parallel_env(plant="bulet")


def test_a_sensor_is_known_by_the_name_of_its_preset():
    named, built = (
        parallel_env(sensor=sensor, plant="unicycle", duration=1.0)
        for sensor in ("industrial", sensor_preset("industrial"))
    )
    assert episode(named, seed=1).tobytes() == episode(built, seed=1).tobytes()
    with pytest.raises(InputError, match=r"preset 'industral'; did you mean 'industrial'\?"):
        parallel_env(sensor="industral")


@pytest.mark.parametrize(
    ("plant", "named"),
    [
        ("bullet", r"plant_parameters.bdy: unknown key; did you mean 'body'\? Known: drive, body"),
        ("unicycle", r"plant_parameters.bdy: unknown key; 'unicycle' takes none"),
    ],
)
def test_unknown_parameters_of_a_plant_are_refused(plant, named):
    with pytest.raises(InputError, match=named):
        parallel_env(plant=plant, plant_parameters={"bdy": {}})


@pytest.mark.parametrize(
    ("seats", "named"),
    [
        (("human",), "step: 'automation' has no action; give one to each of human and automation"),
        (("human", "robot"), "step: 'automation' has no action, 'robot' is no seat;"),
        (("human", "automation", "dog"), "step: 'dog' is no seat;"),
    ],
)
def test_every_seat_and_no_other_acts(seats, named):
    env = parallel_env(plant="unicycle")
    env.reset(seed=0)
    with pytest.raises(SimulationError, match=named):
        env.step(dict.fromkeys(seats, np.zeros(2)))


@pytest.mark.parametrize(
    ("mount", "named"),
    [
        ({"position": [0.0, 0.0, 100.0]}, r"mount.position = \(0.0, 0.0, 100.0\): .* within 2 m"),
        ({"position": [0.0, math.nan, 0.0]}, "mount.position = .*: must be 3 finite numbers"),
        ({"rpy": [0.0, 1.0]}, "mount.rpy = .*: must be 3 finite numbers"),
    ],
)
def test_a_sensor_sits_near_the_handle(mount, named):
    with pytest.raises(InputError, match=named):
        parallel_env(plant_parameters={"mount": mount})


def test_the_tare_of_a_load_on_wheels_moves_no_body_and_repeats():
    """What is read before a push is no more than the sensor's own error, episode by episode."""
    parameters = {"drive": {"kind": "wheels"}, "coupling": {"kind": "stretcher"}}
    env = parallel_env(sensor="industrial", plant_parameters=parameters, start="standing")
    still = {"human": np.zeros(2), "automation": np.zeros(2)}
    read = []
    for _ in range(2):
        env.reset(seed=2)
        weight = env.plant_state.wrench_on_base[0]
        assert weight[2] == pytest.approx(-8.0 * 9.81, rel=1e-3)
        assert env.measured_force == pytest.approx(np.zeros((12, 2)), abs=0.5)
        samples = []
        for _ in range(40):
            env.step(still)
            samples.append(env.sensor_reading.wrench)
            settled = env.plant_state.wrench_on_base
        np.testing.assert_allclose(settled[-1], weight, atol=0.01)
        read.append(np.concatenate(samples))
    env.close()
    assert read[0].tobytes() == read[1].tobytes()
    # The first 0.1 s is the load landing. Noise 0.1 N a sample, 0.02 N after averaging tare and
    # 1.9 s of samples 480 times at a bandwidth of 44 Hz; a step of 0.01 N.
    assert np.abs(read[0][24:].mean(axis=0)[:3]).max() < 0.06
    assert np.abs(read[0][24:].mean(axis=0)[3:]).max() < 0.006


@pytest.mark.parametrize("plant", ["bullet", "unicycle"])
def test_a_blocked_start_is_refused_each_time_and_leaves_no_episode(plant):
    env = parallel_env(World(Path(((0, 0), (20, 0))), corridor=Corridor(width=1.4)), plant=plant)
    for _ in range(2):
        with pytest.raises(InputError, match=r"inside a wall of world\.corridor"):
            env.reset(seed=0)
        assert env.agents == []
        with pytest.raises(SimulationError, match="call reset before save"):
            env.save()
    env.close()


def test_a_load_beyond_the_sensors_range_leaves_no_episode():
    parameters = {"drive": {"kind": "wheels"}, "coupling": {"kind": "stretcher"}}
    env = parallel_env(sensor=SensorParameters(range=10.0), plant_parameters=parameters)
    with pytest.raises(InputError, match="clamped on at rest"):
        env.reset(seed=0)
    assert env.agents == []
    with pytest.raises(SimulationError, match="call reset before plant_state"):
        _ = env.plant_state
    env.close()
