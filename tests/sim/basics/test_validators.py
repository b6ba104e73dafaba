"""Numbers that make no sense, and those that would do nothing, are refused with what would."""

import dataclasses
import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import TwistBounds
from cowalk.sim.basics.parameters import parameters
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.anthropometry import BodyParameters
from cowalk.sim.body.gait import GaitParameters
from cowalk.sim.body.grip import GripParameters
from cowalk.sim.body.walker import WalkerParameters
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.bullet.wheel_base import refuse_wide_track, wheels_urdf
from cowalk.sim.robot.coupling import CouplingParameters
from cowalk.sim.robot.drive import RANGES, DriveParameters
from cowalk.sim.robot.robot import RobotParameters, robot_of
from cowalk.sim.sensor.parameters import SensorParameters
from cowalk.sim.sensor.presets import sensor_preset
from cowalk.sim.sensor.wrench import SensorMount
from cowalk.sim.urdf.rigid import lump
from cowalk.sim.world.world import World


@pytest.mark.parametrize("name", RANGES)
def test_a_drive_has_its_ends_and_nothing_beyond(name):
    low, high, unit = RANGES[name]
    kind = "wheels" if name == "friction" else "slip"
    for end in (low, high):
        DriveParameters(kind=kind, **{name: end})
    for value in (-1.0, 1.001 * high, math.inf, math.nan):
        words = rf"^{name} = {value}.*: must lie between {low:g} and .*{unit.replace('^', '.')}$"
        with pytest.raises(InputError, match=words.replace("+", ".")):
            DriveParameters(kind=kind, **{name: value})


@pytest.mark.parametrize(
    ("kind", "given", "words"),
    [
        (DriveParameters, {"max_force": 0.0}, "max_force = 0.0 N: must lie between 1 and 10000 N"),
        (DriveParameters, {"gain_forward": 0.0}, "gain_forward = 0.0 N s/m: must lie between 10"),
        (DriveParameters, {"delay": 100.0}, "delay = 100.0 s: must lie between 0 and 1 s"),
        (SensorParameters, {"latency": 100.0}, "latency = 100.0 s: must lie between 0 and 1 s"),
        (WalkerParameters, {"delay": 100.0}, "delay = 100.0 s: must lie between 0 and 0.3 s"),
        (WalkerParameters, {"hand_stiffness": math.inf}, "hand_stiffness = inf N/m: must lie"),
        (CouplingParameters, {"kind": "stretcher", "mass": 0.0}, "mass = 0.0 kg: must lie between"),
        (GripParameters, {"kind": "compliant", "damping": (math.inf,) * 3}, "3 finite numbers"),
        (CouplingParameters, {"mass": 20.0}, "mass = 20.0: has no effect with kind = 'handle'"),
        (CouplingParameters, {"width": 0.4}, "only with 'stretcher'; leave it out"),
        (DriveParameters, {"friction": 0.5}, "friction = 0.5: has no effect with kind = 'slip'"),
        (DriveParameters, {"kind": "wheels", "gain_yaw": 9.0}, "gain_yaw = 9.0: has no effect"),
        (GripParameters, {"damping": (9.0, 9.0, 9.0)}, "no effect with kind = 'rigid'"),
        (GripParameters, {"slip_length": 0.1}, "slip_length = 0.1: has no effect"),
    ],
)
def test_senseless_and_idle_numbers_are_refused(kind, given, words):
    with pytest.raises(InputError, match=words) as refused:
        kind(**given)
    assert "\n" not in str(refused.value)


SHIPPED = robot_of(RobotParameters(), "left", "handle").rigid
SIZES = ["wheel_track", "wheel_radius"]


