"""Every registered observer is held to the protocol; a user's own runs in the loop."""

import numpy as np
import pytest

from cowalk.estimation import OBSERVERS, ForceReading, Sample
from cowalk.scenarios import load, run
from cowalk.sim import Path, Situation, TwistBounds

SITUATION = Situation(
    Path(((0.0, 0.0), (30.0, 0.0))), 0.8, TwistBounds((0.0, -0.26), (1.2, 0.26)), 0.05
)
READING = ForceReading(
    force_max=np.array([7.5, 7.5]),
    force_threshold=np.zeros(2),
    sensitivity=np.array([0.5, 0.5]),
    period=0.1,
)


def sample(force, twist, step=0, samples=12):
    """A control step in which force and twist do not change."""
    wrench = np.zeros((*force.shape[:-1], samples, 6))
    wrench[..., :2] = force[..., None, :]
    pose = np.zeros((*force.shape[:-1], 3))
    return Sample(wrench, np.ones(wrench.shape[:-1]), twist, pose, 0.05, 0.05 * step)


def hear(observer, forces, twists):
    observer.reset(SITUATION, READING, np.random.default_rng(0))
    pairs = enumerate(zip(forces, twists, strict=True))
    return [observer.update(sample(f, t, step), np.array([0.8, 0.0])) for step, (f, t) in pairs]


@pytest.mark.parametrize("name", OBSERVERS.names())
def test_estimates_are_in_range_repeatable_and_batched(name):
    def numbers(estimates):
        return np.array([(e.stubbornness, e.wish) for e in estimates])

    rng = np.random.default_rng(0)
    lower, upper = SITUATION.bounds.lower, SITUATION.bounds.upper
    forces = rng.normal(scale=5.0, size=(30, 4, 2))
    twists = rng.uniform(lower, upper, size=(30, 4, 2))
    observer = OBSERVERS.get(name)()
    found = numbers(hear(observer, forces, twists))
    assert found.shape == (30, 2, 4, 2)
    assert ((found[:, 0] >= 0.0) & (found[:, 0] <= 1.0)).all()
    assert ((found[:, 1] >= lower) & (found[:, 1] <= upper)).all()
    np.testing.assert_array_equal(found, numbers(hear(observer, forces, twists)))
    for lane in range(4):
        single = numbers(hear(OBSERVERS.get(name)(), forces[:, lane], twists[:, lane]))
        np.testing.assert_allclose(single, found[:, :, lane])


def test_the_paper_observer_reads_the_papers_two_first_steps():
    straight, force = np.array([0.8, 0.0]), np.array([0.0, 3.0])
    turned = np.array([0.8, 0.012])
    first, held, second, _ = hear(
        OBSERVERS.get("paper")(), [force] * 4, [straight, turned, turned, turned]
    )
    assert first.stubbornness[1] == pytest.approx(0.40)
    assert first.wish[1] == pytest.approx(0.4 * 0.26 * 0.5)
    assert held is first, "it reads once a negotiation, every other step here"
    assert second.stubbornness[1] == pytest.approx(0.4 * 0.272 / 0.312)
    assert np.isnan(first.stubbornness_deviation).all(), "the paper states none"


MINE = """
import numpy as np
from cowalk.estimation import Estimate

class Certain:
    columns = {"heard": "1"}
    def __init__(self, share: float = 0.5): self.share = share
    def reset(self, situation, reading, rng): self.heard = 0
    def update(self, sample, own_wish):
        self.heard += 1
        return Estimate(
            np.full(2, self.share), own_wish, np.full(2, 0.1), np.full(2, 0.2),
            extras={"heard": float(self.heard)},
        )
"""
SWAP = ["automation.observer=my_observer:Certain", "automation.observer.parameters.share=0.7"]
SHORT = ["plant=unicycle", "duration=5", "expect={}"]


@pytest.fixture
def mine(tmp_path, monkeypatch):
    (tmp_path / "my_observer.py").write_text(MINE)
    monkeypatch.syspath_prepend(tmp_path)


def test_an_observer_of_ones_own_runs_in_the_loop(mine):
    result = run(load("puddle", [*SWAP, *SHORT]))
    assert result.error is None
    assert (result.trace["est_stubbornness_omega"] == 0.7).all()
    assert (result.trace["est_stubbornness_deviation_v"] == 0.1).all()
    assert (result.trace["est_deviation_omega"] == 0.2).all()
    assert result.summary["observer"] == "my_observer:Certain"


def test_it_is_heard_at_every_control_step_and_adds_a_column(mine, tmp_path):
    result = run(load("puddle", [*SWAP, *SHORT]))
    np.testing.assert_array_equal(result.trace["heard"], np.arange(1.0, 101.0))
    assert result.trace.units["heard"] == "1"
    result.trace.write(tmp_path / "trace.parquet")
    again = type(result.trace).read(tmp_path / "trace.parquet")
    np.testing.assert_array_equal(again["heard"], result.trace["heard"])
