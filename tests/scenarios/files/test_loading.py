import re

import pytest

from cowalk.scenarios.files.loading import faults, load, to_yaml
from cowalk.scenarios.files.shipped import scenario_library
from cowalk.sim.basics.errors import InputError


def reported(file):
    return [(fault.line, fault.key) for fault in faults(file)]


def refusal(source, *overrides):
    with pytest.raises(InputError) as error:
        load(source, overrides)
    assert "\n" not in str(error.value)
    return str(error.value)


def test_every_shipped_scenario_loads_by_its_name():
    assert {"puddle", "paper-open-loop"} <= set(scenario_library())
    for name, file in scenario_library().items():
        assert load(name).name == name
        assert faults(file) == []


def test_a_scenario_is_found_by_its_path_too(scenario_file):
    assert load(scenario_file()).name == load(str(scenario_file())).name == "walk"


@pytest.mark.parametrize("name", sorted(scenario_library()))
def test_what_is_written_loads_as_an_equal_scenario(name, tmp_path):
    scenario = load(name)
    copy = tmp_path / "copy.yaml"
    copy.write_text(to_yaml(scenario))
    assert load(copy) == scenario
    assert "control: 20" in copy.read_text()  # defaults are written out
    assert "!!" not in copy.read_text()


def test_an_unknown_name_is_answered_with_the_nearest():
    assert "did you mean 'puddle'" in refusal("pudle")
    assert "does not exist" in refusal("no/such.yaml")


def test_all_faults_of_a_file_are_reported_with_their_lines(folder):
    file = folder / "broken.scenario.yaml"
    file.write_text(
        """\
name: broken
seed: true
duration: "30"
pace: .nan
plant: unicycle
rates: {control: 20.5, fisics: 240}
world:
  path: {points: [[0, 0], [1, "0"]]}
  obstacles:
    - {x: 1, y: 2, radius: "1e-1", kindd: puddle}
human:
  name: escalating
  parameters:
    initial: 0.3
    grwth: 1
  intention: {pacee: 3}
automation:
  name: stubborn
  smoother: {name: kalman, parameters: {process_noise: true}}
  negotiation: {dimensions: v, sensitivity: [1]}
bounds: {lower: [1, 2], upper: [0, 0]}
expect:
  a number: 3
  not closed: always (x >
  unknown column: always (clearence > 0)
nam: 3
pace: 1
"""
    )
    assert reported(file) == [
        (2, "seed"),
        (3, "duration"),
        (6, "rates.control"),
        (6, "rates.fisics"),
        (8, "world.path.points.1.1"),
        (10, "world.obstacles.0.radius"),
        (10, "world.obstacles.0.kindd"),
        (14, "human.parameters.initial"),
        (15, "human.parameters.grwth"),
        (16, "human.intention.pacee"),
        (18, "automation.name"),
        (19, "automation.smoother.parameters.process_noise"),
        (20, "automation.negotiation.dimensions"),
        (20, "automation.negotiation.sensitivity.1"),
        (21, "bounds.upper"),
        (23, "expect.a number"),
        (24, "expect.not closed"),
        (25, "expect.unknown column"),
        (26, "nam"),
        (27, "pace"),
    ]
    messages = "\n".join(map(str, faults(file)))
    for words in (
        f"{file}:3: duration = '30': a number is expected, not text; write 30 without quotes",
        "radius = '1e-1': a number is expected, not text; write 0.1 without quotes",
        "did you mean 'kind'?",
        "did you mean 'growth'?",
        "did you mean 'name'?",
        "unknown automation 'stubborn'; did you mean 'stubbornness'?",
        "it must be 'omega' or 'both'",
        "did you mean 'clearance'?",
        "pace is given twice, first in line 4",
    ):
        assert words in messages
    assert not re.search(r"Input should|pydantic|Value error|validation", messages)
    assert f"(+{len(faults(file)) - 1} more; see cowalk check {file})" in refusal(file)
    assert refusal(file).startswith(f"{file}:2: seed = true: ")


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("-1", "must lie between 0.01 and 86400 s"),
        (".inf", "a finite number is expected"),
        (".nan", "a finite number is expected"),
        ("true", "a number is expected, not true or false"),
        ("2024-01-01", "put it in quotes if it is text"),
        ("null", "a number is expected, nothing is given"),
        ("[1]", "a number is expected"),
    ],
)
def test_a_wrong_duration_is_refused_with_key_value_and_cure(scenario_file, value, words):
    file = scenario_file(("duration: 3.0", f"duration: {value}"))
    assert [(fault.line, fault.key) for fault in faults(file)] == [(2, "duration")]
    message = refusal(file)
    assert message.startswith(f"{file}:2: duration")
    assert words in message


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("name: a\nworld:\n\tpath: 3\n", 3, "indent with spaces"),
        ("name: a\ndescription: a: b\n", 2, "put the value in quotes"),
        ("name: [a\n", 2, "not YAML"),
        ("name: a\nhuman: !!python/object:os.system x\n", 2, "no tag that a scenario may hold"),
        ("", 1, "needs at least the keys name, world, human, automation"),
        ("- name: a\n", 1, "needs at least the keys"),
        ("name: &loop [*loop]\n", 1, "contains itself"),
    ],
)
def test_what_is_no_scenario_at_all_is_one_fault(folder, text, line, words):
    file = folder / "broken.yaml"
    file.write_text(text)
    (fault,) = faults(file)
    assert fault.line == line
    assert words in fault.message