@given(*(st.floats(*RANGES[name][:2]) for name in SIZES))
def test_wheels_leave_the_base_moments_of_inertia_that_a_body_can_have(track, radius):
    drive = DriveParameters(kind="wheels", wheel_track=track, wheel_radius=radius)
    try:
        refuse_wide_track(SHIPPED, drive)
    except InputError as error:
        # What it proposes is taken, and what it refuses is not far beyond what no body has.
        widest = float(re.search(r"must be ([\d.]+) m or less", str(error))[1])
        assert 1.2 < widest < track
        drive = dataclasses.replace(drive, wheel_track=widest)
        refuse_wide_track(SHIPPED, drive)
    root = ElementTree.fromstring(wheels_urdf(SHIPPED, drive))
    for inertia in root.iter("inertia"):
        xx, yy, zz = sorted(float(inertia.get(key)) for key in ("ixx", "iyy", "izz"))
        assert xx > 0.0
        assert zz <= xx + yy
    whole = lump(root)
    assert whole.mass == pytest.approx(SHIPPED.mass)
    assert whole.yaw_inertia == pytest.approx(SHIPPED.yaw_inertia), "wheels and body together"


def test_a_base_on_the_widest_track_drives_and_a_wider_one_is_refused():
    with pytest.raises(InputError, match=r"^drive\.wheel_track = 1\.5 m: .* must be") as refused:
        BulletPlant(Rates(), drive={"kind": "wheels", "wheel_track": 1.5})
    widest = float(re.search(r"must be ([\d.]+) m", str(refused.value))[1])
    plant = BulletPlant(Rates(), drive={"kind": "wheels", "wheel_track": widest})
    plant.reset(World(Path(((0.0, 0.0), (20.0, 0.0)))), np.random.default_rng(0))
    for _ in range(80):
        state = plant.step((0.6, 0.3), (0.0, 0.0))
    plant.close()
    assert state.twist == pytest.approx((0.6, 0.3), abs=0.02)


def test_defaults_written_out_are_no_mistake():
    CouplingParameters(kind="handle", mass=8.0, length=1.2, width=0.5)
    DriveParameters(kind="wheels", gain_forward=2000.0)


KINDS = (
    *(BodyParameters, CouplingParameters, DriveParameters, GaitParameters, GripParameters, Rates),
    *(RobotParameters, SensorMount, SensorParameters, TwistBounds, WalkerParameters),
)
OTHERWISE = {
    bool: ("no", 1, None),
    int: ("20", 20.5, True, math.nan, None),
    float: ("tall", True, [1.0], {}, math.nan),
    str: (3, [], True),
    tuple: (3.0, "abc", (1.0,), (1.0, "a", 2.0), (1.0, True), [[1.0], [2.0], [3.0]]),
    dict: (3, [], "a", True, None, {"a": "b"}, {3: 1.0}),
    type(None): ([1.0], {}, True),
}
"""What is wrong for a value of each kind."""


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_a_value_of_another_kind_is_refused_with_its_name(kind):
    usual = kind()
    for item in dataclasses.fields(kind):
        for value in OTHERWISE[type(getattr(usual, item.name))]:
            if kind is SensorParameters and value == [1.0]:
                continue  # the wrong number of a list that may be given: see test_sensor
            with pytest.raises(InputError, match=rf"^(rates\.)?{item.name}[ .]") as refused:
                kind(**{item.name: value})
            assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (3, "body = 3: give a mapping or BodyParameters of height, mass, hand"),
        ({"height": "tall"}, "body.height = 'tall': a number is expected, in m"),
        ({"height": True}, "body.height = True: a number is expected, in m"),
        ({"height": 0.3}, "body.height = 0.3 m: must lie between 1.2 and 2.2 m"),
        ({3: 1.8}, "body.3: unknown key; known: height, mass, hand"),
        (RobotParameters(), "body = RobotParameters.*: give a mapping or BodyParameters"),
    ],
)
def test_a_section_says_where_it_is_wrong(given, words):
    with pytest.raises(InputError, match=f"^{words}"):
        parameters("body", BodyParameters, given)


