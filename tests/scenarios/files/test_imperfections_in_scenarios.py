"""Imperfections as a scenario file names them: checked with a line, swapped, kept, resolved."""

import numpy as np
import pytest
import yaml

from cowalk.agents.imperfections.reaction_delay import ReactionDelay
from cowalk.agents.imperfections.tremor import Tremor
from cowalk.scenarios.export.run_folder import write_run
from cowalk.scenarios.files.loading import faults, load, to_yaml
from cowalk.scenarios.running.build import build_agents
from cowalk.scenarios.running.runner import run
from cowalk.sim.basics.errors import InputError

LISTED = """
  imperfections:
    - {name: reaction-delay, parameters: {delay: 0.2}}
    - tremor
"""


@pytest.fixture
def walk(scenario_file):
    def write(text=LISTED):
        return scenario_file(("  name: steady", "  name: steady" + text.rstrip("\n")))

    return write


def test_the_first_in_the_list_is_the_innermost(walk):
    human, _ = build_agents(load(walk()))
    assert isinstance(human, Tremor)
    assert isinstance(human.human, ReactionDelay)
    assert human.human.delay == 0.2


def test_they_stay_when_the_model_is_swapped_and_can_be_set_from_outside(walk):
    swapped = load(walk(), ["human=slacking", "human.imperfections.1.parameters.share=0.05"])
    assert [item.name for item in swapped.human.imperfections] == ["reaction-delay", "tremor"]
    human, _ = build_agents(swapped)
    assert human.share == 0.05
    replaced = load(walk(), ["human.imperfections=[fatigue]"])
    assert [item.name for item in replaced.human.imperfections] == ["fatigue"]


@pytest.mark.parametrize(
    ("old", "new", "key", "message"),
    [
        ("- tremor", "- tremro", "human.imperfections.1.name", "did you mean 'tremor'"),
        ("delay: 0.2", "dleay: 0.2", "human.imperfections.0.parameters.dleay", "'delay'"),
        (
            "delay: 0.2",
            "delay: -0.2",
            "human.imperfections.0.parameters.delay",
            "between 0 and 5 s",
        ),
        ("delay: 0.2", "human: steady", "human.imperfections.0.parameters.human", "set this at"),
        (
            "- tremor",
            "- {name: tremor, parameters: {frequency: 11.0}}",
            "human.imperfections.1.name",
            "rates.control above 22",
        ),
    ],
)
def test_a_fault_has_its_line(walk, old, new, key, message):
    file = walk(LISTED.replace(old, new))
    (fault,) = faults(file)
    assert fault.key == key
    assert message in fault.message
    line = new if old == "- tremor" else "reaction-delay"
    assert line in file.read_text().splitlines()[fault.line - 1]


def test_gait_is_refused_where_a_body_walks(walk):
    with pytest.raises(InputError, match=r"the body makes it: .*plant=\"bullet\""):
        load(walk(), ["plant=bullet", "human.imperfections=[gait-ripple]"])


def test_a_faster_control_makes_room_for_the_whole_band(walk):
    tremor = "{name: tremor, parameters: {frequency: 12.0}}"
    scenario = load(walk(), ["rates.control=60", f"human.imperfections=[{tremor}]", "duration=1"])
    assert run(scenario).error is None


def test_a_kept_run_has_their_defaults_written_out(walk, tmp_path):
    result = run(load(walk()))
    write_run(result, tmp_path / "kept", figure=False)
    kept = yaml.safe_load((tmp_path / "kept" / "scenario.yaml").read_text())
    assert kept["human"]["imperfections"] == [
        {"name": "reaction-delay", "parameters": {"delay": 0.2}},
        {"name": "tremor", "parameters": {"share": 0.01, "frequency": 9.0}},
    ]
    again = tmp_path / "again.scenario.yaml"
    again.write_text(to_yaml(load(walk())))
    assert load(again) == load(walk())


def test_a_reaction_delay_makes_a_human_weave_who_is_always_yielded_to():
    def weaving(*changes):
        pair = ["plant=unicycle", "human=steady", "automation=always-yields", "expect={}"]
        trace = run(load("puddle", [*pair, *changes])).trace
        return np.abs(trace["true_omega"] - trace["omega"])[-100:].max()

    prompt = weaving()
    assert weaving("human.imperfections=[reaction-delay]") > 2.0 * prompt
    assert weaving("human.intention.lookahead=3.2") < 0.2 * prompt
