"""How Gymnasium comes to know scenarios, in whichever order the two are imported."""

import subprocess
import sys

import gymnasium
import pytest

from cowalk.scenarios import scenario_library
from cowalk.scenarios.single_seat.environment import SingleSeatEnv
from cowalk.scenarios.single_seat.registration import ids

MADE = "env = gymnasium.make('{}'); env.reset(seed=0); env.close()"


def in_a_new_process(code):
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize(
    ("imports", "name"),
    [
        ("import cowalk.scenarios, gymnasium", "cowalk/Puddle-v0"),
        ("import gymnasium, cowalk.scenarios", "cowalk/Puddle-v0"),
        ("import gymnasium", "cowalk.scenarios:cowalk/Puddle-v0"),
        ("import cowalk.scenarios; cowalk.scenarios.run; import gymnasium", "cowalk/Puddle-v0"),
    ],
)
def test_every_order_of_imports_leads_to_an_environment(imports, name):
    assert in_a_new_process(f"{imports}; {MADE.format(name)}") == ""


def test_naming_environments_does_not_import_gymnasium():
    listed = (
        "import sys, cowalk.scenarios; print({*sys.modules} & {'gymnasium', 'numpy', 'pydantic'})"
    )
    assert in_a_new_process(listed) == "set()\n"


def test_gymnasium_is_imported_as_ever_and_once_by_this():
    code = (
        "import sys, cowalk.scenarios; before = len(sys.meta_path); import gymnasium;"
        "import inspect, importlib; inspect.getsource(gymnasium); importlib.reload(gymnasium);"
        "print(before - len(sys.meta_path), gymnasium.__spec__.name)"
    )
    assert in_a_new_process(code) == "1 gymnasium\n"


def test_every_shipped_scenario_has_an_id():
    assert {made.get("scenario") for made in ids().values()} == {None, *scenario_library()}
    assert ids()["cowalk/PaperOpenLoop-v0"] == {"scenario": "paper-open-loop"}
    assert set(ids()) <= set(gymnasium.registry)


def test_a_scenario_of_ones_own_is_made_by_its_file(scenario_file):
    env = gymnasium.make("cowalk/Scenario-v0", scenario=str(scenario_file()), seat="human")
    assert isinstance(env.unwrapped, SingleSeatEnv)
    assert env.unwrapped.scenario.name == "walk"
    env.close()


def test_several_are_stepped_as_one():
    envs = gymnasium.make_vec("cowalk/PaperOpenLoop-v0", num_envs=2, vectorization_mode="sync")
    _, infos = envs.reset(seed=[1, 2])
    assert list(infos["partner"]) == ["open-loop", "open-loop"]
    _, rewards, *_, infos = envs.step(envs.action_space.sample())
    assert rewards.shape == infos["reward_terms"]["effort"].shape == (2,)
    envs.close()
