"""Legs push no harder than shoes hold: people can be pulled off their feet."""

import numpy as np
import pytest

from cowalk.scenarios import load, run
from cowalk.scenarios.figures.run import run_figure
from cowalk.scenarios.result import how_it_ended
from cowalk.sim import TwistBounds, parallel_env
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.anthropometry import HANDS
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.engine.engine import engine
from cowalk.sim.robot.coupling import COUPLINGS
from cowalk.sim.world.world import World

WORLD = World(Path(((0, 0), (60, 0))))
STRONG = {"max_acceleration": 100.0, "max_speed": 2.0, "max_force": 5000.0}
"""A robot that jumps to its command, whatever hangs on it."""


def walk(twist, command, steps, push=(0.0, 0.0), **options):
    plant = BulletPlant(Rates(), **options)
    plant.reset(WORLD, np.random.default_rng(0), twist)
    states = [plant.step(command, push) for _ in range(steps)]
    plant.close()
    return states


def momentum(plant):
    """Return that of the human, all links, x and y, N s."""
    chain, client = plant._pair.human, plant._pair.client
    total = np.zeros(2)
    for joint in range(engine.getNumJoints(chain.body, client)):
        mass = engine.getDynamicsInfo(chain.body, joint, client)[0]
        velocity = engine.getLinkState(chain.body, joint, 1, 1, client)[6]
        total += mass * np.array(velocity[:2])
    return total


@pytest.mark.parametrize(("traction", "mass"), [(0.5, 70.0), (0.3, 90.0)])
def test_sliding_feet_brake_with_traction_times_weight(traction, mass):
    """A base that stops at once, and a hand that lets go: only the floor slows the body down."""
    plant = BulletPlant(
        Rates(240, 240, 240),
        drive=STRONG,
        body={"mass": mass},
        grip={"release_force": 0.1, "on_loss": "stop"},
        walker={"traction": traction, "on_lost_footing": "mark"},
    )
    plant.reset(WORLD, np.random.default_rng(0), (2.0, 0.0))
    for _ in range(24):  # the legs' delay, and what they do before they slide
        plant.step((0.0, 0.0), (0.0, 0.0))
    before = momentum(plant)
    for _ in range(24):
        plant.step((0.0, 0.0), (0.0, 0.0))
    legs = (momentum(plant) - before) * 240.0 / 24.0
    plant.close()
    assert legs == pytest.approx([-traction * mass * 9.81, 0.0], abs=0.005 * mass)


@pytest.mark.parametrize("coupling", COUPLINGS)
@pytest.mark.parametrize("hand", HANDS)
def test_a_jump_of_the_robot_takes_anybody_off_their_feet(hand, coupling):
    """The audit's: to 2 m/s at 100 m/s^2. They once followed."""
    options = {"drive": STRONG, "body": {"hand": hand}, "coupling": {"kind": coupling}}
    states = walk((0.0, 0.0), (2.0, 0.0), 20, **options)
    assert not states[-1].footing_held
    assert states[-1].end == "lost footing"
    assert states[-1].grip_held
    held = walk((0.0, 0.0), (2.0, 0.0), 20, walker={"traction": 10.0}, **options)
    assert held[-1].footing_held


def test_so_does_a_lasting_pull_beyond_what_shoes_hold():
    for acceleration, held in ((4.5, True), (6.0, False)):
        drive = STRONG | {"max_acceleration": acceleration}
        states = walk((0.0, 0.0), (2.0, 0.0), 20, drive=drive)
        assert states[-1].footing_held is held


def test_who_pushes_harder_than_their_shoes_hold_slides_back():
    """Against a wall of a robot: what the hands take beyond mu m g goes into the body."""
    options = {"drive": {"max_force": 5000.0}, "body": {"hand": "both"}}
    options["walker"] = {"on_lost_footing": "mark"}
    within, beyond = (
        walk((0.0, 0.0), (0.0, 0.0), 12, push=(force, 0.0), **options)[-1]
        for force in (300.0, 450.0)
    )
    assert within.footing_held
    assert not beyond.footing_held
    # Place beside the base, which yields under the push.
    lag = [state.human_pose[0] - state.pose[0] for state in (beyond, within)]
    assert lag[0] < lag[1] - 0.03


def test_a_limit_that_is_not_reached_changes_no_bit():
    gait = {"enabled": True}
    runs = [
        np.concatenate(
            [s.wrench_on_base for s in walk((0.8, 0.0), (0.8, 0.0), 40, gait=gait, walker=walker)]
        )
        for walker in ({}, {"traction": 5.0})
    ]
    np.testing.assert_array_equal(*runs)


@pytest.mark.parametrize(("choice", "ends"), [("end", True), ("mark", False)])
def test_lost_footing_ends_the_episode_or_marks_it(choice, ends):
    parameters = {"drive": STRONG, "walker": {"on_lost_footing": choice}}
    bounds = TwistBounds((0.0, -0.5), (2.0, 0.5))
    env = parallel_env(plant_parameters=parameters, duration=1.5, start="standing", bounds=bounds)
    env.reset(seed=0)
    lost = []
    while env.agents:
        actions = {"human": np.zeros(2), "automation": np.array([2.0, 0.0])}
        _, _, over, late, infos = env.step(actions)
        lost.append(infos["human"]["footing_lost"])
    env.close()
    assert lost == sorted(lost), "lost is lost"
    assert lost[-1]
    assert all(over.values()) is ends
    assert all(late.values()) is not ends


def slipping(choice):
    drive = [f"plant.parameters.drive.{key}={value}" for key, value in STRONG.items()]
    return run(
        load(
            "walk",
            [
                *drive,
                *(
                    "start=standing",
                    "duration=2",
                    "expect:={}",
                    "pace=2.0",
                    "bounds.upper=[2.0, 0.5]",
                ),
                *("bounds.lower=[0.0, -0.5]", "automation=never-yields", "sensor=none"),
                f"plant.parameters.walker.on_lost_footing={choice}",
            ],
        )
    )


def test_a_run_says_that_and_when_the_footing_was_lost():
    result = slipping("end")
    assert result.summary["end"] == how_it_ended(result.summary) == "lost footing"
    when = result.summary["footing_lost_s"]
    assert when == result.trace["t"][-1]
    np.testing.assert_array_equal(result.trace["footing_held"], result.trace["t"] < when)
    marked = slipping("mark")
    assert marked.summary["end"] == "time"
    assert how_it_ended(marked.summary) == f"time, lost footing at {when:.4g} s"
    for each, early in ((result, True), (marked, False)):
        figure = run_figure(each)
        assert "LOST FOOTING" in figure.get_suptitle()
        assert ("ENDED EARLY" in figure.get_suptitle()) is early
        assert "lost footing" in figure.axes[0].get_legend_handles_labels()[1]


@pytest.mark.parametrize("name", ["puddle", "doorway", "carry", "walk", "paper-open-loop"])
def test_nobody_loses_their_footing_in_a_shipped_scenario(name):
    result = run(load(name))
    assert result.summary["footing_lost_s"] is None
    assert (result.trace["footing_held"] == 1.0).all()
