"""The world's section of a scenario: what cannot be is named with its line."""

import pytest

from cowalk.scenarios.files.loading import faults, load, to_yaml
from cowalk.sim.basics.errors import InputError

BROKEN = """\
name: broken
plant: unicycle
world:
  path: {points: [[0, 0], [5, 0]]}
  corridor:
    width: 2.0
    doorways: [{x: 3, width: 1.0, y: 0.8}]
  furniture:
    - {x: 3, y: 0, length: 0, width: 1}
    - {x: 3, y: 0, lenth: 1, width: 1}
  pedestrians:
    - {waypoints: [[1, 2]], speed: 1}
    - {waypoints: [[1, 2], [2, a]]}
    - {waypoints: [[1, 2], [2, 3]], seen_by: [robot]}
  walls: [{start: [1, 1], end: [1, 1]}]
  view_range: {human: 0}
human: steady
automation: stubbornness
"""


def test_every_fault_of_a_world_is_named_at_its_line(folder):
    file = folder / "broken.scenario.yaml"
    file.write_text(BROKEN)
    found = {fault.line: str(fault) for fault in faults(file)}
    for line, words in {
        7: "doorways.0 reaches from 0.3 to 1.3 m, beyond the corridor's 2 m",
        9: "length = 0.0 m: must lie between 0.001 and 1000 m",
        12: "give at least two points",
        13: "world.pedestrians.1.waypoints.1.1 = 'a': a number is expected, not text",
        14: "seen_by = ['robot']: its entries are human or automation",
        15: "end = [1.0, 1.0]: it is where the wall starts",
        16: "human = 0.0 m: must lie between 0.01 and",
    }.items():
        assert words in found.get(line, ""), (line, found)
    assert any("did you mean 'length'?" in str(fault) for fault in faults(file))


def test_a_rich_world_survives_being_written(folder):
    scenario = load("doorway")
    file = folder / "copy.yaml"
    file.write_text(to_yaml(scenario))
    assert load(file).world == scenario.world


def test_a_human_who_is_not_followed_walks_into_the_post(run_scenario):
    result = run_scenario("doorway", "automation=never-yields", "plant=unicycle")
    assert result.summary["end"] == "collision"
    assert result.trace["clearance"][-1] < 0.0
    assert result.summary["contact"] == {"body": "human", "thing": "world.corridor.doorways.0"}


TIGHT = """\
name: tight
plant: {plant}
world:
  path: {{points: [[0, 0], [5, 0]]}}
  corridor: {{width: {width}}}
  start: [0, 0, 0]
human: steady
automation: stubbornness
"""


@pytest.mark.parametrize("plant", ["bullet", "unicycle"])
def test_a_start_that_is_too_tight_is_a_fault_of_the_file(folder, plant, cowalk):
    file = folder / "tight.scenario.yaml"
    file.write_text(TIGHT.format(plant=plant, width=1.6))
    (fault,) = faults(file)
    assert (fault.line, fault.key) == (6, "world.start")
    assert "the human is 0.07" in fault.message
    assert "[0.0, 0.1, 0.0] would be free" in fault.message
    code, _, said = cowalk("run", file)
    assert code == 2
    assert "tight.scenario.yaml:6: world.start = [0.0, 0.0, 0.0]" in said
    assert load(file, ["world.start=[0, 0.1, 0]"])
    with pytest.raises(InputError, match=r"take 1\.1. m across"):
        load(file, ["world.corridor.width=1"])


def test_what_only_a_plant_can_judge_is_a_fault_of_the_file(folder):
    file = folder / "tight.scenario.yaml"
    robot = "{name: bullet, parameters: {robot: {urdf: none.urdf}}}"
    file.write_text(TIGHT.format(plant=robot, width=3.0))
    (fault,) = faults(file)
    assert fault.line == 2
    assert "none.urdf': cannot be read (No such file" in fault.message
