"""The table in ARCHITECTURE.md: which part may import which."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
# Words that every part speaks: no state, no engine.
VOCABULARY = {
    f"cowalk.sim.{name}" for name in ("errors", "motion", "observation", "path", "registry")
}
ALLOWED = {
    "sim": set(),
    "estimation": VOCABULARY,
    "agents": VOCABULARY | {"cowalk.estimation"},
    "scenarios": {"cowalk.sim", "cowalk.estimation", "cowalk.agents"},
}
FILES = [file for part in ALLOWED for file in sorted((ROOT / part).rglob("*.py"))]


def imported(file):
    """Return every module a file imports from outside its own part, with absolute names."""
    names = set()
    package = ("cowalk", *file.relative_to(ROOT).parent.parts)
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            names.add(".".join((*base, *([node.module] if node.module else []))))
    return names


def test_there_are_files_to_check():
    assert len(FILES) > 30


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(ROOT)))
def test_imports_follow_the_table(file):
    part = file.relative_to(ROOT).parts[0]
    for name in imported(file):
        if name.startswith("cowalk.") and not name.startswith(f"cowalk.{part}"):
            assert any(name == ok or name.startswith(f"{ok}.") for ok in ALLOWED[part]), name


def test_only_one_module_imports_pybullet():
    importing = re.compile(r"^\s*(import|from) pybullet|import_module\(.pybullet", re.MULTILINE)
    users = [str(file.relative_to(ROOT)) for file in FILES if importing.search(file.read_text())]
    assert users == ["sim/bullet_engine.py"]


def test_parts_do_not_import_each_other_in_circles():
    order = list(ALLOWED)
    for file in FILES:
        part = order.index(file.relative_to(ROOT).parts[0])
        for name in imported(file):
            for later in order[part + 1 :]:
                assert not name.startswith(f"cowalk.{later}"), (file, name)
