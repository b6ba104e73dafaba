"""Numbers that make no sense, and those that would do nothing, are refused with what would."""

import math
import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.sim.bullet import BulletPlant
from cowalk.sim.bullet_coupling import CouplingParameters
from cowalk.sim.bullet_wheels import refuse_wide_track, wheels_urdf
from cowalk.sim.drive import RANGES, DriveParameters
from cowalk.sim.errors import InputError
from cowalk.sim.grip import GripParameters
from cowalk.sim.path import Path
from cowalk.sim.plant import Rates
from cowalk.sim.robot import RobotParameters, robot_of
from cowalk.sim.sensor_parameters import SensorParameters
from cowalk.sim.urdf import lump
from cowalk.sim.walker import WalkerParameters
from cowalk.sim.world import World


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
        (SensorParameters, {"latency": 100.0}, "latency = 100.0 s: it must lie between 0 and 1 s"),
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
        drive = replace(drive, wheel_track=widest)
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