def test_missing_keys_are_named(folder):
    file = folder / "short.yaml"
    file.write_text("name: short\nhuman: steady\nworld: {}\n")
    assert {fault.message for fault in faults(file)} == {
        "automation is missing",
        "world.path is missing",
    }


def test_a_folder_or_a_binary_file_is_no_scenario(folder):
    binary = folder / "picture.yaml"
    binary.write_bytes(b"\x89PNG\xff\xfe")
    assert "UTF-8" in refusal(binary)
    assert "is a folder" in refusal(folder)


def test_rates_and_negotiation_period_must_divide(scenario_file):
    file = scenario_file(more="rates: {control: 7}\n")
    assert "7 Hz" in refusal(file)
    assert reported(file) == [(8, "rates")]
    file = scenario_file(
        (
            "automation: never-yields",
            "automation: {name: never-yields, negotiation: {period: 0.72}}",
        )
    )
    assert "automation.negotiation.period = 0.72 s is not a whole multiple" in refusal(file)


def test_a_value_that_only_a_constructor_can_judge_is_found_at_its_line(scenario_file):
    file = scenario_file(("  name: steady", "  name: my_models:Picky\n  parameters: {push: -1}"))
    (fault,) = faults(file, trust=True)
    assert (fault.line, fault.key) == (7, "human.parameters.push")
    assert fault.message == "human.parameters.push = -1.0: must not be negative"


