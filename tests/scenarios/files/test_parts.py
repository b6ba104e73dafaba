"""The table of parts: a made-up kind is one row, and every row keeps the same rules."""

import json
import pickle
import sys

import numpy as np
import pytest

from cowalk.scenarios import run
from cowalk.scenarios.files import parts
from cowalk.scenarios.files.assembling import build_part
from cowalk.scenarios.files.loading import faults, load, read
from cowalk.scenarios.files.parts import Part
from cowalk.scenarios.files.schema import part_of, with_named
from cowalk.scenarios.files.shipped import scenario_library
from cowalk.scenarios.yaml_text.document import parse
from cowalk.sim.basics.errors import InputError

PLANNERS = '''\
import numpy as np
from cowalk.agents import Belief
from cowalk.sim.basics.registry import Registry


class Planner:
    """Says how fast to go."""

    def speed(self):
        ...


class Slow:
    """Goes at so much of the bound."""

    def __init__(self, share: float = 0.25):
        self.share = share

    def speed(self):
        return self.share


class Planned:
    """Goes as fast as its planner says."""

    closed_loop = False

    def __init__(self, planner=None):
        self.planner = planner

    def reset(self, rng, situation):
        self.bound = situation.bounds.upper[0]

    def act(self, observation):
        return np.array([self.planner.speed() * self.bound, 0.0])

    def belief(self):
        return Belief()


NAMES = {"slow": "planners_of_mine:Slow"}
REGISTRY = Registry("planner", NAMES, protocol=Planner)
'''


@pytest.fixture
def planner(folder, monkeypatch):
    """A kind of part that nobody has heard of, beneath the automation: one row."""
    (folder / "planners_of_mine.py").write_text(PLANNERS)
    monkeypatch.syspath_prepend(folder)
    row = Part(
        "planner",
        "planners",
        ("automation", "planner"),
        "planners_of_mine:REGISTRY",
        default="slow",
    )
    monkeypatch.setattr(parts, "PARTS", (*parts.PARTS, row))
    yield row
    sys.modules.pop("planners_of_mine", None)


def test_a_new_kind_of_part_is_one_row(planner, cowalk, scenario_file):
    file = scenario_file(
        (
            "automation: never-yields",
            "automation:\n  name: planners_of_mine:Planned\n  planner: {parameters: {share: 0.5}}",
        )
    )
    # listed
    _, out, _ = cowalk("list", "planners", "--json")
    assert json.loads(out) == {
        "planners": [{"name": "slow", "description": "Goes at so much of the bound."}]
    }
    # accepted, and checked
    assert faults(file, trust=True) == []
    wrong = scenario_file(
        ("automation: never-yields", "automation:\n  name: never-yields\n  planner: sloww"),
        name="wrong.yaml",
    )
    (fault,) = faults(wrong)
    assert (fault.line, fault.key) == (9, "automation.planner.name")
    assert "unknown planner 'sloww'; did you mean 'slow'?" in fault.message
    # set, swapped by an option, shown with its origin
    assert part_of(
        load(file, ["automation.planner.parameters.share=0.1"], trust=True), "planner"
    ).parameters
    _, out, _ = cowalk("run", file, "--planner", "slow", "--show", "--json", "--trust")
    shown = json.loads(out)
    assert shown["scenario"]["automation"]["planner"] == {
        "name": "slow",
        "parameters": {"share": 0.5},
    }
    assert shown["origins"]["automation.planner.parameters.share"] == "file"
    assert (
        "--planner sloww: automation.planner.name: unknown"
        in (cowalk("run", file, "--planner", "sloww", "--trust")[2])
    )
    # built, run and summarised
    scenario = load(file, trust=True)
    assert build_part(scenario, "automation").planner.share == 0.5
    result = run(scenario)
    assert result.summary["planner"] == "slow"
    assert result.trace["v"][-1] == pytest.approx(0.6, rel=1e-3)
    assert pickle.loads(pickle.dumps(scenario)) == scenario
    assert cowalk("check", "planners_of_mine:Slow") == (
        0,
        "planners_of_mine:Slow: no fault (planner)\n",
        "",
    )


