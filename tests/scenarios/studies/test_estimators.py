"""Estimators on people who walk: scored beside the references, and not to be fooled."""

import numpy as np
import pytest

from cowalk.estimation import FRONT_ENDS, OBSERVERS, SMOOTHERS
from cowalk.scenarios import load
from cowalk.scenarios.people.loading import load_population
from cowalk.scenarios.studies.beside import CALIBRATED, ORACLE, PRIOR, REFERENCES, fits
from cowalk.scenarios.studies.estimators import compare_estimators, score_dimension
from cowalk.scenarios.studies.walks import PAPER, Said, Walk
from cowalk.sim.basics.errors import InputError

QUICK = ("plant=unicycle", "duration=9")
PERIOD, UPPER, ROWS = 0.05, 0.5, 300
ENTRIES = ("constant", "always one", "truth", "silent", "honest", "boasting", "where easy")
FAMILIES = ("steady", "slacking", "escalating")


def walk(person, family, seed):
    """Return a made-up walk in which s can be read where they disagree: half of the time."""
    rng = np.random.default_rng(seed)
    level = 0.15 + 0.7 * np.random.default_rng([person, 5]).random()
    time = np.arange(ROWS) * PERIOD
    s = np.clip(level + 0.1 * np.sign(np.sin(0.9 * time)), 0.0, 1.0)
    missing = np.where(np.sin(1.5 * time + seed) > 0.0, 0.35, 0.0)
    demand = s * missing
    meant = 15.0 * np.clip(demand, -0.5, 0.5)
    heard = np.concatenate(([0.0], meant[:-1])) + 0.3 * rng.standard_normal(ROWS)
    readable = missing > 0.1
    noisy = np.clip(s + 0.1 * rng.standard_normal(ROWS), 0.0, 1.0)
    unstated = np.full(ROWS, np.nan)
    said = {
        "constant": (np.full(ROWS, 0.537283), unstated),
        "always one": (np.ones(ROWS), unstated),
        "truth": (s, unstated),
        "silent": (unstated, unstated),
        "honest": (noisy, np.full(ROWS, 0.1)),
        "boasting": (noisy, np.full(ROWS, 1e-3)),
        # Right in every third row that can be read, and silent in all others.
        "where easy": (np.where(readable & (np.arange(ROWS) % 3 == 0), s, np.nan), unstated),
        PAPER: (np.clip(heard / 7.5, 0.0, 1.0), unstated),
    }
    two = {name: Said(*(np.stack((x, x), -1) for x in (*given, s))) for name, given in said.items()}
    return Walk(
        person=f"person {person}",
        family=family,
        period=PERIOD,
        gain=2.0,
        force_max=np.array([7.5, 7.5]),
        delay=0.0,
        stubbornness=np.stack((s, s), -1),
        wish=UPPER * np.stack((missing, missing), -1),
        demand=np.stack((demand, demand), -1),
        before=np.zeros((ROWS, 2)),
        identifiable=np.stack((np.zeros(ROWS, dtype=bool), readable), -1),
        heard=np.stack((heard, heard), -1),
        said=two,
    )


WALKS = [
    walk(person, FAMILIES[person % 3], 10 * person + world)
    for person in range(12)
    for world in range(2)
]


@pytest.fixture(scope="module")
def turning():
    return score_dimension(WALKS, "observer", ENTRIES, 1, UPPER, jobs=1)


@pytest.fixture(scope="module")
def scores(turning):
    return {score.name: score for score in turning.scores}


def test_references_stand_around_the_entries(turning, scores):
    assert list(scores)[:2] == [PRIOR, CALIBRATED]
    assert tuple(scores)[2:-2] == ENTRIES
    assert {name for name, score in scores.items() if score.reference} == set(REFERENCES)
    assert (turning.people, turning.families) == (12, tuple(sorted(FAMILIES)))
    assert turning.identifiable == pytest.approx(0.5, abs=0.05)
    for score in scores.values():
        assert score.rmse.low <= score.rmse.value <= score.rmse.high


def test_a_constant_does_not_beat_the_prior(scores):
    assert scores["constant"].better_than == ()
    assert np.isnan(scores["constant"].lag)
    assert scores["constant"].skill.high < 0.05


def test_who_always_says_one_is_far_off_and_biased(scores):
    liar = scores["always one"]
    assert liar.better_than == ()
    assert liar.rmse.low > scores[PRIOR].rmse.high
    assert liar.bias == pytest.approx(0.5, abs=0.1)
    assert liar.skill.high < -0.5


