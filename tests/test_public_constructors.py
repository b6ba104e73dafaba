"""Whatever Python constructs with nonsense is refused in one line that says where it was.

The constructors are found, not listed: what the four faces export, every registered part, and
every dataclass that one of these takes. One without a row here, or with a parameter that its row
does not name, fails the test.
"""

import dataclasses
import inspect
import math
import types
import typing

import numpy as np
import pytest

import cowalk.agents
import cowalk.estimation
import cowalk.scenarios
import cowalk.sim
from cowalk.agents.automations.strategies.always_yields import AlwaysYields
from cowalk.agents.automations.strategies.never_yields import NeverYields
from cowalk.agents.automations.strategies.stubbornness import StubbornnessAutomation
from cowalk.agents.humans.bounded_memory import BoundedMemoryHuman
from cowalk.agents.humans.conceding import ConcedingHuman
from cowalk.agents.humans.crossover import CrossoverHuman
from cowalk.agents.humans.escalating import EscalatingHuman
from cowalk.agents.humans.game import GameHuman
from cowalk.agents.humans.impedance import ImpedanceHuman
from cowalk.agents.humans.intention.intention import ChangeOfMind, IntentionSettings
from cowalk.agents.humans.open_loop import OpenLoopHuman
from cowalk.agents.humans.recorded.human import RecordedHuman
from cowalk.agents.humans.recorded.recording import Columns
from cowalk.agents.humans.recorded.sensor import RecordingSensor
from cowalk.agents.humans.recorded.units import Units
from cowalk.agents.humans.slacking import SlackingHuman
from cowalk.agents.humans.steady import SteadyHuman
from cowalk.agents.humans.tit_for_tat import TitForTatHuman
from cowalk.agents.imperfections.fatigue import Fatigue
from cowalk.agents.imperfections.force_limit import ForceLimit
from cowalk.agents.imperfections.gait_ripple import GaitRipple
from cowalk.agents.imperfections.perception_threshold import PerceptionThreshold
from cowalk.agents.imperfections.reaction_delay import ReactionDelay
from cowalk.agents.imperfections.signal_dependent_noise import SignalDependentNoise
from cowalk.agents.imperfections.tremor import Tremor
from cowalk.estimation.front_ends.mean import SlidingMean
from cowalk.estimation.front_ends.none import NoFrontEnd
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import Registry
from cowalk.sim.body.anthropometry import BodyParameters
from cowalk.sim.body.gait import GaitParameters
from cowalk.sim.body.grip import GripParameters
from cowalk.sim.body.walker import WalkerParameters
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.env.reward import AutomationWeights, RewardParameters, RewardWeights
from cowalk.sim.robot.coupling import CouplingParameters
from cowalk.sim.robot.drive import DriveParameters
from cowalk.sim.robot.robot import RobotParameters
from cowalk.sim.unicycle.plant import UnicyclePlant

FACES = (cowalk.sim, cowalk.estimation, cowalk.agents, cowalk.scenarios)
MADE_BY_COWALK = {
    "Agreement",
    "Belief",
    "Estimate",
    "ForceReading",
    "Negotiation",
    "Observation",
    "PlantState",
    "Person",
    "RunResult",
    "Sample",
    "Truth",
}
"""What a run hands from part to part: judged where a part returns it, not at every step anew."""
SCORES = {
    "AffineCalibration",
    "Coverage",
    "GapClosed",
    "Interval",
    "People",
    "Prior",
    "Score",
}
"""Results, made by the function or the ``fit`` that judges what they are made of."""
READ_FROM_FILES = {"Population", "Scenario"}
"""Judged by pydantic, fault by fault, before there is one (`cowalk.scenarios.load`)."""