@pytest.mark.parametrize(
    ("plant", "key", "words"),
    [
        (
            "drive: {\n  max_force: 0}",
            "drive.max_force",
            "max_force = 0.0 N: must lie between 1",
        ),
        ("walker: {\n  hand_stiffness: 1e6}", "walker.hand_stiffness", "at most 2200 works"),
        (
            "drive: {\n  delay: 0.8}",
            "drive.delay",
            "must be shorter than the run, duration = 0.5 s",
        ),
        (
            "robot: {\n  handle: grip}",
            "robot.handle",
            "no link 'grip'; known: body, camera, handle",
        ),
    ],
)
def test_what_only_the_plant_can_judge_is_found_at_its_line(scenario_file, plant, key, words):
    file = scenario_file(
        ("plant: unicycle", f"plant: {{name: bullet, parameters: {{{plant}}}}}"),
        ("duration: 3.0", "duration: 0.5"),
    )
    (fault,) = faults(file)
    assert (fault.line, fault.key) == (4, f"plant.parameters.{key}")
    assert fault.message.startswith(fault.key)
    assert words in fault.message


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("name: walk", "name: a/b", "name = 'a/b': a run's folder is named so: it must not"),
        ("duration: 3.0", "duration: 0", "duration = 0.0 s: must lie between 0.01 and 86400 s"),
        ("name: steady", "name: steady\n  parameters: {level: 2}", "a list of 2 is expected"),
        ("[[0.0, 0.0], [30.0, 0.0]]", "[[0, 0], 3]", "points.1 = 3: a list of 2 is expected"),
        ("[[0.0, 0.0], [30.0, 0.0]]", "[[0, 0]]", "a path needs at least two points (x, y)"),
        ("duration: 3.0", "rates: {control: 0}", "rates.control = 0 Hz: must lie between 1 and"),
        ("duration: 3.0", "durations: 3.0", "durations: unknown key; did you mean 'duration'? K"),
        ("duration: 3.0", "zzz: 3.0", "zzz: unknown key; known: name, description"),
    ],
)
def test_a_fault_is_told_in_plain_words(scenario_file, old, new, words):
    (fault,) = faults(scenario_file((old, new)))
    assert words in fault.message
    assert not re.search(r"should|pattern|shape|tuple", fault.message)


def test_a_sensor_or_a_human_later_than_the_run_is_refused(scenario_file):
    late = "human.imperfections=[{name: reaction-delay, parameters: {delay: 4}}]"
    assert "delay = 4 s: must be shorter than the run" in refusal(scenario_file(), late)
    message = refusal(scenario_file(), "sensor.latency=0.5", "duration=0.4")
    assert "sensor.latency = 0.5 s: must be shorter than the run, duration = 0.4 s" in message


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("at_time: 1, pace: 1.4", "pace = 1.4 m/s: must not be above the upper bound of v, 1.2"),
        ("at_time: 3, pace: 0", "at_time = 3 s: must come before the run is over, duration = 3 s"),
        ("at_station: 30, pace: 0", "at_station = 30 m: must lie before the end of world.path"),
    ],
)
def test_a_change_of_mind_that_never_comes_is_refused_at_its_line(scenario_file, change, words):
    changes = "\n    - {at_time: 2.9, pace: 1.2}\n    - {" + change + "}"
    file = scenario_file(("name: steady", f"name: steady\n  intention:\n   changes:{changes}"))
    (fault,) = faults(file)
    key = change.partition(":")[0] if "1.4" not in change else "pace"
    assert (fault.line, fault.key) == (10, f"human.intention.changes.1.{key}")
    assert words in fault.message


def test_a_sensor_that_converts_no_more_than_once_in_a_run_is_refused(scenario_file):
    message = refusal(scenario_file(), "sensor.rate=2", "duration=0.5")
    assert "sensor.rate = 2 Hz: must convert more than once in the run, duration = 0.5 s" in message
    assert load(scenario_file(), ["sensor.rate=2", "duration=0.6"]).sensor.rate == 2.0


@pytest.mark.parametrize(
    ("pace", "words"),
    [
        ("50", "pace = 50.0 m/s: must lie between 0.01 and 5 m/s"),
        ("0", "pace = 0.0 m/s: must lie between 0.01 and 5 m/s"),
        (
            "1.3",
            "pace = 1.3 m/s: must not be above the upper bound of v, 1.2 m/s (bounds.upper); "
            "give a pace of that or less, or raise it",
        ),
    ],
)
def test_a_pace_that_nobody_can_walk_at_is_refused_at_its_line(scenario_file, pace, words):
    (fault,) = faults(scenario_file(more=f"pace: {pace}\n"))
    assert (fault.line, fault.message) == (8, words)
    assert refusal(scenario_file(), f"pace={pace}").startswith(f"pace={pace}: pace = ")
    if pace == "50":
        intended = refusal(scenario_file(), "human.intention.pace=50")
        assert "human.intention.pace = 50.0 m/s: must lie between 0 and 5 m/s" in intended


