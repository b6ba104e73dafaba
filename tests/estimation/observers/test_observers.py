"""Every registered observer is held to the protocol; a user's own runs in the loop."""

import numpy as np
import pytest

from cowalk.estimation.observers.protocol import ForceReading
from cowalk.estimation.registry import OBSERVERS
from cowalk.scenarios import load, run

READING = ForceReading(
    force_max=np.array([7.5, 7.5]),
    force_threshold=np.zeros(2),
    sensitivity=np.array([0.5, 0.5]),
    lower=np.array([0.0, -0.26]),
    upper=np.array([1.2, 0.26]),
)


def observe(observer, forces, twists):
    observer.reset(READING, twists[0])
    return np.array([observer.update(f, t) for f, t in zip(forces, twists, strict=True)])


@pytest.mark.parametrize("name", OBSERVERS.names())
def test_estimates_are_in_range_repeatable_and_batched(name):
    rng = np.random.default_rng(0)
    forces = rng.normal(scale=5.0, size=(30, 4, 2))
    twists = rng.uniform(READING.lower, READING.upper, size=(30, 4, 2))
    observer = OBSERVERS.get(name)()
    found = observe(observer, forces, twists)
    assert found.shape == (30, 2, 4, 2)
    assert ((found[:, 0] >= 0.0) & (found[:, 0] <= 1.0)).all()
    assert ((found[:, 1] >= READING.lower) & (found[:, 1] <= READING.upper)).all()
    np.testing.assert_array_equal(found, observe(observer, forces, twists))
    for lane in range(4):
        single = observe(OBSERVERS.get(name)(), forces[:, lane], twists[:, lane])
        np.testing.assert_allclose(single, found[:, :, lane])


def test_the_paper_observer_reads_the_papers_two_first_steps():
    observer = OBSERVERS.get("paper")()
    straight, force = np.array([0.8, 0.0]), np.array([0.0, 3.0])
    observer.reset(READING, straight)
    share, wish = observer.update(force, straight)
    assert share[1] == pytest.approx(0.40)
    assert wish[1] == pytest.approx(0.4 * 0.26 * 0.5)
    share, _ = observer.update(force, np.array([0.8, 0.012]))
    assert share[1] == pytest.approx(0.4 * 0.272 / 0.312)


MINE = """
import numpy as np
from cowalk.estimation import Estimate

class Certain:
    def __init__(self, share: float = 0.5): self.share = share
    def reset(self, reading, twist): pass
    def update(self, force, twist): return Estimate(np.full(2, self.share), twist)
"""


def test_an_observer_of_ones_own_runs_in_the_loop(tmp_path, monkeypatch):
    (tmp_path / "my_observer.py").write_text(MINE)
    monkeypatch.syspath_prepend(tmp_path)
    swap = ["automation.observer=my_observer:Certain", "automation.observer.parameters.share=0.7"]
    result = run(load("puddle", [*swap, "plant=unicycle", "duration=5", "expect={}"]))
    assert result.error is None
    assert (result.trace["est_stubbornness_omega"] == 0.7).all()
    assert result.summary["observer"] == "my_observer:Certain"