NUMBER = (None, "3", True, math.nan, math.inf, -math.inf, 1e308, -1e308, [], [1.0], {})
POSITIVE = (*NUMBER, 0.0, -1.0, 1e-300)
NOT_NEGATIVE = (*NUMBER, -1.0)
TEXT = (None, 3, True, [], {}, "", b"a")
THING = (None, 3, "nonsense", True, [], {"nonsense": 1}, object(), object)
KINDS = {
    "number": NUMBER,
    "positive": POSITIVE,
    "not_negative": NOT_NEGATIVE,
    "share": (*NOT_NEGATIVE, 1.5),
    "positive_share": (*POSITIVE, 1.5),
    "whole": (*POSITIVE, 2.5),
    "flag": (None, "yes", 1, 0.0, math.nan, []),
    "text": TEXT,
    "word": (*TEXT, "no such word", ["left"], np.zeros(2)),
    "thing": THING,
    "source": (None, 3, True, {}, object(), object),
    "class_": (3, "nonsense", True, [], object()),
    "mapping": (None, 3, "nonsense", True, [], [1], {3: 1}, {"nonsense": 1}),
    "positions": (None, 3, "nonsense", True, [], {3: 1.0}, {"a": "b"}, {"a": math.nan}),
    "texts": (None, 3, "nonsense", True, [], {3: "a"}, {"a": 3}, {"a": None}, {"a": ""}),
    "seats": (None, 3, "human", ("robot",), (3,), {"human": 1}),
}
"""What is wrong for a value of each kind; ``?`` behind a name says that None may be given."""


def row(of_one=None, /, **kinds):
    """Return arguments that are right, and the names of parameters by kind."""
    return of_one or {}, kinds


HUMAN = {"pair_of_positive": "force_max", "positive": "gain", "thing": "intention"}
PATH = cowalk.sim.Path(((0.0, 0.0), (20.0, 0.0)))
SECTIONS = "drive? body? walker? gait? grip? coupling? robot? mount?"
SENSOR = {
    "not_negative": "rate latency low_pass resolution torque_resolution drop_rate",
    "positive_or_infinite": "range torque_range",
    "axes": "bias drift noise_density torque_bias torque_drift torque_noise_density cross_talk",
    "flag": "tare",
}
ENV = {
    "thing": "world rates sensor bounds reward?",
    "word": "plant start render_mode?",
    "mapping": "plant_parameters?",
    "positive": "pace duration force_limit",
}
WEIGHTS = "progress offset pace effort closeness arrival collision"
ONE = {"human": OpenLoopHuman()}
STRATEGY = {"thing": "negotiation? front_end? observer? smoother?"}
ENVIRONMENT = "an environment that is closed again"
FILE = "the file of a recording"

