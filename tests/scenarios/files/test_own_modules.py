"""What lies beside a scenario is executed if it is named, and not otherwise."""

import subprocess
import sys

import pytest
from joblib import Parallel, delayed

from cowalk.scenarios import load, run
from cowalk.scenarios.files.own_parts import judge_own_part, kind_of
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import part

MINE = '''\
import numpy as np
from cowalk.agents import Truth
{early}

class Mine:
    """Pushes as much as a module beside it says."""

    closed_loop = False

    def reset(self, rng, situation):
        pass

    def act(self, observation):
        {late}
        return np.array([helper_beside.PUSH, 0.0])

    def truth(self):
        return Truth(np.zeros(2), np.zeros(2))
'''


@pytest.fixture
def mine(folder, request):
    """A human of one's own in a module that imports another one, at its top or when it acts."""

    def write(late):
        helper = "import helper_beside"
        text = MINE.format(early="" if late else helper, late=helper if late else "pass")
        (folder / "mine_beside.py").write_text(text)
        (folder / "helper_beside.py").write_text("PUSH = 1.5\n")

    yield write
    for name in ("mine_beside", "helper_beside"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("late", [False, True])
def test_a_users_modules_find_one_another_whenever_they_ask(mine, scenario_file, late, monkeypatch):
    mine(late)
    before = list(sys.path)
    file = scenario_file(("name: steady", "name: mine_beside:Mine"))
    monkeypatch.chdir("/")  # found beside the file, wherever it is run from
    result = run(load(file, trust=True))
    assert result.error is None
    assert result.trace["fx_intent"][-1] == 1.5
    assert sys.path == before


def test_another_process_finds_a_users_class_too(mine, scenario_file, monkeypatch):
    mine(late=True)
    scenario = load(scenario_file(("name: steady", "name: mine_beside:Mine")), trust=True)
    monkeypatch.chdir("/")
    (pushed,) = Parallel(n_jobs=2)([delayed(_last_push)(scenario)])
    assert pushed == 1.5


def _last_push(scenario):
    return float(run(scenario).trace["fx_intent"][-1])


@pytest.mark.parametrize("command", ["check", "run"])
def test_a_module_beside_a_scenario_is_not_executed_unless_named(scenario_file, folder, command):
    file = scenario_file(("plant: unicycle", "plant: bullet"), ("duration: 3.0", "duration: 0.5"))
    trap = "open({!r}, 'w').close()\n"
    for module in ("pandas", "lxml", "networkx", "shapely"):
        (folder / f"{module}.py").write_text(trap.format(str(folder / f"{module} was here")))
    (folder / "elsewhere").mkdir()
    code = (
        "import sys, importlib.util\n"
        "from cowalk.scenarios.cli.main import main\n"
        f"sys.argv = ['cowalk', {command!r}, {str(file)!r}]\n"
        "try:\n    main()\nexcept SystemExit as end:\n    assert end.code == 0, end.code\n"
        "for name in ('pandas', 'lxml'):\n"
        "    try:\n        found = __import__(name)\n    except ImportError:\n        continue\n"
        f"    assert not found.__file__.startswith({str(folder)!r}), found\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        cwd=folder / "elsewhere",
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert not list(folder.glob("* was here"))


@pytest.mark.parametrize("name", ["os:system", "subprocess:Popen", "os:getcwd", "builtins:exec"])
def test_nothing_is_called_that_is_no_part(scenario_file, monkeypatch, name):
    called = []
    monkeypatch.setattr("subprocess.Popen.__init__", lambda *args, **more: called.append(args))
    file = scenario_file(("name: steady", f"name: {name}"))
    with pytest.raises(InputError, match=r"is not a class; mark a function|has no method 'reset'"):
        load(file, trust=True)
    with pytest.raises(InputError, match="is no part of any kind"):
        judge_own_part(name)
    assert not called


MARKED = """\
from cowalk.agents.imperfections.tremor import Tremor
from cowalk.agents.humans.steady import SteadyHuman
from cowalk.sim import part

@part("human")
def firm(level: float = 0.9):
    return SteadyHuman(level=(level, level))

@part("imperfection")
def shaky(human):
    return Tremor(human, share=0.02)

@part("smoother")
def wide():
    pass
"""


def test_a_function_that_is_marked_builds_a_part(folder, scenario_file):
    (folder / "marked_parts.py").write_text(MARKED)
    file = scenario_file(("name: steady", "name: marked_parts:firm"))
    assert run(load(file, ["human.parameters.level=0.5"], trust=True)).error is None
    with pytest.raises(InputError, match="builds a part of another kind: smoother"):
        load(file, ["human=marked_parts:wide"])
    assert judge_own_part("marked_parts:firm") == ("human", [])
    assert judge_own_part("marked_parts:shaky") == ("imperfection", [])


@pytest.mark.parametrize(
    ("address", "kind"),
    [
        ("cowalk.agents.humans.steady:SteadyHuman", "human"),
        ("cowalk.agents.imperfections.tremor:Tremor", "imperfection"),
        ("cowalk.agents.automations.strategies.never_yields:NeverYields", "automation"),
        ("cowalk.estimation.front_ends.mean:SlidingMean", "front end"),
        ("cowalk.estimation.smoothers.kalman:KalmanSmoother", "smoother"),
        ("cowalk.estimation.observers.paper:PaperObserver", "observer"),
        ("cowalk.sim.unicycle.plant:UnicyclePlant", "plant"),
    ],
)
def test_the_kind_of_a_part_is_found_by_how_it_is_called(address, kind):
    from cowalk.sim.basics.registry import import_address

    found = kind_of(import_address(address))
    assert found is not None
    assert found.kind == kind
    assert judge_own_part(address) == (kind, [])


def test_a_part_that_lacks_a_method_is_taken_for_the_nearest_kind(folder):
    (folder / "nearly_parts.py").write_text(
        "class NoTruth:\n    def reset(self, rng, situation): pass\n"
        "    def act(self, observation): pass\n    def tell(self): pass\n"
        "class Odd:\n    def reset(self, initial, last): pass\n    def update(self): pass\n"
        "class Still:\n    def reset(self, world, rng): pass\n    def step(self, a, b): pass\n"
    )
    (said,) = judge_own_part("nearly_parts:NoTruth").faults
    assert "taken for a part of the kind 'human': there is no method 'truth'" in said
    (reset, update) = judge_own_part("nearly_parts:Odd").faults
    assert "taken for a part of the kind 'smoother': reset(initial, last) cannot be" in reset
    assert "update() cannot be called as update(value): declare update(self, value)" in update
    said = judge_own_part("nearly_parts:Still").faults
    assert "kind 'plant': has no method 'save'; a plant needs reset, step, save" in said[0]


def test_a_fault_says_which_kind_the_part_was_taken_for(folder):
    (folder / "faulty_parts.py").write_text(
        "class Doubles:\n    def reset(self, initial): pass\n"
        "    def update(self, value): return 2.0 * value\n"
    )
    faults = judge_own_part("faulty_parts:Doubles").faults
    assert all(fault.startswith("faulty_parts:Doubles (smoother): ") for fault in faults)


def test_a_mark_is_of_one_kind():
    @part("observer")
    def built():
        return None

    kind = kind_of(built)
    assert kind is not None
    assert kind.kind == "observer"