def test_the_truth_itself_beats_the_oracle_and_the_table_says_so(scores):
    truth = scores["truth"]
    assert truth.better_than == REFERENCES
    assert truth.rmse.value == 0.0
    assert truth.skill.value == truth.skill_all.value == 1.0
    assert truth.lag == 0.0
    assert truth.gap_closed.value > 1.0
    assert truth.wish_rmse > 0.0


def test_the_oracle_is_better_than_who_is_not_told(scores):
    assert PRIOR in scores[ORACLE].better_than
    assert scores[ORACLE].skill.low > 0.3
    assert scores[ORACLE].covered > 0.6


def test_silence_counts_as_the_prior_and_is_said(scores):
    silent, prior = scores["silent"], scores[PRIOR]
    assert silent.said == 0.0
    assert silent.rmse == prior.rmse
    assert silent.skill.value == silent.skill_all.value == 0.0
    choosy = scores["where easy"]
    assert choosy.said == pytest.approx(1.0 / 3.0, abs=0.02)
    # As if the prior had spoken in the other two thirds.
    assert choosy.rmse.value == pytest.approx(prior.rmse.value * np.sqrt(2.0 / 3.0), rel=0.05)


def test_lying_about_the_deviation_costs_skill_and_coverage(scores):
    honest, boasting = scores["honest"], scores["boasting"]
    assert honest.rmse == boasting.rmse
    assert boasting.skill.high < honest.skill.value
    assert honest.covered > 0.8
    assert boasting.covered < 0.3
    assert np.isnan(scores["constant"].covered)


def test_references_are_fitted_on_people_who_are_not_scored():
    seen = set()
    for fitted, places in fits(WALKS, 1):
        (family,) = {WALKS[place].family for place in places}
        others = [item for item in WALKS if item.family != family]
        mean = np.mean([item.stubbornness[:, 1].mean() for item in others])
        assert fitted.always.mean == pytest.approx(mean)
        seen |= set(places)
    assert seen == set(range(len(WALKS)))


def test_where_nobody_can_know_nothing_is_scored():
    forward = score_dimension(WALKS, "observer", ENTRIES, 0, 1.2, jobs=1)
    assert (forward.identifiable, forward.people, forward.scores) == (0.0, 0, ())


OWN = """
import numpy as np
from cowalk.estimation import Estimate

class Liar:
    def reset(self, situation, reading, rng):
        self.heard = []
    def update(self, sample, own_wish):
        return Estimate(np.ones(2), own_wish)

class Breaks(Liar):
    def update(self, sample, own_wish):
        raise KeyError("no such thing")
"""


@pytest.fixture(scope="module")
def healthy():
    return load_population("healthy-adults")


@pytest.mark.parametrize(
    ("kind", "registry", "first"),
    [
        ("smoother", SMOOTHERS, "moving-average"),
        ("observer", OBSERVERS, "paper"),
        ("front end", FRONT_ENDS, "none"),
    ],
)
def test_everything_that_ships_is_scored_on_people(kind, registry, first, healthy):
    calls = []
    found = compare_estimators(
        load("puddle", QUICK), kind, [], healthy, 4, lambda *at: calls.append(at), jobs=1
    )
    assert calls == [(done, 12) for done in range(1, 13)]
    assert (found.people, found.worlds, found.left_out) == (4, 3, 0)
    assert [each.dimension for each in found.dimensions] == ["v", "omega"]
    for each in found.dimensions:
        assert 0.0 < each.identifiable < 1.0
        entries = [score.name for score in each.scores if not score.reference]
        assert not entries or (entries[0] == first and set(entries) == set(registry))
    assert any(each.scores for each in found.dimensions)


def test_ones_own_is_scored_and_who_listens_changes_no_walk(tmp_path, monkeypatch, healthy):
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "shy_observers.py").write_text(OWN)
    scenario = load("puddle", QUICK)

    def compare(own, jobs):
        return compare_estimators(scenario, "observer", own, healthy, 4, jobs=jobs)

    alone, both = compare([], 1), compare(["shy_observers:Liar"], 2)
    for without, beside in zip(alone.dimensions, both.dimensions, strict=True):
        others = tuple(score for score in beside.scores if score.name != "shy_observers:Liar")
        assert repr(others) == repr(without.scores)  # in which NaN is NaN
        for score in beside.scores:
            if score.name == "shy_observers:Liar":
                assert score.bias > 0.2
                assert score.better_than == ()
    with pytest.raises(InputError, match="observer 'shy_observers:Breaks' failed: KeyError"):
        compare(["shy_observers:Breaks"], 1)
    with pytest.raises(InputError, match="unknown observer 'papre'; did you mean 'paper'"):
        compare(["papre"], 1)
    with pytest.raises(InputError, match="people = 1: at least 2"):
        compare_estimators(scenario, "observer", [], healthy, 1)