ROWS = {
    cowalk.sim.CowalkEnv: row({"plant": "unicycle"}, **ENV),
    RewardParameters: row(
        {}, thing="human? automation?", positive="force_scale offset_scale comfort"
    ),
    RewardWeights: row({}, number=WEIGHTS),
    AutomationWeights: row({}, number=WEIGHTS),
    cowalk.sim.Path: row({"points": ((0.0, 0.0), (1.0, 0.0))}, rows="points"),
    cowalk.sim.TwistBounds: row({}, pair="lower", pair_of_positive="upper"),
    cowalk.sim.Rates: row({}, whole="control physics sensor"),
    cowalk.sim.Situation: row(
        {"path": PATH, "pace": 0.8, "bounds": cowalk.sim.TwistBounds(), "period": 0.05},
        thing="path bounds rates",
        positive="pace period",
        triple_not_negative="extent",
    ),
    cowalk.sim.SensorParameters: row({}, **SENSOR),
    cowalk.sim.SensorMount: row({}, triple="position rpy"),
    cowalk.sim.Pedestrian: row(
        {"waypoints": ((0.0, 0.0), (1.0, 0.0))},
        rows="waypoints",
        positive="speed radius",
        not_negative="start_time",
        flag="back_and_forth",
        seats="seen_by",
    ),
    cowalk.sim.Corridor: row({"width": 3.0}, positive="width", things="doorways side_corridors"),
    cowalk.sim.Doorway: row({"x": 1.0, "width": 1.0}, number="x y", positive="width"),
    cowalk.sim.SideCorridor: row(
        {"x": 1.0, "width": 1.0}, number="x", positive="width length", word="side"
    ),
    cowalk.sim.Wall: row(
        {"start": (0.0, 0.0), "end": (1.0, 0.0)}, pair="start end", positive="thickness"
    ),
    cowalk.sim.Furniture: row(
        {"x": 0.0, "y": 0.0, "length": 1.0, "width": 1.0},
        number="x y yaw",
        positive="length width height?",
        text="kind",
        seats="seen_by",
    ),
    cowalk.sim.Obstacle: row(
        {"x": 0.0, "y": 0.0, "radius": 0.3},
        number="x y",
        positive="radius height?",
        text="kind",
        seats="seen_by",
    ),
    cowalk.sim.ViewRange: row({}, positive_or_infinite="human automation"),
    cowalk.sim.World: row(
        {"path": PATH},
        thing="path corridor? view_range",
        things="obstacles furniture pedestrians walls",
        triple="start",
    ),
    BulletPlant: row({"rates": cowalk.sim.Rates()}, thing=f"rates {SECTIONS}", flag="gui"),
    UnicyclePlant: row({"rates": cowalk.sim.Rates()}, thing="rates"),
    BodyParameters: row({}, positive="height mass", word="hand"),
    GaitParameters: row(
        {},
        flag="enabled",
        positive="percentile step_frequency",
        not_negative="fore_aft? lateral?",
    ),
    GripParameters: row(
        {},
        word="kind on_loss",
        triple_not_negative="stiffness damping turn_stiffness turn_damping",
        positive="slip_force? slip_length release_force?",
    ),
    WalkerParameters: row(
        {},
        not_negative="stiffness damping yaw_stiffness yaw_damping delay hand_stiffness "
        "hand_damping",
        positive="traction",
        word="on_lost_footing",
    ),
    CouplingParameters: row({}, word="kind", positive="mass length width"),
    DriveParameters: row(
        {},
        word="kind",
        positive="gain_forward gain_sideways gain_yaw max_force max_torque max_speed max_rate "
        "max_acceleration max_rate_change wheel_track wheel_radius max_wheel_speed friction",
        not_negative="delay",
    ),
    RobotParameters: row(
        {}, text="urdf? handle camera", triple="handle_offset", positions="joints"
    ),
    cowalk.agents.NegotiationSettings: row(
        {},
        word="dimensions",
        positive="period horizon distance_weight",
        not_negative="speed_weight turn_weight force_window",
        pair_of_positive="force_max",
        pair_of_not_negative="force_threshold sensitivity",
    ),
    IntentionSettings: row(
        {},
        not_negative="pace? margin anticipation",
        positive="lookahead easing",
        triple_not_negative="extent?",
        thing="path?",
        things="changes",
    ),
    ChangeOfMind: row(
        {"at_time": 1.0, "pace": 0.5},
        not_negative="at_time? pace?",
        number="at_station?",
        thing="path?",
    ),
    OpenLoopHuman: row({}, rows="profile", pair_of_positive="force_max"),
    RecordedHuman: row(
        {"file": FILE},
        text="file",
        thing="columns units sensor",
        texts="rows",
        word="gaps resample at_end",
        not_negative="start",
        number="scale",
        pair_of_positive="force_max",
        positive="rate?",
    ),
    Columns: row({}, text="time fx fy fz?"),
    RecordingSensor: row({}, not_negative="zero", triple="signs rpy"),
    Units: row({}, word="time? force?"),
    SteadyHuman: row({}, **HUMAN, pair_of_share="level"),
    EscalatingHuman: row(
        {},
        **HUMAN | {"positive": "gain turn relaxation tolerance"},
        pair_of_positive_share="initial",
        not_negative="growth hold",
    ),
    ConcedingHuman: row(
        {},
        **HUMAN | {"positive": "gain beta deadline tolerance"},
        pair_of_share="initial final",
    ),
    TitForTatHuman: row(
        {}, **HUMAN | {"positive": "gain tolerance"}, pair_of_positive_share="initial"
    ),
    SlackingHuman: row(
        {},
        **HUMAN | {"positive": "gain turn"},
        share="forgetting",
        not_negative="learning",
        pair_of_share="initial",
    ),
    BoundedMemoryHuman: row(
        {}, **HUMAN | {"positive": "gain turn tolerance"}, share="adaptability", whole="memory"
    ),
    ImpedanceHuman: row(
        {}, **HUMAN | {"positive": "gain damping duration lever"}, not_negative="stiffness reach"
    ),
    CrossoverHuman: row(
        {}, **HUMAN | {"positive": "gain crossover_frequency steering"}, not_negative="delay"
    ),
    GameHuman: row(
        {},
        **HUMAN
        | {
            "pair_of_positive": "force_max error_weights",
            "positive": "gain effort_weight partner_effort_weight steering",
        },
        not_negative="observer_rate reach",
    ),
    ReactionDelay: row(ONE, thing="human", not_negative="delay"),
    PerceptionThreshold: row(ONE, thing="human", share="weber", not_negative="threshold"),
    SignalDependentNoise: row(ONE, thing="human", share="share"),
    Tremor: row(ONE, thing="human", share="share", positive="frequency"),
    Fatigue: row(ONE, thing="human", word="muscle", positive="strength"),
    ForceLimit: row(ONE, thing="human", positive="limit"),
    GaitRipple: row(
        ONE,
        thing="human",
        positive="step_frequency walking_speed",
        not_negative="lateral_sway fore_aft_sway arm_stiffness",
    ),
    StubbornnessAutomation: row({}, **STRATEGY, number="interaction_min interaction_max"),
    NeverYields: row({}, **STRATEGY),
    AlwaysYields: row({}, **STRATEGY),
    cowalk.estimation.MovingAverage: row({}, whole="window"),
    cowalk.estimation.KalmanSmoother: row({}, positive="process_noise measurement_noise"),
    cowalk.estimation.PaperObserver: row(),
    SlidingMean: row({}, positive="window"),
    NoFrontEnd: row(),
    cowalk.scenarios.SingleSeatEnv: row(
        {"scenario": "puddle"},
        source="scenario partner? population?",
        word="seat observation render_mode?",
        flag="normalise",
        thing="reward?",
    ),
    cowalk.scenarios.Trace: row({}, whole="capacity", mapping="units"),
    cowalk.scenarios.Recorder: row(
        {"env": ENVIRONMENT, "human": OpenLoopHuman(), "automation": NeverYields()},
        thing="env human automation",
    ),
    Registry: row(
        {"kind": "human", "built_in": {}},
        text="kind entry_point_group?",
        mapping="built_in",
        class_="protocol?",
    ),
}
"""Of every public constructor: arguments that are right, and its parameters by kind."""


