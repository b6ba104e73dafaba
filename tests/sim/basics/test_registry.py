import pytest

from cowalk.agents import AUTOMATIONS, HUMANS
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import Registry
from cowalk.sim.plant.registry import PLANTS

MODULE = """
class Empty:
    pass

value = 3
"""


@pytest.fixture(autouse=True)
def module(tmp_path, monkeypatch):
    (tmp_path / "parts_of_mine.py").write_text(MODULE)
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("registry", [HUMANS, AUTOMATIONS, PLANTS], ids=lambda r: r.kind)
def test_a_class_of_another_kind_is_refused_by_what_it_lacks(registry):
    with pytest.raises(InputError, match=f"{registry.kind} .* has no method 'reset'; .* needs"):
        registry.get("parts_of_mine:Empty")


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("parts_of_mine:Missing", "cannot be imported"),
        ("parts_of_nobody:Empty", "cannot be imported"),
        ("parts_of_mine:value", "is not a class"),
        ("steadyy", "did you mean 'steady'"),
    ],
)
def test_names_that_lead_nowhere_are_refused(name, said):
    with pytest.raises(InputError, match=said):
        HUMANS.get(name)


def test_a_module_that_ends_the_program_is_refused(tmp_path):
    (tmp_path / "script_of_mine.py").write_text("import sys\nsys.exit(0)\n")
    with pytest.raises(InputError, match="importing it ends the program"):
        HUMANS.get("script_of_mine:Human")


def test_a_module_that_fails_when_imported_is_refused_and_described(tmp_path):
    (tmp_path / "failing_part.py").write_text("1 / 0\n")
    parts = Registry("human", {"failing": "failing_part:Human"})
    with pytest.raises(InputError, match="cannot be imported: ZeroDivisionError"):
        parts.get("failing")
    assert "cannot be imported: ZeroDivisionError" in parts.describe("failing")


def test_every_registered_name_can_be_imported():
    for registry in (HUMANS, AUTOMATIONS, PLANTS):
        assert all(callable(registry.get(name)) for name in registry)
