"""The plants that ship, by name."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any

from ..basics.errors import InputError
from ..basics.rates import Rates
from ..basics.registry import Registry, did_you_mean
from .protocol import Plant

PLANTS: Registry[Plant] = Registry(
    "plant",
    {
        "unicycle": "cowalk.sim.unicycle.plant:UnicyclePlant",
        "bullet": "cowalk.sim.bullet.plant:BulletPlant",
    },
    protocol=Plant,
)


def build_plant(
    name: str, rates: Rates, given: Mapping[str, Any], window: bool = False
) -> tuple[Plant, bool]:
    """Return a plant, and whether it shows itself in a window.

    Parameters
    ----------
    name : str
        Registered plant or ``module:Class``.
    rates : Rates
    given : mapping
        Further arguments of its constructor.
    window : bool
        Whether it shall show itself, if it can.

    Raises
    ------
    InputError
        If the plant or an argument is unknown, or a value refused.
    """
    try:
        constructor = PLANTS.get(name)
    except InputError as error:
        raise error.inside("plant") from error
    accepted = inspect.signature(constructor).parameters
    if not any(item.kind is item.VAR_KEYWORD for item in accepted.values()):
        known = [key for key in accepted if key != "rates"]
        if unknown := [key for key in given if key not in known]:
            hint = did_you_mean(str(unknown[0]), known) if known else f"{name!r} takes none"
            at = "plant_parameters", str(unknown[0])
            raise InputError(f"{'.'.join(at)}: unknown key; {hint}", at)
    shows = window and "gui" in accepted
    return constructor(rates, **given, **({"gui": True} if shows else {})), shows
