"""Pytest plugin: ``*.scenario.yaml`` files are tests, one for each expectation.

The fixture `run_scenario` runs a scenario for assertions in Python. Nothing of cowalk's is
imported before a scenario is met, so that other projects' tests start as fast as before.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import pytest

if TYPE_CHECKING:
    from .result import RunResult

SUFFIX = ".scenario.yaml"


class Failure(Exception):
    """A scenario is broken, was aborted, or does not meet an expectation."""


class VacuousExpectation(pytest.PytestWarning):
    """An expectation holds, and would also do so if what it asks for never did."""


class RunScenario(Protocol):
    """What the fixture `run_scenario` gives."""

    def __call__(
        self,
        source: str | Path,
        *overrides: str,
        seed: int | None = None,
        trust: bool | None = None,
    ) -> RunResult:
        """Run a scenario by its name or file, with ``dotted.key=VALUE`` overrides.

        ``trust`` says whether code that the file names may be imported; left out, pytest's
        option does.
        """
        ...


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option, and the line in a configuration file, that trusts scenario files."""
    said = "import code that scenario files name"
    parser.getgroup("cowalk").addoption("--cowalk-trust", action="store_true", help=said)
    parser.addini("cowalk_trust", said, type="bool", default=False)


def _trusted(config: pytest.Config) -> bool:
    return bool(config.getoption("--cowalk-trust") or config.getini("cowalk_trust"))


@pytest.fixture
def run_scenario(request: pytest.FixtureRequest) -> RunScenario:
    """Run a scenario: ``run_scenario("puddle", "human.parameters.gain=2.0", seed=3)``.

    A relative path is taken from the test's folder, else from the current one.
    """

    def run_it(
        source: str | Path,
        *overrides: str,
        seed: int | None = None,
        trust: bool | None = None,
    ) -> RunResult:
        from .files.loading import load

        beside = request.path.parent / source
        own_seed = [] if seed is None else [f"seed={seed}"]
        file = beside if beside.is_file() else source
        trust = _trusted(request.config) if trust is None else trust
        return _run(load(file, [*overrides, *own_seed], trust=trust))

    return run_it


def _run(scenario: Any) -> RunResult:
    from .running.runner import run

    result = run(scenario)
    if result.summary["end"] == "interrupted":
        raise KeyboardInterrupt
    return result


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collect scenario files."""
    if file_path.name.endswith(SUFFIX):
        return ScenarioFile.from_parent(parent, path=file_path)
    return None


class ScenarioFile(pytest.File):
    """A scenario file; run once, when its first test is."""

    _result: RunResult | None = None

    def collect(self) -> Iterator[pytest.Item]:
        """Yield a test for each expectation; one for the whole file if it is broken or has none."""
        # A broken file is a failed test, not an error that would keep all others from running;
        # so is one that cowalk stumbles over: the test does it again, and shows where.
        try:
            lines = self._lines()
        except Exception:
            lines = None
        if lines is None:
            yield ScenarioTest.from_parent(self, name="valid", line=1)
            return
        for name, line in lines.items():
            yield ScenarioTest.from_parent(self, name=name, line=line, expectation=name)
        if not lines:
            yield ScenarioTest.from_parent(self, name="runs to its end", line=1)

    def _lines(self) -> dict[str, int] | None:
        """Return the line of each expectation by its name; None if the file is broken."""
        from .files.loading import faults, load, read_document

        trust = _trusted(self.config)
        if faults(self.path, trust=trust):
            return None
        document = read_document(self.path)
        expect = load(self.path, trust=trust).expect
        return {name: document.line(("expect", name)) for name in expect}

    def result(self) -> RunResult:
        """Return the result of the run, which is made once.

        Raises
        ------
        Failure
            If the file is broken or the run was aborted.
        """
        from cowalk.sim.basics.errors import InputError

        from .files.loading import faults, load

        if self._result is None:
            trust = _trusted(self.config)
            try:
                found = faults(self.path, trust=trust)
            except InputError as error:  # it cannot be read at all
                raise Failure(str(error)) from error
            if found:
                count = f"{len(found)} fault{'s' * (len(found) > 1)}"
                lines = [f"  line {fault.line}: {fault.message}" for fault in found]
                raise Failure("\n".join([f"{self.path} is broken, {count}:", *lines]))
            self._result = _run(load(self.path, trust=trust))
        if self._result.error is not None:
            raise Failure(f"the run was aborted: {self._result.error}\n{self.hint()}")
        return self._result

    def hint(self) -> str:
        """Return how to look at the run."""
        return f"to see the run: cowalk run {self.path}"


class ScenarioTest(pytest.Item):
    """One expectation of a scenario, or the whole of one that has none."""

    parent: ScenarioFile

    def __init__(self, *, line: int, expectation: str | None = None, **options: Any) -> None:
        super().__init__(**options)
        self._line = line
        self._expectation = expectation

    def runtest(self) -> None:
        """Run the scenario, if that was not done yet, and look at the verdict.

        Warns
        -----
        VacuousExpectation
            If the expectation holds vacuously.
        """
        from .expect.verdict import explain
        from .files.assembling import said_parts

        result = self.parent.result()
        for verdict in result.verdicts:
            if verdict.name != self._expectation:
                continue
            if not verdict.passed:
                raise Failure(
                    f"expectation: {verdict.name}\n"
                    f"formula:     {verdict.formula}\n"
                    f"fails:       {explain(verdict)}\n"
                    f"run:         {said_parts(result.scenario)}\n"
                    f"{self.parent.hint()}"
                )
            if verdict.vacuous is not None:
                said = f"{verdict.name}: {verdict.formula!r} holds vacuously: {verdict.vacuous}"
                warnings.warn_explicit(
                    VacuousExpectation(said), None, str(self.path), lineno=self._line
                )

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], *args: Any) -> Any:
        """Return a few lines about the scenario; a traceback only where the fault is cowalk's."""
        if isinstance(excinfo.value, Failure | VacuousExpectation):
            return str(excinfo.value)
        return super().repr_failure(excinfo, *args)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Return where the expectation stands."""
        return self.path, self._line - 1, f"{self.path.name}: {self.name}"
