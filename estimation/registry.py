"""The front ends, smoothers and observers that ship, by name."""

from __future__ import annotations

from cowalk.sim.basics.registry import Registry

from .front_ends.protocol import FrontEnd
from .observers.protocol import Observer
from .smoothers.protocol import Smoother

FRONT_ENDS: Registry[FrontEnd] = Registry(
    "front end",
    {
        "none": "cowalk.estimation.front_ends.none:NoFrontEnd",
        "mean": "cowalk.estimation.front_ends.mean:SlidingMean",
    },
    "cowalk.front_ends",
    protocol=FrontEnd,
)

SMOOTHERS: Registry[Smoother] = Registry(
    "smoother",
    {
        "moving-average": "cowalk.estimation.smoothers.moving_average:MovingAverage",
        "kalman": "cowalk.estimation.smoothers.kalman:KalmanSmoother",
    },
    "cowalk.smoothers",
    protocol=Smoother,
)

OBSERVERS: Registry[Observer] = Registry(
    "observer",
    {"paper": "cowalk.estimation.observers.paper:PaperObserver"},
    "cowalk.observers",
    protocol=Observer,
)
