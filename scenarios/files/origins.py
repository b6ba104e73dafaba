"""Where every value of a scenario comes from: its file, an override, or a default."""

from __future__ import annotations

from typing import Any, Literal

from ..yaml_text.document import KeyPath, dotted, parse
from .assembling import resolve
from .loading import Reading, leaves, plain, to_yaml
from .parts import part_at
from .schema import Scenario, section_model

Origin = Literal["file", "flag", "default"]


def origins(reading: Reading) -> dict[str, Origin]:
    """Return where every value of the final scenario comes from, by its dotted key."""
    found = _origins(reading, resolve(reading.scenario))
    return {dotted(path): origin for path, origin in found.items()}


def marked(reading: Reading) -> str:
    """Return the final scenario as YAML, the origin of every value behind it."""
    scenario = resolve(reading.scenario)
    text = to_yaml(scenario, width=10_000)
    document = parse(text)
    at = {document.line(path): origin for path, origin in _origins(reading, scenario).items()}
    lines = text.splitlines()
    width = min(72, max(len(line) for line in lines))
    shown = []
    for number, line in enumerate(lines, start=1):
        mark = f"# {at[number]}" if number in at else ""
        shown.append(f"{line:<{width}}  {mark}".rstrip())
    return "\n".join(shown) + "\n"


def _origins(reading: Reading, scenario: Scenario) -> dict[KeyPath, Origin]:
    return {path: _origin(reading, path, value) for path, value in leaves(plain(scenario))}


def _origin(reading: Reading, path: KeyPath, value: Any) -> Origin:
    for end in range(len(path), 0, -1):
        if path[:end] in reading.given and all(isinstance(step, int) for step in path[end:]):
            return reading.given[path[:end]]
    part = part_at(path[:1])
    if part is not None and part.preset:  # what is not given follows the preset
        usual = plain(section_model(part)()).get(path[1])  # type: ignore[call-arg]
        if value != usual:
            return reading.given.get((part.key, part.named_by), "default")
    return "default"
