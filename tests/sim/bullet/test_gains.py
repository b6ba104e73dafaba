"""Gains that the physics step cannot carry are refused, and those it can carry are not."""

import itertools
import re

import numpy as np
import pytest

from cowalk.sim.basics.errors import InputError, SimulationError
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.anthropometry import BodyParameters
from cowalk.sim.body.grip import GripParameters
from cowalk.sim.body.walker import WalkerParameters
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.pair import design as pair_design
from cowalk.sim.pair.stability import Linear
from cowalk.sim.world.world import World

WORLD = World(Path(((0, 0), (20, 0))))
OPTIONS = [
    *itertools.product(
        ("slip", "wheels"), ("rigid", "compliant"), ("handle", "stretcher"), ("left", "both")
    )
]


def walk(steps=100, **options):
    plant = BulletPlant(Rates(), **options)
    try:
        plant.reset(WORLD, np.random.default_rng(0))
        for step in range(steps):
            plant.step((0.8, 0.2), (3.0 * np.sin(0.3 * step), 4.0))
    finally:
        plant.close()


def with_gain(option, key, value):
    section, name = key.split(".")
    scalar = section == "walker"
    return option | {section: option.get(section, {}) | {name: value if scalar else (value,) * 3}}


@pytest.mark.parametrize("option", OPTIONS, ids="-".join)
def test_the_largest_gain_named_works_and_twice_of_it_diverges(option, monkeypatch):
    drive, grip, coupling, hand = option
    option = {
        "drive": {"kind": drive},
        "grip": {"kind": grip},
        "coupling": {"kind": coupling},
        "body": {"hand": hand},
    }
    keys = ["walker.hand_damping"] + ["grip.damping"] * (grip == "compliant")
    if drive == "wheels" and grip == "rigid":  # friction and the wheels' motors damp what shakes
        keys = ["walker.damping"]
        option["walker"] = {"traction": 10.0}  # feet that slide bound what legs do
    for key in keys:
        with pytest.raises(InputError, match=key) as refused:
            walk(**with_gain(option, key, 1e5))
        largest = float(re.search(r"at most \(?([\d.e+]+)", str(refused.value))[1])
        walk(**with_gain(option, key, largest))
        with pytest.raises(InputError, match=key):
            walk(**with_gain(option, key, 1.1 * largest))
        with monkeypatch.context() as patch:
            patch.setattr(pair_design, "refuse_unstable", lambda *_: None)
            with pytest.raises(SimulationError, match=r"diverged .* gains of walker"):
                walk(300, **with_gain(option, key, 2.0 * largest))


@pytest.mark.parametrize(
    ("option", "words"),
    [
        ({"walker": {"hand_stiffness": 1e6}}, r"walker.hand_stiffness = 1e\+06: .* at most"),
        ({"grip": {"kind": "compliant", "damping": (1e5,) * 3}}, r"grip.damping = .* at most \(2"),
        ({"walker": {"damping": 0.0}}, "walker.damping = 0: the bodies would diverge; at least"),
        ({"walker": {"delay": 0.25}}, "walker.delay = 0.25 s: the legs would swing up; at most"),
        (
            {"walker": {"hand_stiffness": 1e6, "hand_damping": 1e3}},
            "walker.hand_stiffness, walker.hand_damping: together",
        ),
        (
            {"walker": {"hand_damping": 150.0}, "grip": {"release_force": 20.0}},
            "walker.hand_damping = 150: .* at most",  # which a held arm could
        ),
    ],
)
def test_the_parameter_that_is_to_blame_is_named(option, words):
    with pytest.raises(InputError, match=words) as refused:
        BulletPlant(Rates(), **option)
    assert "\n" not in str(refused.value)


def test_physics_that_is_too_slow_is_told_what_is_fast_enough():
    compliant = {"kind": "compliant"}
    with pytest.raises(InputError, match=r"rates.physics = 60 Hz: .* 120 works"):
        BulletPlant(Rates(20, 60, 20), grip=compliant)
    BulletPlant(Rates(20, 120, 20), grip=compliant).close()


@pytest.mark.parametrize("stiffness", [0.0, 1e4, 7e4])
def test_one_mass_meets_the_closed_form(stiffness):
    """h^2 k/m + 2 h b/m < 4 for a mass on spring and damper, forces renewed at every step."""
    mass, step = 2.0, 0.01
    linear = object.__new__(Linear)
    linear.count, linear.step, linear.body = 6, step, BodyParameters()
    linear._inverse = np.eye(6) / mass
    linear._drive, linear._legs, linear._still = np.zeros((6, 6)), np.zeros((3, 6)), np.eye(3, 6)
    linear._ridden = np.zeros((3, 3))  # the base stands still
    own = np.eye(6)[3:5]
    linear._hands = [(own, own, np.eye(6)[5])]
    limit = (4.0 - step**2 * stiffness / mass) * mass / (2.0 * step)

    def growth(damping):
        walker = WalkerParameters(0.0, 0.0, 0.0, 0.0, 0.0, stiffness, damping)
        return linear.growth(walker, GripParameters(), 1, lost=True)

    assert growth(0.999 * limit) <= 1.0 + 1e-9
    assert growth(1.001 * limit) > 1.0 + 1e-6


@pytest.mark.parametrize(
    ("drive", "physics", "words"),
    [
        ({"gain_sideways": 1e6}, 240, "a base of 40 kg and a physics step of 4.2 ms carry at most"),
        ({"gain_forward": 1999.0}, 60, "carry at most 1200; lower it or raise rates.physics"),
        ({"gain_yaw": 1e4}, 240, "drive.gain_yaw = 10000 N m s/rad: a base of"),
    ],
)
def test_a_drive_gain_that_would_be_cut_is_refused(drive, physics, words):
    with pytest.raises(InputError) as refused:
        BulletPlant(Rates(physics=physics, sensor=20), drive=drive)
    assert words in str(refused.value)
    assert "\n" not in str(refused.value)


def test_default_gains_of_the_drive_go_with_the_physics_step():
    BulletPlant(Rates(physics=60, sensor=20)).close()
