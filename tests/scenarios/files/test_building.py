from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
import pytest
from numpy.typing import ArrayLike

from cowalk.scenarios.files.building import attempt, check_parameters, complete
from cowalk.scenarios.files.schema import Component
from cowalk.scenarios.yaml_text.document import Fault
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import Registry, part


@dataclass
class Shape:
    width: float = 1.0
    corners: tuple[float, ...] = ()


class Walker:
    def __init__(
        self,
        speed: float,
        steps: int = 3,
        side: Literal["left", "right"] = "left",
        shape: Shape | None = None,
        copy: bool = False,
        weights: ArrayLike = (1.0,),
        names: Sequence[str] = (),
        rates: object = None,
    ) -> None:
        if speed < 0.0:
            raise InputError(f"speed = {speed}: must not be negative", ("speed",))
        if steps < 0:
            raise TypeError("a bug in here")
        self.given = (speed, steps, side, shape, copy, weights, names, rates)


@dataclass(kw_only=True)
class Base:
    pair: tuple[float, float] = (1.0, 2.0)
    helper: object = field(default=None)


@dataclass(kw_only=True)
class Derived(Base):
    gain: float = 2.0


@part("walker")
def unannotated(size, **others):
    return (size, others)


@part("walker")
def for_checkers_alone(size: "NowhereToBeFound", rate: float = 1.0):  # noqa: F821
    return (size, rate)


WALKERS = Registry(
    "walker",
    {
        name: f"{__name__}:{address}"
        for name, address in {
            "walker": "Walker",
            "derived": "Derived",
            "unannotated": "unannotated",
            "for-checkers": "for_checkers_alone",
        }.items()
    },
)


def component(name="walker", **parameters):
    return Component(name=name, parameters=parameters)


def build(registry, component, at, **shared):
    made = attempt(registry, component, at, shared, {name: name for name in shared})
    if isinstance(made, Fault):
        raise made.error()
    return made


def refusal(name="walker", shared=None, **parameters):
    with pytest.raises(InputError) as error:
        build(WALKERS, component(name, **parameters), ("robot",), **(shared or {}))
    assert "\n" not in str(error.value)
    return str(error.value)


def test_parameters_arrive_as_the_constructor_annotates_them():
    shape = {"width": 2, "corners": [1, 2]}
    walker = build(
        WALKERS, component(speed=1, shape=shape, copy=True, names=["a"], side="right"), ("robot",)
    )
    assert walker.given == (1.0, 3, "right", Shape(2.0, (1.0, 2.0)), True, (1.0,), ["a"], None)
    assert isinstance(walker.given[0], float)


def test_shared_arguments_go_to_those_who_take_them():
    walker = build(WALKERS, component(speed=1.0), ("robot",), rates="the rates", smoother="unused")
    assert walker.given[-1] == "the rates"


def test_a_shared_argument_cannot_be_a_parameter():
    words = refusal(shared={"rates": 1}, speed=1.0, rates=3)
    assert words == "robot.parameters.rates: set this at rates"


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({}, "robot.parameters.speed is missing"),
        ({"speed": "3"}, "robot.parameters.speed = '3': a number is expected, not text"),
        ({"speed": True}, "robot.parameters.speed = true: a number is expected"),
        ({"speed": np.nan}, "robot.parameters.speed = nan: a finite number is expected"),
        ({"speed": 1.0, "steps": 2.5}, "robot.parameters.steps = 2.5: a whole number is expected"),
        (
            {"speed": 1.0, "side": "up"},
            "robot.parameters.side = 'up': it must be 'left' or 'right'",
        ),
        ({"speed": 1.0, "copy": 1}, "robot.parameters.copy = 1: true or false is expected"),
        ({"speed": 1.0, "shape": {"widht": 1}}, "robot.parameters.shape.widht: unknown key; did"),
        ({"speed": 1.0, "shape": {"corners": 1}}, "robot.parameters.shape.corners = 1: a list is"),
        ({"speed": 1.0, "pace": 1.0}, "robot.parameters.pace: unknown key"),
        ({"speed": -1.0}, "robot.parameters.speed = -1.0: must not be negative"),
        (
            {"speed": 1.0, "steps": -1},
            "robot.name = 'walker': it cannot be built: TypeError: a bug in here",
        ),
    ],
)
def test_a_wrong_parameter_is_named_with_its_value(parameters, words):
    assert words in refusal(**parameters)


def test_unknown_names_are_refused_with_what_there_is():
    assert "unknown walker 'wlker'; did you mean 'walker'?" in refusal("wlker")
    assert "cannot be imported" in refusal("no_such_module:Thing")


def test_a_module_that_fails_when_imported_is_named(tmp_path, monkeypatch):
    (tmp_path / "failing_module.py").write_text("1 / 0\n")
    monkeypatch.syspath_prepend(tmp_path)
    words = "robot.name: walker 'failing_module:A' cannot be imported: ZeroDivisionError"
    assert words in refusal("failing_module:A")


def test_inherited_fields_of_dataclasses_are_checked():
    assert "robot.parameters.pair = 3: a list of 2 is expected" in refusal("derived", pair=3)
    assert build(WALKERS, component("derived", pair=[3, 4]), ("robot",)).pair == (3.0, 4.0)


def test_constructors_without_usable_annotations_take_what_they_name():
    assert build(WALKERS, component("unannotated", size="x", more=1), ("robot",)) == (
        "x",
        {"more": 1},
    )
    assert build(WALKERS, component("for-checkers", size="x"), ("robot",)) == ("x", 1.0)
    assert "robot.parameters.sise: unknown key; did you mean 'size'?" in refusal(
        "for-checkers", size=1, sise=2
    )


def test_checking_reports_every_problem_and_builds_nothing():
    problems = check_parameters(
        WALKERS, component(speed="fast", stepps=1, rates=1), ("robot",), {"rates": "rates"}
    )
    assert [problem.path[-1] for problem in problems] == ["rates", "speed", "stepps"]
    assert check_parameters(WALKERS, component(speed=-1.0), ("robot",), {}) == []


class Above:
    def __init__(self, observer: str = "none", window: int = 5) -> None:
        self.observer, self.window = observer, window


class HandsOn(Above):
    def __init__(self, share: float = 0.5, **parts: object) -> None:
        super().__init__(**parts)
        self.share = share


def test_keywords_that_a_class_hands_on_are_those_of_the_class_above():
    names = Registry("thing", {"hands-on": f"{__name__}:HandsOn"})
    component = Component(name="hands-on", parameters={"window": 7})
    made = build(names, component, ("thing",), observer="paper")
    assert (made.observer, made.window, made.share) == ("paper", 7, 0.5)
    assert complete(names, component, ("observer",)) == {"window": 7, "share": 0.5}
    for wrong, said in (({"window": "x"}, "thing.parameters.window"), ({"windw": 7}, "windw")):
        with pytest.raises(InputError, match=said):
            build(names, Component(name="hands-on", parameters=wrong), ("thing",))
