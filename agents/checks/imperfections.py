"""Checks for imperfections of your own: one around a plain human is checked as a human."""

from __future__ import annotations

import inspect
from typing import Any

from cowalk.estimation.checks.rules import one_line
from cowalk.sim.basics.registry import marked_kind

from ..humans.steady import SteadyHuman
from .conformance import human_problems


def imperfection_problems(imperfection: Any) -> list[str]:
    """Return every fault of an imperfection, each with its cure (see `check_human`).

    Parameters
    ----------
    imperfection : object
        An instance, or a class that can be built with a human alone.
    """
    checked = imperfection
    if inspect.isclass(imperfection) or marked_kind(imperfection):
        build: Any = imperfection
        try:
            checked = build(human=SteadyHuman())
        except (Exception, SystemExit) as error:
            what = one_line(error)
            return [f"it cannot be built with a human alone ({what}): check an instance of it"]
    return human_problems(checked)
