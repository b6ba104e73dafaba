"""What belongs to a person whatever they do: body, gait, arm and strength, drawn together."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from cowalk.agents.humans.laws.demand import FORCE_MAX
from cowalk.sim.basics.registry import did_you_mean
from cowalk.sim.basics.validators import Range, require_ranges
from cowalk.sim.body.anthropometry import BodyParameters
from cowalk.sim.body.gait import GaitParameters
from cowalk.sim.body.walker import RANGES as WALKER_RANGES

from ..files.validation import validate
from ..yaml_text.document import Fault, KeyPath, dotted
from .distribution import Distribution
from .sections import distributions, filled, read_distributions, try_ends

_CONFIG = ConfigDict(extra="forbid", frozen=True)

ARM_RANGES: dict[str, Range] = {
    "stiffness": WALKER_RANGES["hand_stiffness"],
    "damping": WALKER_RANGES["hand_damping"],
}


@dataclass(frozen=True)
class ArmParameters:
    """The arm about its posture, seen at the hand (`WalkerParameters.hand_stiffness`).

    Parameters
    ----------
    stiffness : float
        N/m.
    damping : float
        N s/m.

    Raises
    ------
    InputError
        If one is outside of `ARM_RANGES`.
    """

    stiffness: float = 100.0
    damping: float = 10.0

    def __post_init__(self) -> None:
        require_ranges(self, ARM_RANGES)


@dataclass(frozen=True)
class StrengthParameters:
    """The largest force with which a person insists: ``force_max`` of their model.

    Parameters
    ----------
    forward, sideways : float
        N.

    Raises
    ------
    InputError
        If one is no force that a human model takes.
    """

    forward: float = 7.5
    sideways: float = 7.5

    def __post_init__(self) -> None:
        require_ranges(self, {"forward": FORCE_MAX, "sideways": FORCE_MAX})


class Correlation(BaseModel):
    """Two traits that go together.

    Attributes
    ----------
    between : (str, str)
        Where their distributions stand: ``body.height``.
    correlation : float
        Of the normal scores: traits are drawn as a Gaussian copula, so between two normal
        distributions it is Pearson's.
    because : str
        The reason for the number.
    """

    model_config = _CONFIG

    between: tuple[str, str]
    correlation: Annotated[float, Field(ge=-1.0, le=1.0)]
    because: str = ""


class Traits(BaseModel):
    """People of one kind, for one women: what belongs to each whatever they do.

    Attributes
    ----------
    kind : str
        What they are called.
    weight : float
        Share of the population, relative to the other kinds.
    because : str
        The reason for the kind.
    body, gait : dict
        As for a plant that has bodies: ``height``, ``mass``; ``enabled``, ``fore_aft``,
        ``lateral``, ``step_frequency``.
    arm : dict
        See `ArmParameters`.
    strength : dict
        See `StrengthParameters`.
    correlations : tuple of Correlation
        Traits between which there is none are independent.
    """

    model_config = _CONFIG

    kind: str = ""
    weight: Annotated[float, Field(gt=0.0)] = 1.0
    because: str = ""
    body: dict[str, Any] = Field(default_factory=dict)
    gait: dict[str, Any] = Field(default_factory=dict)
    arm: dict[str, Any] = Field(default_factory=dict)
    strength: dict[str, Any] = Field(default_factory=dict)
    correlations: tuple[Correlation, ...] = ()

    @property
    def sections(self) -> dict[str, dict[str, Any]]:
        """What is drawn from, by section; empty ones are left out."""
        named = {name: getattr(self, name) for name in _Filled.model_fields}
        return {name: section for name, section in named.items() if section}

    @cached_property
    def laws(self) -> dict[KeyPath, Distribution]:
        """Every distribution, by its path."""
        return distributions(self.sections)

    @cached_property
    def _root(self) -> np.ndarray:
        """Return the symmetric root of the correlations: the same on any machine."""
        values, vectors = np.linalg.eigh(self.matrix(list(self.laws)))
        root: np.ndarray = (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
        return root

    def matrix(self, paths: list[KeyPath]) -> np.ndarray:
        """Return the correlations of the normal scores of distributions, shape (n, n)."""
        places = {dotted(path): index for index, path in enumerate(paths)}
        matrix = np.eye(len(places))
        for each in self.correlations:
            one, other = (places[name] for name in each.between)
            matrix[one, other] = matrix[other, one] = each.correlation
        return matrix

    def draw(self, rng: np.random.Generator) -> dict[str, dict[str, Any]]:
        """Return the sections of one person.

        Normal scores z with the stated correlations, each trait at its quantile Phi(z): a
        Gaussian copula (Nelsen, An Introduction to Copulas, 2nd ed., Springer 2006).
        """
        from scipy.special import ndtr

        scores = self._root @ rng.standard_normal(len(self.laws))
        drawn = zip(self.laws.items(), ndtr(scores), strict=True)
        return filled(self.sections, {path: law.at(float(share)) for (path, law), share in drawn})


class _Filled(BaseModel):
    """The sections of one person, as they must be."""

    model_config = _CONFIG

    body: BodyParameters = BodyParameters()
    gait: GaitParameters = GaitParameters()
    arm: ArmParameters = ArmParameters()
    strength: StrengthParameters = StrengthParameters()


def faults_of_traits(traits: Traits, at: KeyPath) -> list[Fault]:
    """Return what is wrong with people of one kind, which stand at a place of a file."""
    sections = traits.sections
    if "hand" in traits.body:
        place = (*at, "body", "hand")
        what = "which hand holds on is the scenario's: plant.parameters.body.hand"
        return [Fault(place, f"{dotted(place)}: {what}")]
    laws, faults = read_distributions(sections, at)
    if not faults:
        faults = try_ends(sections, laws, at, lambda tried: validate(_Filled, tried, at)[1])
    return faults or _faults_of_correlations(traits, list(laws), at)


def _faults_of_correlations(traits: Traits, paths: list[KeyPath], at: KeyPath) -> list[Fault]:
    known = [dotted(path) for path in paths]
    faults: list[Fault] = []
    pairs: set[frozenset[str]] = set()
    for index, each in enumerate(traits.correlations):
        place: KeyPath = (*at, "correlations", index, "between")
        named = dotted(place)
        for name in each.between:
            if name not in known:
                hint = did_you_mean(name, known) if known else "there is none"
                faults.append(Fault(place, f"{named}: {name!r} is no distribution here; {hint}"))
        pair = frozenset(each.between)
        if len(pair) < 2:
            faults.append(Fault(place, f"{named}: two different ones are expected"))
        elif pair in pairs:
            faults.append(Fault(place, f"{named}: these two are given twice"))
        pairs.add(pair)
    if not faults and known and np.linalg.eigvalsh(traits.matrix(paths)).min() < -1e-9:
        place = (*at, "correlations")
        what = "no numbers can be correlated like this; make the correlations smaller"
        faults.append(Fault(place, f"{dotted(place)}: {what}"))
    return faults
