"""Numbers that make no sense, and those that would do nothing, are refused with what would."""

import math

import pytest

from cowalk.sim.bullet_coupling import CouplingParameters
from cowalk.sim.drive import RANGES, DriveParameters
from cowalk.sim.errors import InputError
from cowalk.sim.grip import GripParameters
from cowalk.sim.sensor_parameters import SensorParameters
from cowalk.sim.walker import WalkerParameters


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


def test_defaults_written_out_are_no_mistake():
    CouplingParameters(kind="handle", mass=8.0, length=1.2, width=0.5)
    DriveParameters(kind="wheels", gain_forward=2000.0)