def test_without_its_row_the_kind_is_unknown_again(scenario_file):
    file = scenario_file(
        ("automation: never-yields", "automation: {name: never-yields, planner: slow}")
    )
    (fault,) = faults(file)
    assert "automation.planner: unknown key" in fault.message


def named(name):
    """Yield every option that swaps a part, with the name that a shipped scenario has there."""
    data = parse(scenario_library()[name].read_text()).data
    for part in parts.parts():
        section = data
        for step in part.section:
            section = section.get(step, {}) if isinstance(section, dict) else {}
        there = section.get(part.named_by) if isinstance(section, dict) else section
        if part.flag and (there or part.default):
            yield part, there or part.default


NAMED_AGAIN = [
    pytest.param(name, part, value, id=f"{name}-{part.flag}")
    for name in sorted(scenario_library())
    for part, value in named(name)
]


@pytest.mark.parametrize(("name", "part", "value"), NAMED_AGAIN)
def test_naming_the_part_that_is_there_changes_nothing(cowalk, name, part, value):
    _, plain, _ = cowalk("run", name, "--show", "--json")
    key = ".".join(part.section)
    for option in ((f"--{part.flag}", value), ("--set", f"{key}={value}")):
        code, out, err = cowalk("run", name, *option, "--show", "--json")
        assert (code, err) == (0, "")
        assert json.loads(out)["scenario"] == json.loads(plain)["scenario"]
    assert load(name, [f"{key}={value}"]) == load(name)
    if not part.preset:
        assert with_named(load(name), part.kind, value) == load(name)


def test_every_kind_that_an_option_swaps_is_tried():
    tried = {param.values[1].flag for param in NAMED_AGAIN}
    assert tried == {part.flag for part in parts.parts() if part.flag}


def test_a_preset_named_again_keeps_what_is_beside_it(folder):
    file = folder / "sensing.scenario.yaml"
    file.write_text(
        "name: sensing\nworld: {path: {points: [[0, 0], [5, 0]]}}\nplant: unicycle\n"
        "sensor: {preset: industrial, noise_density: 0.5}\nhuman: steady\n"
        "automation: stubbornness\n"
    )
    assert load(file, ["sensor=industrial"]) == load(file)
    (dropped,) = read(file, ["sensor=laboratory"]).dropped
    assert dropped.keys == ("noise_density",)


@pytest.mark.parametrize(
    ("override", "left"),
    [
        ("human={parameters: {gain: 9}}", {"initial": [0.4, 0.4], "gain": 9}),
        ("human.parameters={gain: 9}", {"initial": [0.4, 0.4], "gain": 9}),
        ("human={name: escalating}", {"initial": [0.4, 0.4], "gain": 2.0}),
        ("human={name: conceding, parameters: {gain: 9}}", {"gain": 9}),
        ("human.parameters:={gain: 9}", {"gain": 9}),
        ("human.parameters={}", {}),
        ("human:=escalating", {}),
    ],
)
def test_a_mapping_is_merged_unless_told_to_replace(override, left):
    scenario = load("puddle", [override])
    assert scenario.human.parameters == left
    replaced = ":=escalating" in override
    assert scenario.human.intention.margin == (0.1 if replaced else 0.3) or replaced


def test_lists_and_what_the_user_names_are_replaced():
    assert load("puddle", ["expect={}"]).expect == {}
    assert list(load("puddle", ["expect={new: always (x >= -1)}"]).expect) == ["new"]
    puddles = load("puddle", ["world.obstacles=[{x: 3, y: 0, radius: 0.2}]"]).world.obstacles
    assert [(puddle.x, puddle.seen_by) for puddle in puddles] == [(3.0, puddles[0].seen_by)]
    (moved,) = load("puddle", ["world.obstacles.0={x: 3}"]).world.obstacles
    assert (moved.x, moved.y, moved.radius) == (3.0, -1.05, 0.35)
    negotiation = load("puddle", ["automation.negotiation={horizon: 2}"]).automation.negotiation
    assert (negotiation.horizon, negotiation.turn_weight) == (2.0, 0.2)


