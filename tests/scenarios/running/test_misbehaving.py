"""Parts that misbehave: each is named, with the step, and the trace so far is kept."""

import numpy as np
import pytest

from cowalk.scenarios import load, run
from cowalk.sim import InputError

PARTS = """
import time
import numpy as np
from cowalk.agents import Belief, Truth
from cowalk.estimation.observers.paper import PaperObserver
from cowalk.sim import InputError
from cowalk.sim.basics.errors import SimulationError


class Mute(Exception):
    def __str__(self): raise RuntimeError("no text")


class MuteForever(BaseException):
    def __str__(self): raise SystemExit(3)


class Listless(np.ndarray):
    def tolist(self): raise OSError("no list")


class Loop(dict):
    def items(self): raise ValueError("no items")


def sleeps():
    time.sleep(60.0)


def spins():
    while True:
        try:
            time.sleep(0.001)
        except Exception:
            pass


def raises(error):
    raise error


def circle():
    items = [None]
    items[0] = items
    return items


class Human:
    def __init__(self, kind: str): self.kind = kind
    def reset(self, rng, situation): self.count = 0
    def truth(self):
        if self.count > 30 and self.kind in TRUTHS:
            return TRUTHS[self.kind]()
        return Truth(np.zeros(2), np.zeros(2))
    def act(self, observation):
        self.count += 1
        if self.count > 30 and self.kind in ANSWERS:
            return ANSWERS[self.kind]()
        return np.zeros(2)


class Automation:
    def __init__(self, kind: str): self.kind = kind
    def reset(self, rng, situation): self.count = 0
    def belief(self):
        if self.count > 30 and self.kind in BELIEFS:
            return BELIEFS[self.kind]()
        return Belief()
    def act(self, observation):
        self.count += 1
        if self.count > 30 and self.kind in ANSWERS:
            return ANSWERS[self.kind]()
        return np.zeros(2)


class Observer(PaperObserver):
    def __init__(self, kind: str): self.kind, self.count = kind, 0
    def update(self, sample, own_wish):
        self.count += 1
        if self.count > 30:
            return ANSWERS[self.kind]()
        return super().update(sample, own_wish)


ANSWERS = {
    "none": lambda: None,
    "text": lambda: "left",
    "list": lambda: [0.0, 0.0],
    "circle": circle,
    "words": lambda: np.array(["a", "b"]),
    "objects": lambda: np.array([object(), None]),
    "huge": lambda: np.array([10**400, 0], dtype=object),
    "complex": lambda: np.array([1j, 0.0]),
    "dates": lambda: np.array(["2026-01-01", "NaT"], dtype="datetime64[D]"),
    "records": lambda: np.zeros(2, dtype=[("a", float)]),
    "listless": lambda: np.zeros(2).view(Listless),
    "three": lambda: np.zeros(3),
    "column": lambda: np.zeros((2, 1)),
    "nothing": lambda: np.zeros(0),
    "nan": lambda: np.full(2, np.nan),
    "infinite": lambda: np.array([-np.inf, 0.0]),
    "InputError": lambda: raises(InputError("no more")),
    "SimulationError": lambda: raises(SimulationError("no more")),
    "KeyboardInterrupt": lambda: raises(GeneratorExit()),
    "SystemExit": lambda: raises(SystemExit(0)),
    "StopIteration": lambda: raises(StopIteration()),
    "MemoryError": lambda: raises(MemoryError()),
    "RecursionError": lambda: raises(RecursionError()),
    "UnicodeDecodeError": lambda: b"\\xff".decode(),
    "a group": lambda: raises(ExceptionGroup("two", [ValueError(1), ValueError(2)])),
    "mute": lambda: raises(Mute()),
    "mute forever": lambda: raises(MuteForever()),
    "long": lambda: raises(ValueError("x\\n" * 100_000)),
    "sleeps": sleeps,
    "spins": spins,
}


def belief(**values):
    return lambda: Belief(**values)


BELIEFS = {
    "belief none": lambda: None,
    "belief wish shape": belief(wish=np.zeros(3)),
    "belief wish words": belief(wish=np.array(["a", "b"])),
    "belief wish list": belief(wish=[0.0, 0.0]),
    "belief wish objects": belief(wish=np.array([None, object()])),
    "belief stubbornness shape": belief(stubbornness=np.zeros((2, 2))),
    "belief interaction text": belief(interaction="high"),
    "belief interaction array": belief(interaction=np.zeros(2)),
    "belief interaction complex": belief(interaction=np.complex128(1j)),
    "belief negotiation none": belief(negotiation=None),
    "belief extras undeclared": belief(extras={"urgency": 1.0}),
    "belief extras none": belief(extras=None),
    "belief extras raise": belief(extras=Loop()),
    "belief raises": lambda: raises(KeyError("gone")),
    "belief stubbornness range": belief(stubbornness=np.array([50.0, -7.0])),
    "belief deviation range": belief(human_wish_deviation=np.array([-1.0, 0.0])),
}

TRUTHS = {
    "truth none": lambda: None,
    "truth shape": lambda: Truth(np.zeros(2), np.zeros(3)),
    "truth words": lambda: Truth(np.array(["a", "b"]), np.zeros(2)),
    "truth list": lambda: Truth([0.0, 0.0], np.zeros(2)),
    "truth range": lambda: Truth(np.zeros(2), np.array([50.0, -7.0])),
    "truth raises": lambda: raises(MuteForever()),
}
"""

