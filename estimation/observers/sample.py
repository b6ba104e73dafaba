"""What reaches an estimator after every control step."""

from __future__ import annotations

from dataclasses import dataclass

from cowalk.sim.basics.motion import Array


@dataclass(frozen=True, slots=True)
class Sample:
    """One control step as the automation has measured it (leading batch axes come first).

    Attributes
    ----------
    wrench : ndarray, shape (..., samples, 6)
        Measured force (N) and torque (N m) of the human on the base at every sensor instant of
        the step, oldest first: base axes, about the handle. A push to the left that asks for a
        turn to the left is positive wherever the hands are.
    valid : ndarray, shape (..., samples)
        1 where the sample arrived, 0 where it was lost and repeats the one before.
    twist : ndarray, shape (..., 2)
        Executed twist at the end of the step, m/s and rad/s.
    pose : ndarray, shape (..., 3)
        Base pose at the end of the step, world axes: m, m, rad.
    dt : float
        Control period, s.
    time : float or ndarray, shape (...)
        Since reset, s.
    """

    wrench: Array
    valid: Array
    twist: Array
    pose: Array
    dt: float
    time: float | Array

    @property
    def force(self) -> Array:
        """The planar force, N, shape (..., samples, 2)."""
        return self.wrench[..., :2]