def test_a_swap_says_what_it_drops(cowalk, tmp_path):
    text = scenario_library()["puddle"].read_text()
    file = tmp_path / "noisy.scenario.yaml"
    file.write_text(text.replace("sensor: industrial", "sensor: {noise_density: 0.0046}"))
    swaps = "--human", "conceding", "--sensor", "laboratory", "--plant", "unicycle"
    code, _, err = cowalk("run", file, *swaps, "--show")
    assert code == 0
    assert sorted(err.splitlines()) == [
        "cowalk: human is now 'conceding': dropped what was said of 'escalating': initial, gain",
        "cowalk: plant is now 'unicycle': dropped what was said of 'bullet': gait, walker",
        "cowalk: sensor is now 'laboratory': dropped what was said: noise_density",
    ]


def test_two_options_that_contradict_each_other_are_refused(cowalk):
    for options, words in (
        (("--seed", 3, "--set", "seed=4"), "--seed 3 and --set seed=4 contradict each other"),
        (("--human", "steady", "--set", "human.name=game"), "human.name=game contradict"),
        (("--human", "steady", "--set", "human={name: game}"), "{name: game} contradict"),
        (("--sensor", "low-cost", "--set", "sensor.preset=none"), "sensor.preset=none contradict"),
        (("--human", ""), "unknown human ''"),
        (("--human", "steady", "--set", "human=game"), "--human steady and --set human=game"),
    ):
        code, _, err = cowalk("run", "puddle", *options)
        assert code == 2
        assert words in err
    assert cowalk("run", "puddle", "--seed", 3, "--set", "seed=3", "--show")[0] == 0


def test_show_marks_every_value_and_runs_nothing(cowalk, folder):
    code, out, _ = cowalk("run", "puddle", "--seed", 4, "--smoother", "kalman", "--show")
    assert code == 0
    marks = dict(line.split("  # ") for line in out.splitlines() if "  # " in line)
    marks = {line.strip(): mark for line, mark in marks.items()}
    assert marks["seed: 4"] == marks["- name: kalman".removeprefix("- ")] == "flag"
    assert marks["horizon: 2.5"] == marks["name: escalating"] == "file"
    assert marks["control: 20"] == marks["period: 0.7"] == "default"
    assert not (folder / "runs").exists()
    copy = folder / "copy.yaml"
    copy.write_text(out)
    again = load("puddle", ["seed=4", "automation.smoother=kalman"])
    assert part_of(load(copy), "smoother").name == part_of(again, "smoother").name == "kalman"


def test_comparisons_take_the_same_options(cowalk, scenario_file):
    file = scenario_file(("duration: 3.0", "duration: 0.5"))
    for command in (("compare", "smoothers", file, "-n", 2), ("humans", "table", file)):
        _, _, err = cowalk(*command, "--observer", "papr")
        assert "--observer papr: automation.observer.name: unknown observer 'papr'" in err
        assert "did you mean 'human'" in cowalk(*command, "--set", "humn=steady")[2]


def test_an_error_of_an_override_knows_which_one():
    from cowalk.scenarios.files.overrides import OverrideError

    with pytest.raises(OverrideError) as refused:
        load("puddle", ["seed=3", "human.parameters.gian=1"])
    assert (refused.value.number, refused.value.assignment) == (1, "human.parameters.gian=1")
    again = pickle.loads(pickle.dumps(refused.value))
    assert (str(again), again.number) == (str(refused.value), 1)
    assert isinstance(refused.value, InputError)


def test_a_front_end_reaches_only_who_takes_one(folder):
    (folder / "plain_automation.py").write_text(
        "import numpy as np\nfrom cowalk.agents import Belief\n"
        "class Plain:\n"
        "    def __init__(self): pass\n"
        "    def reset(self, rng, situation): pass\n"
        "    def act(self, observation): return np.zeros(2)\n"
        "    def belief(self): return Belief()\n"
    )
    scenario = load("puddle", ["automation=plain_automation:Plain", "automation.front_end=mean"])
    assert np.array_equal(build_part(scenario, "automation").act({}), np.zeros(2))


def test_the_value_of_an_option_is_a_name_whatever_it_would_be_in_yaml(cowalk):
    for given in ("yes", "7", "{name: steady}"):
        code, _, err = cowalk("run", "puddle", "--human", given, "--show")
        assert code == 2
        assert err.startswith(f"cowalk: --human {given}: human.name: ")
        assert f"human {given!r}" in err
