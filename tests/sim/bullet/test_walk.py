"""Walking hand on handle: the reading, the executed twist, determinism, and what is refused."""

import math
import subprocess
import sys

import numpy as np
import pytest

from cowalk.sim.basics.errors import InputError, SimulationError
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.anthropometry import BodyParameters
from cowalk.sim.body.grip import GRIPS
from cowalk.sim.body.human_body import human_body
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.engine.engine import connect, engine
from cowalk.sim.robot.drive import DriveParameters
from cowalk.sim.world.world import Corridor, Obstacle, World

WORLD = World(Path(((0, 0), (20, 0))))


@pytest.fixture(scope="module")
def plant():
    plant = BulletPlant(Rates())
    yield plant
    plant.close()


def walk(plant, twist, push, steps=300, world=WORLD):
    plant.reset(world, np.random.default_rng(0))
    return [plant.step(twist, push) for _ in range(steps)]


def forces(states):
    return np.concatenate([state.force_on_base for state in states])


@pytest.mark.parametrize("push", [(0.0, 5.0), (5.0, 0.0), (-3.0, -4.0), (0.0, 0.0)])
def test_steady_push_reads_as_intended_while_walking(plant, push):
    states = walk(plant, (0.8, 0.0), push)
    steady = forces(states[150:])
    assert np.linalg.norm(steady.mean(axis=0) - push) <= 0.01 * np.linalg.norm(push) + 1e-9
    assert (steady.std(axis=0) < 1e-3).all()
    # Executed: the command less the slip that the push makes (`DriveParameters`), and no more.
    drive = DriveParameters()
    slip = push[0] / drive.gain_forward
    turn = (0.15 * push[1] + 0.30 * push[0]) / drive.gain_yaw
    assert states[-1].twist == pytest.approx((0.8 + slip, turn), rel=0.01, abs=1e-9)


def test_reading_is_not_the_intent_copied(plant):
    states = walk(plant, (0.8, 0.0), (0.0, 5.0), steps=60)
    starting = forces(states[:30])
    # The base draws the trunk along while it speeds up: pulled back by the hand.
    assert starting[:, 0].min() < -1.0
    assert np.abs(starting - (0.0, 5.0)).max() < 5.0


@pytest.mark.parametrize("grip", GRIPS)
def test_turning_reads_the_arms_centripetal_share(grip):
    speed, rate = 0.8, 0.26
    plant = BulletPlant(Rates(), walker={"hand_stiffness": 0.0}, grip={"kind": grip})
    states = walk(plant, (speed, rate), (0.0, 0.0), steps=400)
    plant.close()
    steady = forces(states[300:])
    assert states[-1].twist == pytest.approx((speed, rate), abs=0.002)
    # Two links, hinged at shoulder, elbow and hand, each loaded with -m a at its centre: the
    # moments of the whole arm about the shoulder and of the forearm about the elbow vanish.
    human = human_body(BodyParameters(), ((0.15, -0.30, 1.04),))
    (arm,), (shoulder, elbow) = human.arms, human.posture
    along = np.array([math.cos(shoulder), math.sin(shoulder)])
    beyond = np.array([math.cos(shoulder + elbow), math.sin(shoulder + elbow)])
    joint = np.array(human.place[:2]) + arm.shoulder
    bend = joint + arm.upper.length * along
    upper, fore = joint + arm.upper.centre * along, bend + arm.fore.centre * beyond
    hand = bend + arm.fore.length * beyond
    assert hand == pytest.approx((0.15, -0.30))
    centre = np.array([0.0, speed / rate])
    load_upper = -arm.upper.mass * rate**2 * (centre - upper)
    load_fore = -arm.fore.mass * rate**2 * (centre - fore)

    def moment(arm, load):
        return arm[0] * load[1] - arm[1] * load[0]

    arms = np.array([hand - joint, hand - bend])
    loads = [
        moment(upper - joint, load_upper) + moment(fore - joint, load_fore),
        moment(fore - bend, load_fore),
    ]
    expected = np.linalg.solve(np.stack((-arms[:, 1], arms[:, 0]), axis=-1), loads)
    assert steady.mean(axis=0) == pytest.approx(expected, rel=0.01)
    assert (steady.std(axis=0) < 0.001).all()


@pytest.mark.parametrize("rates", [Rates(sensor=120), Rates(20, 120, 60), Rates(20, 1000, 500)])
def test_other_rates(rates):
    plant = BulletPlant(rates)
    states = walk(plant, (0.8, 0.0), (0.0, 5.0), steps=200)
    plant.close()
    assert states[0].force_on_base.shape == (rates.samples, 2)
    assert forces(states[150:]).mean(axis=0) == pytest.approx((0.0, 5.0), abs=0.05)


def test_turning_relaxed_reads_little(plant):
    steady = forces(walk(plant, (0.8, 0.26), (0.0, 0.0))[200:])
    assert np.hypot(*steady.T).max() < 0.3
    assert (steady.std(axis=0) < 0.01).all()