ANSWERS = [
    *("none", "text", "list", "circle", "words", "objects", "huge", "complex", "dates", "records"),
    *("listless", "three", "column", "nothing", "nan", "infinite", "InputError"),
    *("SimulationError", "KeyboardInterrupt", "SystemExit", "StopIteration", "MemoryError"),
    *("RecursionError", "UnicodeDecodeError", "a group", "mute", "mute forever", "long"),
    *("sleeps", "spins"),
]
NO_ESTIMATE = [kind for kind in ANSWERS if kind not in ("sleeps", "spins")]
BELIEFS = [
    *("belief none", "belief wish shape", "belief wish words", "belief wish list"),
    *("belief wish objects", "belief stubbornness shape", "belief interaction text"),
    *("belief interaction array", "belief interaction complex", "belief negotiation none"),
    *("belief extras undeclared", "belief extras none", "belief extras raise", "belief raises"),
    *("belief stubbornness range", "belief deviation range"),
]
TRUTHS = [
    *("truth none", "truth shape", "truth words", "truth list", "truth range", "truth raises"),
]


@pytest.fixture(scope="module", autouse=True)
def own_parts(tmp_path_factory):
    folder = tmp_path_factory.mktemp("own")
    (folder / "misbehaving.py").write_text(PARTS)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(folder)
        yield


def outcome(part, name, kind, timeout=None):
    section = {"human": "human", "automation": "automation", "observer": "automation.observer"}[
        part
    ]
    scenario = load(
        "puddle",
        [
            *("plant=unicycle", "duration=4", "expect={}"),
            f"{section}:={{name: misbehaving:{name}, parameters: {{kind: {kind}}}}}",
        ],
    )
    return run(scenario, step_timeout=timeout)


@pytest.mark.parametrize(
    ("part", "name", "kind"),
    [
        *(("human", "Human", kind) for kind in (*ANSWERS, *TRUTHS)),
        *(("automation", "Automation", kind) for kind in (*ANSWERS, *BELIEFS)),
        *(("observer", "Observer", kind) for kind in NO_ESTIMATE),
    ],
)
def test_who_misbehaves_is_named_with_the_step_and_the_trace_is_kept(part, name, kind):
    timeout = 0.2 if kind in ("sleeps", "spins") else None
    result = outcome(part, name, kind, timeout)
    assert result.summary["end"] == "aborted"
    assert result.error.startswith(f"{part} 'misbehaving:{name}' "), result.error
    assert "at t = 1.5 s: " in result.error
    assert "\n" not in result.error
    assert len(result.error) < 700
    assert result.fault is None
    assert len(result.trace) == 30
    assert np.isfinite(result.trace["x"]).all()


def test_a_limit_that_is_kept_changes_no_bit():
    scenario = load("puddle", ["plant=unicycle", "duration=4", "expect={}"])
    free, limited = run(scenario).trace, run(scenario, step_timeout=20.0).trace
    assert free.values.tobytes() == limited.values.tobytes()


@pytest.mark.parametrize("limit", [0.0, -1.0, float("nan"), "soon", 1e9])
def test_a_limit_that_makes_no_sense_is_refused(limit):
    with pytest.raises(InputError, match="step_timeout = "):
        run(load("puddle", ["plant=unicycle", "duration=1"]), step_timeout=limit)