def public():
    """Yield every class that the faces export, their registries name, or one of these takes."""
    found = []
    for face in FACES:
        for name in face.__all__:
            thing = getattr(face, name)
            if isinstance(thing, Registry):
                found += [thing.get(part) for part in thing]
            elif isinstance(thing, type):
                found.append(thing)
    seen = set()
    while found:
        kind = found.pop()
        if kind in seen or kind.__name__ in MADE_BY_COWALK | SCORES | READ_FROM_FILES:
            continue
        seen.add(kind)
        found += taken(kind)
        plain = not (getattr(kind, "_is_protocol", False) or inspect.isabstract(kind))
        if plain and not issubclass(kind, BaseException):
            yield kind


def taken(kind):
    """Return the dataclasses among the annotations of a constructor."""
    hints = typing.get_type_hints(kind if dataclasses.is_dataclass(kind) else kind.__init__)
    found = [part for hint in hints.values() for part in arms(hint)]
    return [part for part in found if dataclasses.is_dataclass(part)]


def arms(hint):
    """Yield the classes in an annotation."""
    if typing.get_origin(hint) in (typing.Union, types.UnionType, tuple):
        for arm in typing.get_args(hint):
            yield from arms(arm)
    elif isinstance(hint, type):
        yield hint


def nonsense(kind, usual):
    """Return what is wrong for a parameter of a kind whose usual value is given."""
    if kind.startswith("pair"):
        of = KINDS[kind.removeprefix("pair").removeprefix("_of_") or "number"]
        return listed(of, 1.0 if usual is None else usual, 2)
    if kind.startswith("triple"):
        of = KINDS[kind.removeprefix("triple_") if "_" in kind else "number"]
        return listed(of, (0.0, 0.0, 0.0) if usual is None else usual, 3)
    if kind == "positive_or_infinite":
        return [value for value in POSITIVE if value != math.inf]
    if kind == "axes":
        return [
            *(v for v in NUMBER if v != -1e308),
            (1.0,),
            (0.0, None),
            (0.0, math.nan),
            (0.0,) * 4,
        ]
    if kind == "things":
        return [None, 3, "nonsense", True, {}, (None,), (3,), ("a", 3), (object(),)]
    if kind == "rows":
        return [None, 3, "nonsense", (), (3,), ((1.0,),), ((1.0, "a", 2.0),), *faulty_rows(usual)]
    return KINDS[kind]


def listed(of_one, usual, count):
    """Return lists of the wrong length, and the usual one with one entry wrong."""
    wrong = [None, 3.0, "ab", True, (), (1.0,) * (count - 1), (1.0,) * (count + 1), {}]
    wrong += [[[1.0]] * count, np.full(count, np.nan), np.array(["a"] * count)]
    return [*wrong, *((*usual[:-1], value) for value in of_one)]


