"""The names by which `gymnasium.make` knows scenarios. It is imported with `cowalk.scenarios`.

So it imports nothing that takes time: Gymnasium itself takes fifty times as long.
"""

from __future__ import annotations

import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from importlib.machinery import ModuleSpec
    from types import ModuleType
    from typing import Any

ENTRY_POINT = "cowalk.scenarios.single_seat.environment:SingleSeatEnv"


def ids() -> dict[str, dict[str, Any]]:
    """Return what an environment is made with beside a user's arguments, by its id.

    There is one for every scenario that ships, ``cowalk/PaperOpenLoop-v0`` for
    ``paper-open-loop``, and ``cowalk/Scenario-v0`` for the argument ``scenario``.
    """
    from ..files.shipped import scenario_library

    shipped = {f"cowalk/{_camel_case(name)}-v0": {"scenario": name} for name in scenario_library()}
    return {"cowalk/Scenario-v0": {}, **shipped}


def _camel_case(name: str) -> str:
    return "".join(word.capitalize() for word in name.split("-"))


def register() -> None:
    """Tell Gymnasium all ids, or do so once it is imported."""
    if "gymnasium" in sys.modules:
        _register()
    elif not any(isinstance(finder, _AtGymnasium) for finder in sys.meta_path):
        sys.meta_path.insert(0, _AtGymnasium())


def _register() -> None:
    from gymnasium.envs.registration import register, registry

    for name, arguments in ids().items():
        if name not in registry:
            register(name, ENTRY_POINT, kwargs=arguments)


class _AtGymnasium:
    """Waits in `sys.meta_path` for Gymnasium to be imported, whoever does it."""

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Find Gymnasium as ever, and register once it has been executed."""
        if name != "gymnasium":
            return None
        from importlib.util import find_spec

        sys.meta_path.remove(self)
        spec = find_spec(name)
        if spec is None or spec.loader is None:
            return spec
        execute = spec.loader.exec_module

        def then_register(module: ModuleType) -> None:
            execute(module)
            _register()

        spec.loader.exec_module = then_register  # type: ignore[method-assign]
        return spec
