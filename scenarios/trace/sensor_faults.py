"""How much of what the force sensor read was lost or at the end of its range."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from cowalk.sim.sensor.sensor import Reading

FAULTS = {
    "saturated": "at the end of a channel's range",
    "lost": "lost on their way, an older one read again",
}
"""What may be wrong with a sample, and how that is said."""


class SampleCount:
    """Samples of a run, and how many of them were saturated or lost."""

    def __init__(self) -> None:
        self._samples = self._saturated = self._lost = 0

    def add(self, reading: Reading) -> None:
        """Count a block of samples."""
        n = len(reading.valid)
        self._samples += n
        # Counting bytes takes a tenth of the time of summing so few.
        self._saturated += reading.saturated.tobytes().count(1)
        self._lost += n - reading.valid.tobytes().count(1)

    def summary(self) -> dict[str, float]:
        """Return their number, ``samples``, and shares of it, ``saturated`` and ``lost``."""
        whole = max(1, self._samples)
        return {
            "samples": self._samples,
            "saturated": self._saturated / whole,
            "lost": self._lost / whole,
        }


def percent(share: float) -> str:
    """Return a share in per cent with two digits, or whole; all of it is said of nothing less."""
    value = 100.0 * share
    if value < 9.95:
        return f"{value:.2g} %"
    return f"{value:.0f} %" if share == 1.0 or value < 99.5 else "over 99 %"


def sensor_faults(summary: Mapping[str, Any]) -> str | None:
    """Return what a run's summary says of its sensor, in words; None if all samples were well."""
    shares = summary.get("sensor") or {}
    said = [
        f"{percent(shares[fault])} of samples {words}"
        for fault, words in FAULTS.items()
        if shares.get(fault)
    ]
    return "; ".join(said) or None
