"""What each metric of a run is: its unit, its equation, and which direction is worse."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Worse = Literal["more", "less", "away from 0", ""]


@dataclass(frozen=True)
class Definition:
    """A metric.

    Attributes
    ----------
    unit, equation : str
    worse : {"more", "less", "away from 0", ""}
        Which direction is worse, for the human where the two sides differ; none where it only
        describes.
    missing_is_worst : bool
        Whether NaN says that it went as badly as it can, as no arrival does.
    dimensions : tuple of str
        Suffixes of a metric that is measured in each dimension apart.
    """

    unit: str
    equation: str
    worse: Worse = ""
    missing_is_worst: bool = False
    dimensions: tuple[str, ...] = ()


AXES = ("forward", "sideways")
"""Dimensions of a force, base axes."""
TWIST = ("v", "omega")
"""Dimensions of a twist."""

FAMILIES: dict[str, Definition] = {
    "progress": Definition("m", "station at the end less station at the start", "less"),
    "arrival time": Definition("s", "first t at the end of the path", "more", True),
    "distance walked": Definition("m", "∫|v| dt"),
    "path error": Definition("m", "RMS of the lateral offset from the automation's path", "more"),
    "largest lateral offset": Definition("m", "offset where its size is largest, left positive"),
    "smallest clearance": Definition("m", "min over t, of whichever thing is nearest", "less"),
    "intended effort": Definition("N s", "∫|F_intent| dt", "more", dimensions=("", *AXES)),
    "squared intended effort": Definition("N² s", "∫F_intent² dt", "more", dimensions=AXES),
    "true effort": Definition("N s", "∫|F_true| dt", "more", dimensions=("", *AXES)),
    "squared true effort": Definition("N² s", "∫F_true² dt", "more", dimensions=AXES),
    "peak true force": Definition("N", "max |F_true|"),
    "intended effort a metre": Definition(
        "N s/m", "∫|F_intent| dt / progress, from 0.1 m on", "more", True
    ),
    "work": Definition("J", "∫(F·v_handle + M·ω) dt of the human on the base, physics rate"),
    "shaking": Definition(
        "N", "RMS of F_intent within 0.3 to 1 Hz, Hann window", "more", dimensions=AXES
    ),
    "time apart": Definition("s", "time with |p_H - p| > 0.1·p_ub", "more", dimensions=TWIST),
    "disagreement": Definition("", "RMS of p_H - p", "more", dimensions=TWIST),
    "executed concession": Definition(
        "1",
        "Σ(p - p_A*)·sgn(p_H - p_A*) / Σ|p_H - p_A*| where |p_H - p_A*| > 0.1·p_ub",
        "less",
        dimensions=TWIST,
    ),
    "false concession": Definition(
        "1",
        "share of rows with |p_cmd - p_A*| > 0.1·p_ub, from 4 s on, where s ≤ 0.05",
        "more",
        dimensions=TWIST,
    ),
    "conflict share": Definition(
        "1",
        "share of rows with F_intent·drive < 0, both above their ripple",
        "more",
        dimensions=TWIST,
    ),
    "response lag": Definition(
        "s", "delay of p behind p_H by cross-correlation", "more", dimensions=TWIST
    ),
    "disagreements": Definition("1", "episodes of |p_H - p| > 0.1·p_ub", dimensions=TWIST),
    "resolved in time": Definition(
        "1",
        "share of them that the base ended, before what they were about",
        "less",
        dimensions=TWIST,
    ),
    "ended at it": Definition(
        "1", "share that ended while passing what they were about", dimensions=TWIST
    ),
    "ended after it": Definition("1", "share that ended later", dimensions=TWIST),
    "given in": Definition(
        "1", "share that the human ended, before what they were about", dimensions=TWIST
    ),
    "unresolved": Definition("1", "share that outlasted the run", "more", dimensions=TWIST),
    "log dimensionless jerk": Definition(
        "1", "-ln(T³/v_peak² · ∫(d²v/dt²)² dt) of v, of ω", "less", dimensions=TWIST
    ),
    "stubbornness RMSE": Definition(
        "1", "RMS of ŝ - s on identifiable rows", "more", dimensions=TWIST
    ),
    "stubbornness bias": Definition(
        "1", "mean of ŝ - s on identifiable rows", "away from 0", dimensions=TWIST
    ),
    "stubbornness coverage": Definition(
        "1", "share of them with s in the stated 90 % interval", "less", dimensions=TWIST
    ),
    "smoothed stubbornness RMSE": Definition(
        "1", "as above, of ŝ behind the smoother", "more", dimensions=TWIST
    ),
    "smoothed stubbornness lag": Definition(
        "s", "delay of it behind s by cross-correlation", dimensions=TWIST
    ),
    "wish direction": Definition(
        "1",
        "share of negotiations with (p̂_H - p)·(p_H - p) > 0, where |p_H - p| > 0.1·p_ub, "
        "from 3 s on",
        "less",
        dimensions=TWIST,
    ),
}
"""Every metric; one with dimensions stands for a metric in each of them."""

_TWIST_UNITS = dict(zip(TWIST, ("m/s", "rad/s"), strict=True))


def definitions() -> dict[str, Definition]:
    """Return every single metric by its name, in the order in which they are shown."""
    found = {}
    for family, each in FAMILIES.items():
        for suffix in each.dimensions or ("",):
            unit = each.unit or _TWIST_UNITS[suffix]
            name = f"{family}, {suffix}" if suffix else family
            found[name] = Definition(unit, each.equation, each.worse, each.missing_is_worst)
    return found
