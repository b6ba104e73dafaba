import sys

import pytest

from cowalk.scenarios.cli import main as cli

WALK = """\
name: walk
duration: 3.0
plant: unicycle
world: {path: {points: [[0.0, 0.0], [30.0, 0.0]]}}
human:
  name: steady
automation: never-yields
"""

MODELS = '''\
import time
import numpy as np
from cowalk.agents import Truth
from cowalk.sim import InputError


class Quiet:
    """Pushes nothing."""

    def reset(self, rng, situation):
        pass

    def act(self, observation):
        return np.zeros(2)

    def truth(self):
        return Truth(np.zeros(2), np.zeros(2))


class TurnsToNan(Quiet):
    def act(self, observation):
        return np.full(2, np.nan if observation["time"][0] > 1.0 else 0.0)


class Refuses(Quiet):
    def act(self, observation):
        if observation["time"][0] > 1.0:
            from cowalk.sim import InputError
            raise InputError("no more")
        return np.zeros(2)


class Leaves(Quiet):
    def act(self, observation):
        if observation["time"][0] > 1.0:
            raise GeneratorExit("gone")
        return np.zeros(2)


class Interrupted(Quiet):
    def act(self, observation):
        if observation["time"][0] > 1.0:
            raise KeyboardInterrupt
        return np.zeros(2)


class Picky(Quiet):
    def __init__(self, push: float, side: str = "left"):
        if push < 0.0:
            raise InputError(f"push = {push}: must not be negative", ("push",))


class Unbuildable(Quiet):
    def __init__(self):
        raise KeyError("nothing there")
'''


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The working folder of a user, with human models of their own in a module."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    (tmp_path / "my_models.py").write_text(MODELS)
    yield tmp_path
    sys.modules.pop("my_models", None)


@pytest.fixture
def scenario_file(folder):
    """Write a short scenario: replaced parts are given as (old, new) pairs."""

    def write(*replacements, more="", name="walk.scenario.yaml"):
        text = WALK
        for old, new in replacements:
            assert old in text
            text = text.replace(old, new)
        file = folder / name
        file.write_text(text + more)
        return file

    return write


@pytest.fixture
def cowalk(monkeypatch, capfd):
    """Run the command; return exit code, standard output and standard error."""

    def call(*arguments):
        monkeypatch.setattr(sys, "argv", ["cowalk", *map(str, arguments)])
        with pytest.raises(SystemExit) as end:
            cli.main()
        return end.value.code, *capfd.readouterr()

    return call
