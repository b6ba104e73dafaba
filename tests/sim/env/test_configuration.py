"""What an environment may be made with: everything else is refused in one line."""

import math

import pytest

from cowalk.sim import parallel_env
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import TwistBounds

SLOW = TwistBounds(upper=(0.5, 0.5))


@pytest.mark.parametrize("plant", ["bullet", "unicycle"])
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"duration": -1}, "duration = -1 s: must lie between 0.01 and 86400 s"),
        ({"duration": math.nan}, "duration = nan s: must lie between"),
        ({"duration": math.inf}, "duration = inf s: must lie between"),
        ({"duration": "long"}, "duration = 'long': a number is expected, in s"),
        ({"pace": -1}, "pace = -1 m/s: must lie between 0.01 and 5 m/s"),
        ({"pace": True}, "pace = True: a number is expected, in m/s"),
        ({"pace": 1.3}, "pace = 1.3 m/s: must not be above the upper bound of v, 1.2 m/s"),
        ({"bounds": SLOW}, "pace = 0.8 m/s: must not be above the upper bound of v, 0.5 m/s"),
        ({"force_limit": -5}, "force_limit = -5 N: must lie between 0.1 and 1000 N"),
        ({"force_limit": math.nan}, "force_limit = nan N: must lie between"),
        ({"force_limit": None}, "force_limit = None: a number is expected, in N"),
        ({"sensor": 3}, "sensor = 3: SensorParameters, or the name of a preset, is expected"),
        (
            {"sensor": "cheap"},
            "sensor: unknown sensor preset 'cheap'; known: laboratory, industrial",
        ),
        ({"bounds": ((0, 0), (1, 1))}, r"bounds = \(\(0, 0\), \(1, 1\)\): TwistBounds is expected"),
        ({"rates": 20}, "rates = 20: Rates is expected"),
        ({"world": "puddle"}, "world = 'puddle': a World is expected"),
        ({"plant": 3}, "plant = 3: the name of a plant, or module:Class, is expected"),
        ({"plant_parameters": 3}, "plant_parameters = 3: a mapping of the plant's parameters is"),
        ({"plant_parameters": []}, r"plant_parameters = \[\]: a mapping of the plant's"),
    ],
)
def test_arguments_without_sense_are_refused(plant, arguments, words):
    with pytest.raises(InputError, match=f"^{words}") as refused:
        parallel_env(**{"plant": plant, **arguments})
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("section", "given", "words"),
    [
        ("body", 3, "body = 3: give a mapping or BodyParameters"),
        ("body", {"height": "tall"}, "body.height = 'tall': a number is expected"),
        ("walker", {"delay": "late"}, "walker.delay = 'late': a number is expected"),
        (
            "grip",
            {"stiffness": 9.0},
            "grip.stiffness = 9.0: must be 3 finite numbers of at least 0",
        ),
        ("grip", {"release_force": "hard"}, "grip.release_force = 'hard': a number is expected"),
        ("grip", {"kind": ["rigid"]}, r"grip.kind = \['rigid'\]: must be one of rigid, compliant"),
        ("drive", {"max_speed": None}, "drive.max_speed = None: a number is expected"),
        ("gait", {"enabled": "yes"}, "gait.enabled = 'yes': true or false is expected"),
        ("gait", {"lateral": "wide"}, "gait.lateral = 'wide': .* in m, or be left out"),
        ("coupling", {"mass": "heavy"}, "coupling.mass = 'heavy': a number is expected"),
        ("robot", {"urdf": 3}, "robot.urdf = 3: the path of a URDF file is expected"),
        ("robot", {"handle": 3}, "robot.handle = 3: the name of a link is expected"),
        ("mount", {"position": "low"}, "mount.position = 'low': must be 3 finite numbers"),
        ("mount", 0.1, "mount = 0.1: give a mapping or SensorMount of position, rpy"),
        ("gui", "no", "gui = 'no': true or false is expected"),
    ],
)
def test_parameters_of_the_plant_are_judged_as_in_a_file(section, given, words):
    with pytest.raises(InputError, match=f"^{words}") as refused:
        parallel_env(plant_parameters={section: given})
    assert "\n" not in str(refused.value)


def test_a_slow_robot_is_made_with_a_pace_it_reaches():
    env = parallel_env(plant="unicycle", bounds=SLOW, pace=0.5)
    assert env.action_space("automation").high[0] == env.pace == 0.5
    assert env.steps_per_episode == 600
    env.close()


def test_what_is_done_to_the_parameters_later_changes_no_environment():
    given = {"body": {"hand": "both"}}
    one, other = parallel_env(plant_parameters=given), parallel_env(plant_parameters=dict(given))
    one.reset(seed=0)
    given["grip"] = {"kind": "compliant"}
    other.restore(one.save())
    one.close()
    other.close()
