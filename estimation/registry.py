"""The smoothers and observers that ship, by name."""

from __future__ import annotations

from cowalk.sim.basics.registry import Registry

from .observers.protocol import Observer
from .smoothers.protocol import Smoother

SMOOTHERS: Registry[Smoother] = Registry(
    "smoother",
    {
        "moving-average": "cowalk.estimation.smoothers.moving_average:MovingAverage",
        "kalman": "cowalk.estimation.smoothers.kalman:KalmanSmoother",
    },
    "cowalk.smoothers",
    methods=("reset", "update"),
)

OBSERVERS: Registry[Observer] = Registry(
    "observer",
    {"paper": "cowalk.estimation.observers.paper:PaperObserver"},
    "cowalk.observers",
    methods=("reset", "update"),
)
