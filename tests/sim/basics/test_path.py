import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from cowalk.sim.basics.path import Path

poses = arrays(float, 3, elements=st.floats(-3.0, 3.0))
BENT = Path(((0.0, 0.0), (4.0, 0.0), (4.0, 5.0)))


@pytest.mark.parametrize(
    ("pose", "expected"),
    [
        ((1.0, 0.5, 0.1), (1.0, 0.5, 0.1)),
        ((-2.0, -1.0, 0.0), (-2.0, -1.0, 0.0)),
        ((3.5, 3.0, np.pi / 2), (7.0, 0.5, 0.0)),
        ((5.0, 8.0, 0.0), (12.0, -1.0, -np.pi / 2)),
    ],
)
def test_relative_pose_by_hand(pose, expected):
    np.testing.assert_allclose(BENT.relative_pose(pose), expected, atol=1e-12)


@given(arrays(float, 2, elements=st.floats(-12.0, 18.0)))
def test_the_offset_is_the_distance_from_the_path_outside_its_corners_too(position):
    station, offset, _ = BENT.relative_pose([*position, 0.0])
    on_path = BENT.point_at(np.linspace(-30.0, 40.0, 7001))
    nearest = np.hypot(*(on_path - position).T).min()
    assert abs(offset) == pytest.approx(nearest, abs=0.01)
    assert np.hypot(*(BENT.point_at(station) - position)) == pytest.approx(nearest, abs=0.01)


@given(st.floats(-3.0, 12.0), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_absolute_pose_inverts_relative_pose_on_a_straight_path(station, offset, heading):
    straight = Path(((1.0, 2.0), (4.0, 6.0)))
    relative = [station, offset, heading]
    np.testing.assert_allclose(
        straight.relative_pose(straight.absolute_pose(relative)), relative, atol=1e-9
    )


def test_path_length_and_points():
    assert BENT.length == 9.0
    np.testing.assert_allclose(
        BENT.point_at([-1.0, 2.0, 4.0, 6.0, 10.0]), [[-1, 0], [2, 0], [4, 0], [4, 2], [4, 6]]
    )


@pytest.mark.parametrize("points", [((0.0, 0.0),), ((0.0, 0.0), (0.0, 0.0))])
def test_degenerate_paths_are_refused(points):
    with pytest.raises(ValueError, match="path"):
        Path(points)


@given(poses)
def test_the_fast_relative_pose_is_the_same_one(pose):
    for path in (BENT, Path(((1.0, 2.0), (4.0, 6.0)))):
        np.testing.assert_allclose(path.relative(*pose), path.relative_pose(pose), atol=1e-12)
