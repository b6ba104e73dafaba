"""What several tests of the plant share."""

import pytest

from cowalk.sim.robot import drive


@pytest.fixture
def coasting(monkeypatch):
    """Parameters, by kind of drive, of a base that coasts: no user can have one."""
    monkeypatch.setattr(drive, "RANGES", {})
    slip = ("gain_forward", "gain_sideways", "gain_yaw", "max_force", "max_torque")
    return {
        "slip": dict.fromkeys(slip, 0.0),
        "wheels": dict.fromkeys(("friction", "max_force"), 0.0),
    }
