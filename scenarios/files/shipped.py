"""The scenario files that ship, found by their names alone: cheap, for who only lists them."""

from __future__ import annotations

from pathlib import Path

SUFFIX = ".scenario.yaml"
"""How the name of a scenario file ends."""


def scenario_library() -> dict[str, Path]:
    """Return the scenarios that ship: file by name."""
    # Found, not imported: that takes a while.
    folder = Path(__file__).parents[1] / "library"
    return {file.name.removesuffix(SUFFIX): file for file in sorted(folder.glob(f"*{SUFFIX}"))}