def wander(plant, steps=80):
    plant.reset(World(WORLD.path, start=(1.0, 0.3, 0.2)), np.random.default_rng(0))
    for k in range(steps):
        push = (2.0 * math.sin(0.3 * k), 5.0 * math.cos(0.2 * k))
        state = plant.step((0.8, 0.3 * math.sin(0.1 * k)), push)
        yield np.array([*state.pose, *state.twist, *state.human_pose, *state.force_on_base.flat])


def test_same_run_bit_for_bit(plant):
    first = np.array(list(wander(plant)))
    assert np.array_equal(first, np.array(list(wander(plant)))), "after a reset"

    fresh, other = BulletPlant(Rates()), BulletPlant(Rates())
    walk(other, (0.5, 0.2), (1.0, -3.0), steps=7)
    pairs = list(zip(wander(fresh), wander(other), strict=True))
    fresh.close()
    other.close()
    assert np.array_equal(first, np.array([a for a, _ in pairs])), "in a fresh plant"
    assert np.array_equal(first, np.array([b for _, b in pairs])), "interleaved, after another run"


def test_looking_changes_nothing(plant):
    world = World(WORLD.path, Corridor(3.0), (Obstacle(3, 0, 0.4), Obstacle(5, 1, 0.3, "crate")))
    plant.reset(world, np.random.default_rng(0))
    unseen = [plant.step((0.8, 0.1), (0.0, 3.0)) for _ in range(10)]
    plant.reset(world, np.random.default_rng(0))
    pictures = []
    for state in unseen:
        seen = plant.step((0.8, 0.1), (0.0, 3.0))
        pictures.append(plant.render(80, 60))
        assert (seen.pose, seen.human_pose) == (state.pose, state.human_pose)
        assert np.array_equal(seen.force_on_base, state.force_on_base)
    assert pictures[0].shape == (60, 80, 3)
    assert pictures[0].dtype == np.uint8
    assert (pictures[0] != pictures[-1]).any()


@pytest.mark.parametrize(
    ("twist", "push", "named"),
    [
        ((math.nan, 0.0), (0.0, 0.0), "twist_command"),
        ((0.8, math.inf), (0.0, 0.0), "twist_command"),
        ((0.8, 0.0), (0.0, math.nan), "hand_force"),
    ],
)
def test_not_finite_is_named(plant, twist, push, named):
    walk(plant, (0.0, 0.0), (0.0, 0.0), steps=1)
    with pytest.raises(SimulationError, match=named):
        plant.step(twist, push)


@pytest.mark.parametrize("push", [1e5, 1e300])
def test_divergence_is_named_and_forgotten_by_a_reset(plant, push):
    before = forces(walk(plant, (0.8, 0.0), (0.0, 1.0), steps=10))
    with pytest.raises(SimulationError, match=r"the (base|human) moves at .* m/s"):
        walk(plant, (0.8, 0.0), (push, 0.0), steps=200)
    assert np.array_equal(before, forces(walk(plant, (0.8, 0.0), (0.0, 1.0), steps=10)))


def test_parameters_from_a_file():
    plant = BulletPlant(Rates(), walker={"hand_stiffness": 200.0}, drive={"max_speed": 0.5})
    states = walk(plant, (0.8, 0.0), (0.0, 0.0), steps=60)
    plant.close()
    assert states[-1].twist[0] == pytest.approx(0.5, abs=0.01)
    with pytest.raises(InputError, match=r"drive\.max_sped: unknown key.*max_speed"):
        BulletPlant(Rates(), drive={"max_sped": 0.5})


def test_close_twice_frees_the_world():
    for cycle in range(20):
        plant = BulletPlant(Rates())
        plant.reset(WORLD, np.random.default_rng(0))
        if cycle % 5 == 0:
            plant.render(8, 8)
        plant.close()
        plant.close()
    client = connect()
    engine.disconnect(client)
    assert client < 10, "clients are used again"


def test_no_window_is_one_line(monkeypatch):
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setenv("DISPLAY", ":4711")
    with pytest.raises(InputError, match="no window can be opened: display ':4711'"):
        connect(gui=True)


def test_output_comes_back_after_worlds_were_opened_in_several_threads():
    code = (
        "from concurrent.futures import ThreadPoolExecutor\n"
        "from cowalk.sim.bullet.plant import BulletPlant, Rates\n"
        "def one(_):\n"
        "    for _ in range(5):\n"
        "        BulletPlant(Rates()).close()\n"
        "with ThreadPoolExecutor(4) as pool:\n"
        "    list(pool.map(one, range(4)))\n"
        "print('here')"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == "here\n"


def test_engine_is_silent():
    code = (
        "from cowalk.sim.bullet.plant import BulletPlant, Rates\n"
        "BulletPlant(Rates()).close()\n"
        "print('{}')"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == "{}\n"
    assert run.stderr == ""
