"""People of a population walk, and several estimators listen to the same walks.

Who estimates does not act: the scenario's own automation does, and every entry hears what it
hears, row for row. So nobody earns easier rows by what they make the robot do, and one set of
references stands beside all of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cowalk.estimation.front_ends.mean import mean_force
from cowalk.estimation.scores.rows import START, row_before
from cowalk.sim.basics.errors import InputError, SimulationError
from cowalk.sim.basics.motion import Array

from ..files.assembling import build_part
from ..files.schema import Scenario, with_named
from ..people.person import with_person
from ..people.population import Population
from ..running.build import build_agents, make_env, seeds_of, situation_of
from ..running.parallel import each_of
from ..running.runner import Progress
from ..trace.recorder import Recorder
from .places import Place, places

PAPER = "paper, smoothed"
"""Who listens besides the entries: the paper's observer behind its mean, to be calibrated."""
_OF_PAPER = {"front end": "none", "observer": "paper", "smoother": "moving-average"}


class Said(NamedTuple):
    """What an estimator said in each row, each of shape (rows, 2); NaN where nothing."""

    stubbornness: Array
    deviation: Array
    wish: Array


@dataclass(frozen=True)
class Walk:
    """One walk of one person, from 3 s on: their truth, and what everybody made of it.

    Attributes
    ----------
    person, family : str
        Who it was, and the name of their human model.
    period : float
        s.
    gain, force_max, delay
        kappa (1), F_max (N, shape (2,)) and reaction time (s) of the person.
    stubbornness, wish, demand, before : ndarray, shape (rows, 2)
        s, p_H, s (p_H - p_(k-1))/p_ub, and p_(k-1).
    identifiable : ndarray of bool, shape (rows, 2)
    heard : ndarray, shape (rows, 2)
        Force behind the scenario's front end, as known at the start of the row, N.
    said : dict of str to Said
        By entry, and of `PAPER`.
    """

    person: str
    family: str
    period: float
    gain: float
    force_max: Array
    delay: float
    stubbornness: Array
    wish: Array
    demand: Array
    before: Array
    identifiable: NDArray[np.bool_]
    heard: Array
    said: dict[str, Said]


def walks(
    scenario: Scenario,
    kind: str,
    names: list[str],
    population: Population,
    people: int,
    progress: Progress | None = None,
    jobs: int = -1,
) -> tuple[list[Walk], int]:
    """Return the walks of everybody, and how many could not be walked.

    Parameters
    ----------
    scenario : Scenario
    kind : str
        ``"smoother"``, ``"observer"`` or ``"front end"``.
    names : list of str
        Entries of that kind.
    population : Population
    people : int
    progress : callable, optional
        Called with the walks done and their total.
    jobs : int
        Processes at once; -1 is one a core.

    Raises
    ------
    InputError
        If an entry fails, or nobody can walk.
    """
    tasks = [(place, kind, names) for place in places(scenario, population, people)]
    outcomes = each_of(_walk, tasks, progress, jobs)
    found = [outcome for outcome in outcomes if isinstance(outcome, Walk)]
    if not found:
        raise InputError(f"nobody of {population.name} can walk here: {outcomes[-1]}")
    return found, len(tasks) - len(found)


def _walk(place: Place, kind: str, entries: list[str]) -> Walk | str:
    """Return a walk, or why it cannot be walked by this person."""
    try:
        scenario = with_person(place.scenario, place.person)
        human, automation = build_agents(scenario)
        env = make_env(scenario)
    except InputError as error:
        return str(error)
    listeners = {entry: with_named(scenario, kind, entry) for entry in entries}
    listeners[PAPER] = _with_all(scenario, _OF_PAPER)
    try:
        return _listen(place.name, scenario, human, automation, env, kind, listeners)
    except SimulationError as error:
        return str(error)
    finally:
        env.close()


def _with_all(scenario: Scenario, names: Mapping[str, str]) -> Scenario:
    for kind, name in names.items():
        scenario = with_named(scenario, kind, name)
    return scenario


def _listen(
    name: str,
    scenario: Scenario,
    human: Any,
    automation: Any,
    env: Any,
    kind: str,
    listeners: Mapping[str, Scenario],
) -> Walk | str:
    seeds = seeds_of(scenario)
    observations, _ = env.reset(seed=seeds.env)
    situation = situation_of(scenario, env)
    human.reset(seeds.human, situation)
    automation.reset(seeds.automation, situation)
    front = build_part(scenario, "front end")
    front.reset(situation.rates)
    minds = {}
    for entry, its in listeners.items():
        minds[entry] = mind = build_part(its, "automation")
        # Who acts and who listens draw the same numbers.
        mind.reset(seeds_of(scenario).automation, situation)
    recorder = Recorder(env, human, automation)
    said: dict[str, list[Array]] = {entry: [] for entry in minds}
    heard = []
    while env.agents:
        seen = observations["automation"]
        actions = {"human": human.act(observations["human"]), "automation": automation.act(seen)}
        force = front.update(seen["wrench"], seen["force_valid"])[..., :2]
        heard.append(mean_force(force, seen["force_valid"]))
        for entry, mind in minds.items():
            said[entry].append(_say(mind, seen, kind, entry))
        observations, rewards, _, _, infos = env.step(actions)
        recorder.step(rewards, infos)
    trace, truth = recorder.trace, recorder.person
    judged = trace["t"] >= START
    if not judged.any():
        return f"it ends before {START:g} s, when scores begin"

    def both(column: str) -> Array:
        pair = [trace[f"{column}{dimension}"] for dimension in ("v", "omega")]
        return np.stack(pair, axis=-1)

    return Walk(
        person=name,
        family=scenario.human.name,
        period=scenario.rates.period,
        gain=truth["gain"],
        force_max=np.asarray(truth["force_max"]),
        delay=truth["delay"],
        stubbornness=both("true_stubbornness_")[judged],
        wish=both("true_")[judged],
        demand=both("true_demand_")[judged],
        before=row_before(both(""))[judged],
        identifiable=both("identifiable_")[judged] > 0.0,
        heard=np.array(heard)[judged],
        said={
            entry: Said(*np.moveaxis(np.array(rows), 1, 0)[:, judged])
            for entry, rows in said.items()
        },
    )


def _say(mind: Any, seen: Any, kind: str, entry: str) -> Array:
    """Return stubbornness, its deviation and the wish that a listener believes, shape (3, 2)."""
    try:
        mind.act(seen)
    except Exception as error:  # a user's class may raise anything
        what = f"{kind} {entry!r} failed: {type(error).__name__}: {error}"
        raise InputError(what) from error
    belief = mind.belief()
    if kind == "smoother" or entry == PAPER:
        unstated = np.full(2, np.nan)
        return np.stack((belief.stubbornness_smoothed, unstated, belief.human_wish))
    deviation = belief.stubbornness_deviation
    return np.stack((belief.stubbornness, deviation, belief.human_wish))
