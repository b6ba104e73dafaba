"""Holding on: wrists, slipping, letting go, what a lost grip does, and the sensor's frame."""

import math

import numpy as np
import pytest

from cowalk.sim import parallel_env
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.engine.engine import engine
from cowalk.sim.world.world import World

WORLD = World(Path(((0, 0), (20, 0))))


def walk(steps=100, twist=(0.8, 0.0), push=(0.0, 0.0), **options):
    plant = BulletPlant(Rates(), **options)
    plant.reset(WORLD, np.random.default_rng(0))
    states = [plant.step(twist, push) for _ in range(steps)]
    plant.close()
    return states


@pytest.mark.parametrize("push", [(0.0, 5.0), (4.0, 0.0)])
@pytest.mark.parametrize("stiffness", [4000.0, 8000.0])
def test_a_compliant_grip_keeps_back_what_the_arm_holds(push, stiffness):
    """The hand gives way by F/K_grip; over that way the arm's own spring takes its share."""
    grip = {"kind": "compliant", "stiffness": (stiffness,) * 3}
    steady = walk(200, push=push, grip=grip)[-1].force_on_base.mean(axis=0)
    share = stiffness / (stiffness + 100.0)
    expected = share * np.array(push)
    assert np.linalg.norm(steady - expected) <= 0.01 * np.linalg.norm(expected)


def test_a_stiff_wrist_hands_over_torque_while_the_arm_turns():
    gait = {"enabled": True}
    free = np.concatenate([s.wrench_on_base for s in walk(gait=gait)])
    stiff = np.concatenate(
        [s.wrench_on_base for s in walk(gait=gait, grip={"turn_stiffness": (0.0, 0.0, 2.0)})]
    )
    assert not free[:, 3:].any()
    assert 0.05 < np.abs(stiff[:, 5]).max() < 3.0


def test_the_sensor_reads_in_its_own_frame():
    mount = {"position": (0.0, 0.0, -0.1), "rpy": (0.0, 0.0, math.pi / 2)}
    (state,) = walk(200, push=(0.0, 5.0), mount=mount)[-1:]
    mean = state.wrench_on_sensor.mean(axis=0)
    # 5 N to the left at 0.1 m above the sensor: its x axis points left.
    assert mean[:2] == pytest.approx((5.0, 0.0), abs=0.05)
    assert mean[3:] == pytest.approx((0.0, 0.5, 0.0), abs=0.005)


@pytest.mark.parametrize("coupling", ["handle", "stretcher"])
@pytest.mark.parametrize(
    "grip",
    [
        {"release_force": 8.0},
        {"kind": "compliant", "release_force": 8.0},
        {"kind": "compliant", "slip_force": 8.0},
    ],
    ids=["rigid-release", "compliant-release", "compliant-slip"],
)
def test_too_hard_a_pull_loses_the_grip(grip, coupling):
    options = {"grip": grip, "coupling": {"kind": coupling}}
    held = walk(60, push=(0.0, 5.0), twist=(0.0, 0.0), **options)
    assert all(state.grip_held and state.end is None for state in held)
    lost = walk(160, push=(0.0, 15.0), twist=(0.0, 0.0), **options)
    assert not lost[-1].grip_held
    assert lost[-1].end == "grip lost"
    if coupling == "handle":
        assert not lost[-1].wrench_on_base.any(), "nobody holds, nothing is read"
    assert np.abs(np.concatenate([s.force_on_base for s in lost[-20:]])).max() < 0.1


def test_a_slipping_grip_passes_on_no_more_than_it_holds():
    grip = {"kind": "compliant", "slip_force": 6.0, "slip_length": 10.0}
    force = np.concatenate([s.force_on_base for s in walk(160, push=(0.0, 15.0), grip=grip)])
    assert np.hypot(*force.T).max() <= 6.0 + 1e-9
    assert np.hypot(*force.T).max() == pytest.approx(6.0)


def test_a_base_let_go_of_stops_if_told_to():
    grip = {"release_force": 8.0, "on_loss": "stop"}
    states = walk(200, push=(0.0, 15.0), grip=grip)
    assert not states[-1].grip_held
    assert states[-1].end is None
    assert states[-1].twist == pytest.approx((0.0, 0.0), abs=1e-3)
    assert np.isfinite(states[-1].human_pose).all()


@pytest.mark.parametrize(("on_loss", "ends"), [("end", True), ("stop", False)])
def test_a_lost_grip_ends_the_episode_or_not(on_loss, ends):
    grip = {"release_force": 8.0, "on_loss": on_loss}
    env = parallel_env(plant_parameters={"grip": grip}, duration=4.0)
    env.reset(seed=0)
    while env.agents:
        _, _, terminations, truncations, infos = env.step(
            {"human": np.array([0.0, 15.0]), "automation": np.array([0.0, 0.0])}
        )
    env.close()
    assert infos["human"]["grip_lost"]
    assert all(terminations.values()) is ends
    assert all(truncations.values()) is not ends


