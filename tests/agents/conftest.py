"""A situation and made-up observations for agents that are tested without a plant."""

import numpy as np
import pytest

from cowalk.agents import HUMANS
from cowalk.sim.basics.motion import TwistBounds
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.situation import Situation


@pytest.fixture
def situation():
    return Situation(
        Path(((0.0, 0.0), (30.0, 0.0))), 0.8, TwistBounds((0.0, -0.5), (1.2, 0.5)), 0.05
    )


@pytest.fixture
def observe():
    def make(twist=(0.8, 0.0), force=(0.0, 0.0), pose=(0.0, 0.0, 0.0), obstacles=(), time=0.0):
        rows = np.zeros((8, 4))
        for i, (x, y, radius) in enumerate(obstacles):
            rows[i] = [1.0, x, y, radius]
        return {
            "twist": np.array(twist, dtype=float),
            "force": np.tile(np.array(force, dtype=float), (12, 1)),
            "wrench": np.tile((*np.array(force, dtype=float), 0.0, 0.0, 0.0, 0.0), (12, 1)),
            "force_valid": np.ones(12),
            "pose": np.array(pose, dtype=float),
            "pose_world": np.array(pose, dtype=float),  # the path is the world's x axis
            "obstacles": rows,
            "time": np.array([time]),
        }

    return make


@pytest.fixture
def new_human(stand_in_recording):
    """Build a registered human by name; what has no default gets a stand-in."""
    needed = {"recorded": {"file": str(stand_in_recording)}}

    def build(name, **parameters):
        return HUMANS.get(name)(**needed.get(name, {}), **parameters)

    return build
