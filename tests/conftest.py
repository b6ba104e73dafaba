"""What tests of several parts share."""

import numpy as np
import pytest

pytest_plugins = ["pytester"]


@pytest.fixture(scope="session")
def stand_in_recording(tmp_path_factory):
    """A made-up recording in the form of the shared ones: 500 Hz, 4 s, a few newtons."""
    time = np.arange(2000) * 0.002
    fx, fy = 1.5 * np.sin(2.0 * time), 3.0 * np.cos(1.3 * time)
    file = tmp_path_factory.mktemp("recordings") / "recording.csv"
    rows = np.column_stack((time, fx, fy))
    np.savetxt(file, rows, delimiter=",", header="t_s,fx_n,fy_n", comments="", fmt="%.6f")
    return file
