"""A number that differs from person to person: a distribution of scipy.stats, made finite."""

from __future__ import annotations

from typing import Any

import numpy as np
from pydantic import BaseModel, ConfigDict

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import nearest
from cowalk.sim.basics.validators import Range, require, require_range

PARAMETER: Range = (-1e12, 1e12, "")
SMALLEST = 1e-12
"""What a number of a person, or its spread, can be, and far more (inferred)."""
KEY = "distribution"
"""What tells a distribution from a plain section."""

_RESERVED = ("within", "because")


class Distribution(BaseModel):
    """A distribution of scipy.stats, cut off where ``within`` says.

    ``{distribution: norm, loc: 1.0, scale: 0.2, within: [0.5, 1.5], because: ...}``; every
    other key is a parameter of the distribution by its name in scipy.stats.

    Attributes
    ----------
    distribution : str
        Name in scipy.stats.
    within : (float, float), optional
        Bounds; what lies outside is never drawn (truncation, not clipping). A distribution
        without ends needs them.
    because : str
        The reason for these numbers.
    """

    model_config = ConfigDict(extra="allow", frozen=True)

    distribution: str
    within: tuple[float, float] | None = None
    because: str = ""

    def model_post_init(self, context: Any) -> None:
        """Find the distribution and its ends; see `InputError`s raised for what is checked."""
        from scipy import stats  # slow to import, and needed only where somebody is drawn

        family = getattr(stats, self.distribution, None)
        if not isinstance(family, stats.rv_continuous | stats.rv_discrete):
            names = [
                name
                for name in dir(stats)
                if isinstance(getattr(stats, name), stats.rv_continuous | stats.rv_discrete)
            ]
            near = nearest(self.distribution, names)
            what = "is no distribution of scipy.stats"
            cure = f"did you mean {near!r}?" if near else "see its list"
            raise InputError(f"distribution = {self.distribution!r} {what}; {cure}")
        shapes = family.shapes.split(", ") if family.shapes else []
        scale = [] if isinstance(family, stats.rv_discrete) else ["scale"]
        known = [*shapes, "loc", *scale]
        given: dict[str, Any] = dict(self.model_extra or {})
        for name, value in given.items():
            if name not in known:
                raise InputError(f"{name} is no parameter of {self.distribution}; it has {known}")
            if isinstance(value, bool) or not isinstance(value, int | float):
                raise InputError(f"{name} = {value!r}: a number is expected")
            require_range(name, value, PARAMETER)
            require(value == 0.0 or abs(value) >= SMALLEST, name, value, "too near to 0")
        for name in shapes:
            if name not in given:
                raise InputError(f"{self.distribution} needs a value of {name}")
        self._law = family(**given)
        self._whole = isinstance(family, stats.rv_discrete)
        with np.errstate(all="ignore"):  # far out, where scipy over- and underflows
            self._settle(given)

    def _settle(self, given: dict[str, Any]) -> None:
        """Find the ends, and how much lies between them."""
        low, high = (float(end) for end in self._law.support())
        if np.isnan(low):
            raise InputError(f"{self.distribution} cannot have {given}; see scipy.stats")
        if self.within is not None:
            low, high = max(low, self.within[0]), min(high, self.within[1])
        if not (np.isfinite(low) and np.isfinite(high)):
            raise InputError(f"{self.distribution} has no end; give within: [LOW, HIGH]")
        below = self._law.cdf(low - 1.0 if self._whole else low)
        if not self._law.cdf(high) > below:
            raise InputError(f"within = {self.within}: {self.distribution} has nothing there")
        self._ends, self._mass = (low, high), (float(below), float(self._law.cdf(high)))

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value that can be drawn."""
        return self._plain(self._ends[0]), self._plain(self._ends[1])

    def at(self, share: float) -> float:
        """Return the value that a share, in [0, 1), of the people does not exceed."""
        below, up_to = self._mass
        with np.errstate(all="ignore"):
            value = float(self._law.ppf(below + share * (up_to - below)))
        return self._plain(min(max(value, self._ends[0]), self._ends[1]))

    def _plain(self, value: float) -> float:
        return round(value) if self._whole else value