def test_a_number_may_come_from_numpy_and_a_list_be_an_array():
    assert BodyParameters(height=np.float32(1.5)).height == 1.5
    assert Rates(control=np.int64(40)).control == 40
    assert SensorMount(position=np.array([0.1, 0.0, 0.0])).position == (0.1, 0.0, 0.0)
    assert TwistBounds(upper=[1.0, 0.3]).upper == (1.0, 0.3)
    matrix = np.array([[0.0, 0.1], [0.2, 0.0]])
    sensor = SensorParameters(bias=np.array([1.0, 2.0]), cross_talk=matrix)
    assert sensor == SensorParameters(bias=(1.0, 2.0), cross_talk=((0.0, 0.1), (0.2, 0.0)))


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"cross_talk": math.nan}, "cross_talk = nan: must lie between 0 and 0.5"),
        ({"cross_talk": -0.5}, "cross_talk = -0.5: must lie between 0 and 0.5"),
        ({"cross_talk": 1e9}, "cross_talk = 1000000000.0: must lie between 0 and 0.5"),
        ({"cross_talk": ((0.0, 1e9), (0.0, 0.0))}, "cross_talk = 1000000000.0: must lie between"),
        ({"noise_density": 1e300}, "noise_density = 1e[+]300 N/sqrt.Hz.: must lie between 0 and"),
        ({"torque_bias": (0.0, -1e300)}, "torque_bias = -1e[+]300 N m: must lie between -10000"),
        ({"drift": math.inf}, "drift = inf N/h: must lie between"),
        ({"tare": "no"}, "tare = 'no': true or false is expected"),
        ({"rate": 1e-4}, "rate = 0.0001 Hz: must lie between 1 and .* Hz, or be 0"),
        ({"range": 0.0}, "range = 0.0 N: must lie between .* N, or be left out"),
        ({"range": 1.0, "resolution": 1.5}, "resolution = 1.5 N: must not be above range = 1.0 N"),
        (
            {"torque_range": 1.0, "torque_resolution": 2.0},
            "torque_resolution = 2.0 N m: must not be above torque_range = 1.0 N m",
        ),
    ],
)
def test_a_sensor_that_nobody_can_have_is_refused(given, words):
    with pytest.raises(InputError, match=f"^{words}"):
        SensorParameters(**given)
    with pytest.raises(InputError, match=f"^sensor.{words}"):
        sensor_preset("laboratory", **given)


def test_a_preset_has_no_other_keys():
    with pytest.raises(InputError, match=r"^sensor.rang: unknown key; did you mean 'range'\?"):
        sensor_preset("laboratory", rang=3.0)


def test_a_sensor_may_have_as_many_faults_as_its_ranges_allow():
    SensorParameters(rate=1.0, range=1.0, resolution=1.0, cross_talk=0.5, low_pass=0.1)
    SensorParameters(rate=0, low_pass=0, range=math.inf, bias=-1e4, drift=(1e5, -1e5))
    SensorParameters(cross_talk=((-1.0, 0.0), (0.0, -1.0)))  # two dead channels


@pytest.mark.parametrize(
    ("parameters", "at"),
    [
        ({"robot": {"handle": "gripp"}}, ("robot", "handle")),
        ({"robot": {"urdf": "nowhere.urdf"}}, ("robot", "urdf")),
        ({"robot": {"urdf": __file__}}, ("robot", "urdf")),
        ({"mount": {"position": (0.0, 9.0, 0.0)}}, ("mount", "position")),
        ({"mount": {"rpy": (0.0, 0.0, 99.0)}}, ("mount", "rpy", 2)),
        ({"drive": {"gain_forward": 1e6}}, ("drive", "gain_forward")),
        ({"drive": {"kind": "wheels", "wheel_track": 2.0}}, ("drive", "wheel_track")),
        ({"walker": {"stiffness": 1e8}}, ("walker", "stiffness")),
        ({"gait": {"percentile": 99.0}}, ("gait", "percentile")),
        ({"body": {"hands": 2}}, ("body", "hands")),
    ],
)
def test_an_error_carries_its_place_as_data(parameters, at):
    with pytest.raises(InputError, match=rf"^{'.'.join(map(str, at))}\b") as refused:
        BulletPlant(Rates(), **parameters)
    assert refused.value.at == at