def test_a_hand_lets_go_between_two_samples_of_a_slow_sensor():
    gait = {"enabled": True}
    force = np.stack([s.force_on_base for s in walk(60, gait=gait)])
    size = np.hypot(force[..., 0], force[..., 1])
    late = int((size.max(axis=1) > 3.0).argmax())
    limit = 0.5 * (size[late, 4] + size[late, 5])
    assert size[:late].max() < limit < size[late, -1], "it rises through the limit within a step"
    plant = BulletPlant(Rates(sensor=20), gait=gait, grip={"release_force": limit})
    plant.reset(WORLD, np.random.default_rng(0))
    states = [plant.step((0.8, 0.0), (0.0, 0.0)) for _ in range(late + 1)]
    plant.close()
    assert [state.grip_held for state in states] == [True] * late + [False]
    assert not states[-1].wrench_on_base.any(), "gone before the sensor looks"


def test_a_reset_takes_hold_again():
    plant = BulletPlant(Rates(), grip={"release_force": 8.0})
    runs = []
    for _ in range(2):
        assert plant.reset(WORLD, np.random.default_rng(0)).grip_held
        states = [plant.step((0.0, 0.0), (0.0, 15.0)) for _ in range(60)]
        assert not states[-1].grip_held
        runs.append(np.concatenate([s.wrench_on_base for s in states]))
    plant.close()
    assert runs[0].tobytes() == runs[1].tobytes()


def test_a_load_is_felt_at_the_base_with_its_mass_and_its_lever():
    options = {"coupling": {"kind": "stretcher", "mass": 8.0}, "body": {"hand": "both"}}
    speeding = walk(30, **options, walker={"hand_stiffness": 0.0, "hand_damping": 0.0})
    # While all speed up at 0.5 m/s^2 the base pulls the load: 4 N, less what the arms pull.
    force = np.concatenate([s.force_on_base for s in speeding[10:25]])
    pushed = walk(200, push=(0.0, 5.0), twist=(0.0, 0.0), **options)
    wrench = pushed[-1].wrench_on_base.mean(axis=0)
    assert force[:, 0].mean() < -4.0
    assert wrench[1] == pytest.approx(5.0, abs=0.3)
    assert wrench[5] == pytest.approx(-1.2 * wrench[1], rel=0.1)


def test_wheels_come_with_the_robot_that_ships(tmp_path):
    file = tmp_path / "own.urdf"
    file.write_text(
        '<robot><link name="handle"><inertial><mass value="9"/></inertial></link></robot>'
    )
    with pytest.raises(InputError, match="only the robot that ships has wheels"):
        BulletPlant(Rates(), drive={"kind": "wheels"}, robot={"urdf": str(file)})


@pytest.mark.parametrize("grip", ["rigid", "compliant"])
def test_a_base_on_wheels_stands_on_the_floor_and_keeps_its_course(grip):
    """The hand follows the handle up and down: it carries nothing, and no wheel lifts off."""
    states = walk(300, (0.8, 0.26), (0.0, 5.0), drive={"kind": "wheels"}, grip={"kind": grip})
    force = np.concatenate([state.wrench_on_base[:, :3] for state in states[100:]])
    assert np.abs(force[:, 2]).max() < 0.02
    assert states[-1].twist == pytest.approx((0.8, 0.26), rel=2e-3)
    turned = states[-1].pose[2] - states[100].pose[2]
    assert turned == pytest.approx(0.26 * (states[-1].time - states[100].time), rel=5e-3)


def test_on_wheels_a_load_weighs_on_the_base_that_it_is_clamped_to():
    coupling = {"kind": "stretcher", "mass": 8.0}
    state = walk(200, drive={"kind": "wheels"}, coupling=coupling, body={"hand": "both"})[-1]
    np.testing.assert_allclose(state.wrench_on_base[:, 2], -8.0 * 9.81, rtol=2e-3)


def test_a_hand_that_lets_go_on_wheels_hangs_at_its_arm():
    grip = {"kind": "rigid", "release_force": 2.0, "on_loss": "stop"}
    plant = BulletPlant(Rates(), drive={"kind": "wheels"}, grip=grip)
    plant.reset(WORLD, np.random.default_rng(0))
    for _ in range(100):
        state = plant.step((0.8, 0.0), (0.0, 8.0))
    assert not state.grip_held
    human = plant._pair.human
    (hand,) = (j for name, j in human.links.items() if name.startswith("hand_"))
    height, speed, *_ = engine.getJointState(human.body, hand, human.client)
    plant.close()
    assert height == pytest.approx(-0.3, abs=0.01)
    assert abs(speed) < 0.1