def faulty_rows(rows):
    """Yield the usual rows with a number wrong, and with two rows the same."""
    for value in (None, "1", True, math.nan, math.inf, -1e308):
        yield (*rows[:-1], (*rows[-1][:-1], value))
    yield (*rows, rows[-1])


def cases():
    for constructor, (given, kinds) in ROWS.items():
        for kind, names in kinds.items():
            for name in names.split():
                yield pytest.param(
                    constructor, given, kind, name, id=f"{constructor.__name__}-{name}"
                )


@pytest.fixture(scope="module")
def complete(stand_in_recording):
    """Fill in what only a test run has."""
    env = cowalk.sim.CowalkEnv(plant="unicycle")
    env.close()
    stand_ins = {FILE: str(stand_in_recording), ENVIRONMENT: env}

    def fill(given):
        return {
            name: stand_ins.get(value, value) if isinstance(value, str) else value
            for name, value in given.items()
        }

    return fill


def test_every_public_constructor_has_a_row_that_names_its_parameters():
    found = set(public())
    assert not {kind.__name__ for kind in found - ROWS.keys()}, "give each a row in ROWS"
    assert not {kind.__name__ for kind in ROWS.keys() - found - {Registry}}, "no longer public"
    for constructor, (_, kinds) in ROWS.items():
        named = sorted(n.rstrip("?") for names in kinds.values() for n in names.split())
        assert named == sorted(inspect.signature(constructor).parameters), constructor.__name__


@pytest.mark.parametrize("constructor", ROWS, ids=lambda kind: kind.__name__)
def test_what_is_right_is_taken(constructor, complete):
    made = constructor(**complete(ROWS[constructor][0]))
    getattr(made, "close", lambda: None)()


@pytest.mark.parametrize(("constructor", "given", "kind", "name"), list(cases()))
def test_nonsense_is_refused_where_it_is(constructor, given, kind, name, complete):
    name, optional = name.rstrip("?"), name.endswith("?")
    arguments = complete(given)
    usual = given.get(name, inspect.signature(constructor).parameters[name].default)
    for value in nonsense(kind, usual):
        if optional and value is None:
            continue
        with pytest.raises(InputError) as refused:
            pytest.fail(f"{name} = {value!r} is taken: {constructor(**arguments | {name: value})}")
        error, message = refused.value, str(refused.value)
        assert "\n" not in message
        assert name in error.at, f"{name} = {value!r}: {message!r} is at {error.at}"
        assert message.startswith(".".join(map(str, error.at))), message


def test_numbers_of_a_batch_are_judged_each():
    many = np.array([1.0, 2.0])
    cowalk.agents.NegotiationSettings(
        horizon=many, turn_weight=many, force_max=np.full((5, 2), 7.5)
    )
    SteadyHuman(level=np.full((2, 7), 0.5), gain=many)
    for wrong in (np.array([1.0, np.nan]), np.array([1.0, -1.0]), np.array([]), np.array(["1"])):
        with pytest.raises(InputError, match=r"^horizon = "):
            cowalk.agents.NegotiationSettings(horizon=wrong)
        with pytest.raises(InputError, match=r"^gain = "):
            SteadyHuman(gain=wrong)
        with pytest.raises(InputError, match=r"^level = "):
            SteadyHuman(level=(0.5, wrong))
        with pytest.raises(InputError, match=r"^force_max = "):
            cowalk.agents.NegotiationSettings(force_max=np.array([wrong, wrong]).T)


@pytest.mark.parametrize(
    ("function", "at"),
    [
        (cowalk.sim.parallel_env, ("world",)),
        (cowalk.sim.sensor_preset, ("name",)),
        (cowalk.scenarios.load, ("scenario",)),
        (cowalk.scenarios.make_env, ("scenario",)),
        (cowalk.scenarios.build_agents, ("scenario",)),
        (cowalk.scenarios.run, ("scenario",)),
        (cowalk.scenarios.load_population, ("population",)),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_functions_that_construct_refuse_nonsense_too(function, at):
    for value in (None, 3, True, [], {}):
        with pytest.raises(InputError) as refused:
            function(value)
        assert refused.value.at == at
