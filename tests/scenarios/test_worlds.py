"""The world's section of a scenario: what cannot be is named with its line."""

from cowalk.scenarios.loading import faults, load, to_yaml

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
        5: "doorways.0 reaches from 0.3 to 1.3 m, beyond the corridor's 2 m",
        9: "length = 0.0 m: it must be above 0",
        12: "waypoints: give at least two points",
        13: "world.pedestrians.1.waypoints.1.1 = 'a': a number is expected, not text",
        14: "seen_by = ['robot']: its entries are human or automation",
        15: "end = [1.0, 1.0]: it is where the wall starts",
        16: "human = 0.0 m: it must be above 0",
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