def test_overrides_replace_values_of_any_kind(scenario_file):
    obstacle = "world: {obstacles: [{x: 1, y: 2, radius: 0.5}], "
    scenario = load(
        scenario_file(("world: {", obstacle)),
        [
            "human.parameters.gain=1.5",
            "world.obstacles.0.x=9",
            "bounds.upper=[1.0, 0.3]",
            "rates.control=40",
            "seed=7",
        ],
    )
    assert scenario.human.parameters == {"gain": 1.5}
    assert scenario.world.obstacles[0].x == 9.0
    assert scenario.bounds.upper == (1.0, 0.3)
    assert (scenario.rates.control, scenario.rates.physics, scenario.seed) == (40, 240, 7)


@pytest.mark.parametrize(
    ("written", "number"),
    [("1e1", 10.0), ("1E+1", 10.0), ("1.5e1", 15.0), ("2.e0", 2.0), (".5e1", 5.0), ("+3e-1", 0.3)],
)
def test_a_number_may_have_an_exponent_wherever_yaml_is_read(scenario_file, written, number):
    file = scenario_file(("duration: 3.0", f"duration: {written}"))
    assert faults(file) == []
    assert load(file).duration == number
    assert load(scenario_file(), [f"duration={written}"]).duration == number


def test_text_that_looks_like_a_number_stays_text(scenario_file):
    file = scenario_file(("name: walk", 'name: "1e5"'), more="description: 1e5 m\n")
    scenario = load(file)
    assert (scenario.name, scenario.description) == ("1e5", "1e5 m")
    file.write_text(to_yaml(scenario))
    assert load(file) == scenario


def test_a_swapped_part_keeps_its_section_but_not_its_parameters(scenario_file):
    file = scenario_file(
        ("  name: steady", "  name: steady\n  parameters: {gain: 3.0}\n  intention: {margin: 0.4}"),
        (
            "automation: never-yields",
            "automation:\n  name: stubbornness\n  parameters: {interaction_min: -1.5}\n"
            "  negotiation: {horizon: 2.0}\n  smoother: kalman",
        ),
    )
    scenario = load(file, ["human=escalating", "automation=always-yields"])
    assert (scenario.human.name, scenario.human.parameters) == ("escalating", {})
    assert scenario.human.intention.margin == 0.4
    assert (scenario.automation.name, scenario.automation.parameters) == ("always-yields", {})
    assert scenario.automation.negotiation.horizon == 2.0
    assert scenario.automation.smoother.name == "kalman"


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("humn.parameters.gain=1", "did you mean 'human'?"),
        ("human.parameters.gian=1", "did you mean 'gain'?"),
        ("human.parameters.gain=abc", "a number is expected, not text"),
        ("human.parameters.level=nan", "a list of 2 is expected, not text"),
        ("human.parameters.gain=nan", "a number is expected, not text"),
        (
            "human.intention.changes=[{pace: -1}]",
            "pace = -1.0 m/s: must lie between 0 and 5 m/s, or be left out; give either at_time",
        ),
        ("human.parameters.gain=true", "not true or false"),
        ("human=foo", "unknown human 'foo'; known: bounded-memory, conceding"),
        ("world.path.points.2.0=1", "world.path.points has 2 entries, 0 to 1; '2' is none"),
        ("name.x=1", "name is 'walk', there is nothing inside it"),
        ("rates.control=7", "is not a whole multiple"),
        ("seed", "write KEY=VALUE"),
        (".x=3", "write KEY=VALUE"),
        ("seed=[", "'[' is not a YAML value"),
    ],
)
def test_a_wrong_override_is_blamed_on_itself(scenario_file, override, words):
    message = refusal(scenario_file(), override)
    assert message.startswith(f"{override}: ")
    assert words in message
