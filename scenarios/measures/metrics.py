"""All metrics of a run, from its trace."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from cowalk.agents.automations.planner.problem import PROBLEMS
from cowalk.agents.automations.planner.settings import NegotiationSettings
from cowalk.estimation.scores.error import Score, bias, mean_over_rows, rmse
from cowalk.estimation.scores.lag import lag
from cowalk.estimation.scores.rows import START, row_before
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.situation import Situation

from .cost import band_rms, effort, rms, squared_effort
from .definitions import AXES, TWIST, definitions
from .disagreement import OUTCOMES, Extent, disagreements
from .negotiation import (
    apart,
    conflict_share,
    executed_concession,
    false_concession,
    ripple,
    stride_ripple,
    time_apart,
)
from .smoothness import log_dimensionless_jerk

LEAST_PROGRESS = 0.1
"""Below it effort by the metre says nothing, m (inferred)."""
LEAST_CHANGE = 0.2
"""Range of a speed, as a share of its upper bound, below which it did not change (inferred)."""
SLOWEST = 5.0
"""Longest response looked for, s: what comes later answers to something else."""
NINETY = 1.6449
"""Deviations to either side of the mean within which a normal distribution has 90 %."""

Values = dict[str, float | Array | Score]
"""Numbers by family; of a family with dimensions, one for each, and then that of both."""


def metrics(
    columns: Mapping[str, Array],
    situation: Situation,
    negotiation: NegotiationSettings | None = None,
    things: Sequence[Extent] = (),
    steers_from_behind: bool | None = False,
) -> dict[str, dict[str, float | str]]:
    """Return the metrics of a trace: `cowalk.scenarios.measures.definitions` says what each is.

    Nothing that the automation reports is taken for what it did: its own wish p_A* is planned
    anew, from the pose. Only the scores of its belief read that.

    Parameters
    ----------
    columns : mapping of str to ndarray, shape (rows,)
        Trace columns (`cowalk.scenarios.trace.columns.UNITS`), at least one row.
    situation : Situation
        Path, bounds, control period.
    negotiation : NegotiationSettings, optional
        What p_A* is planned with.
    things : sequence of Extent
        What a disagreement may be about: what stands still and the human can see.
    steers_from_behind : bool or None
        See `cowalk.sim.plant.protocol.Plant.steers_from_behind`; where it is not known, neither
        is a conflict in omega.

    Returns
    -------
    dict
        ``{"value": ..., "unit": ..., "share": ...}`` by name: value and unit, and the share of
        the rows that it rests on. NaN where a metric does not apply.
    """
    run = _Run(columns, situation)
    groups = (
        _course(run),
        _efforts(run),
        _negotiated(run, negotiation or NegotiationSettings(), steers_from_behind),
        _outcomes(run, things),
        _believed(run),
    )
    values = {name: value for group in groups for name, value in group.items()}
    found: dict[str, dict[str, float | str]] = {}
    for name, definition in definitions().items():
        family, _, suffix = name.partition(", ")
        value = values[family]
        value, share = value if isinstance(value, Score) else (value, np.ones(np.shape(value)))
        place = _PLACES.get(suffix, -1)
        found[name] = {
            "value": float(np.atleast_1d(value)[place]),
            "unit": definition.unit,
            "share": float(np.atleast_1d(share)[place]),
        }
    return found


_PLACES = {name: place for names in (AXES, TWIST) for place, name in enumerate(names)}


class _Run:
    """A trace by dimension: arrays of shape (2, rows)."""

    def __init__(self, columns: Mapping[str, Array], situation: Situation) -> None:
        self.columns = columns
        self.situation = situation
        self.period = situation.period
        self.upper = np.asarray(situation.bounds.upper, dtype=float)
        lower = np.asarray(situation.bounds.lower, dtype=float)
        self.twist = self.pair("", TWIST)
        # What lies beyond the bounds is insistence, not a wish.
        self.wish = np.clip(self.pair("true_", TWIST), lower[:, None], self.upper[:, None])
        self.intent = self.pair("", ("fx_intent", "fy_intent"))
        self.force = self.pair("interaction_force_", ("x", "y"))
        self.pose = np.stack([columns[name] for name in ("x", "y", "theta")], axis=-1)
        relative = situation.path.relative_pose(self.pose)
        self.station, self.offset = relative[:, 0], relative[:, 1]

    def pair(self, prefix: str, names: Sequence[str]) -> Array:
        """Return two columns, shape (2, rows)."""
        return np.stack([self.columns[prefix + name] for name in names])


def _course(run: _Run) -> Values:
    columns, offset = run.columns, run.offset
    arrived = np.flatnonzero(run.station >= run.situation.path.length)
    return {
        "progress": _progress(run),
        "arrival time": float(columns["t"][arrived[0]]) if arrived.size else float("nan"),
        "distance walked": float(effort(columns["v"], run.period)),
        "path error": float(rms(offset)),
        "largest lateral offset": float(offset[np.argmax(np.abs(offset))]),
        "smallest clearance": float(np.min(columns["clearance"])),
        "log dimensionless jerk": log_dimensionless_jerk(
            run.twist, run.period, LEAST_CHANGE * run.upper
        ),
    }


def _progress(run: _Run) -> float:
    return float(run.station[-1] - run.station[0])


def _efforts(run: _Run) -> Values:
    found: Values = {}
    for name, force in (("intended", run.intent), ("true", run.force)):
        both = np.hypot(*force)[None]
        found[f"{name} effort"] = effort(np.concatenate((force, both)), run.period)
        found[f"squared {name} effort"] = squared_effort(force, run.period)
    progress, total = _progress(run), np.asarray(found["intended effort"])[-1]
    a_metre = total / progress if progress > LEAST_PROGRESS else float("nan")
    return found | {
        "peak true force": float(np.hypot(*run.force).max()),
        "intended effort a metre": a_metre,
        "work": float(np.sum(run.columns["work"])),
        "shaking": band_rms(run.intent, run.period),
    }


def _negotiated(run: _Run, settings: NegotiationSettings, from_behind: bool | None) -> Values:
    own = PROBLEMS[settings.dimensions](settings, run.situation, run.pose).wish().T
    asked = run.intent * ((1.0,), (-1.0,)) if from_behind else run.intent
    drive = run.pair("drive_", ("force", "torque"))
    if from_behind is None:
        drive[1] = np.nan
    drive_ripple = np.array([stride_ripple(each, run.period) for each in drive])
    varied = np.ptp(run.twist, axis=-1) >= LEAST_CHANGE * run.upper
    lags = [lag(run.twist[i], run.wish[i], run.period, SLOWEST) for i in range(2)]
    return {
        "time apart": time_apart(run.wish, run.twist, run.upper, run.period),
        "disagreement": rmse(run.twist, run.wish),
        "executed concession": executed_concession(own, run.wish, run.twist, run.upper),
        "conflict share": conflict_share(asked, drive, ripple(run.force, run.intent), drive_ripple),
        "false concession": false_concession(
            own,
            run.pair("", ("v_cmd", "omega_cmd")),
            run.pair("true_stubbornness_", TWIST),
            run.upper,
            run.columns["t"],
        ),
        "response lag": np.where(varied, lags, np.nan),
    }


def _outcomes(run: _Run, things: Sequence[Extent]) -> Values:
    rows = apart(run.wish, run.twist, run.upper)
    counts = np.zeros((len(OUTCOMES), 2))
    for i in range(2):
        for each in disagreements(
            run.wish[i], run.twist[i], rows[i], run.station, things, run.period
        ):
            counts[OUTCOMES.index(each.outcome), i] += 1.0
    known = np.isfinite(run.wish)
    total = np.where(known.any(axis=-1), counts.sum(axis=0), np.nan)
    shares = np.divide(counts, total, out=np.full(counts.shape, np.nan), where=total > 0.0)
    found: Values = {"disagreements": Score(total, known.mean(axis=-1))}
    return found | {name: shares[i] for i, name in enumerate(OUTCOMES)}


def _believed(run: _Run) -> Values:
    truth = run.pair("true_stubbornness_", TWIST)
    estimate = run.pair("est_stubbornness_", TWIST)
    deviation = run.pair("est_stubbornness_deviation_", TWIST)
    smoothed = run.pair("smoothed_stubbornness_", TWIST)
    rows = run.pair("identifiable_", TWIST) > 0.5
    within = np.abs(estimate - truth) <= NINETY * deviation
    covered = np.where(np.isfinite(deviation) & np.isfinite(truth), within, np.nan)
    return {
        "stubbornness RMSE": rmse(estimate, truth, rows),
        "stubbornness bias": bias(estimate, truth, rows),
        "stubbornness coverage": mean_over_rows(covered, rows),
        "smoothed stubbornness RMSE": rmse(smoothed, truth, rows),
        "smoothed stubbornness lag": np.array(
            [lag(smoothed[i], truth[i], run.period) for i in range(2)]
        ),
        "wish direction": _right_side(run),
    }


def _right_side(run: _Run) -> Score:
    # Claiming agreement is right in agreement, and close to right where an estimate is noisy.
    # In between it ages: it is judged when it is used.
    before = row_before(run.twist.T).T
    used = (run.columns["negotiated"] > 0.5) & (run.columns["t"] >= START)
    rows = apart(run.wish, before, run.upper) & used
    agree = (run.pair("est_", TWIST) - before) * (run.wish - before) > 0.0
    return mean_over_rows(agree.astype(float), rows)
