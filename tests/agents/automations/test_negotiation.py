"""Wish, utility and the negotiated primitive, against closed forms and brute force."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from cowalk.agents import AUTOMATIONS
from cowalk.agents.automations.planner.minimise import minimise
from cowalk.agents.automations.planner.problem import PROBLEMS
from cowalk.agents.automations.planner.settings import NegotiationSettings
from cowalk.agents.automations.planner.utility import negotiated
from cowalk.agents.automations.strategies.always_yields import AlwaysYields
from cowalk.agents.automations.strategies.never_yields import NeverYields
from cowalk.agents.automations.strategies.stubbornness import StubbornnessAutomation
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import TwistBounds, arc_displacement, compose
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.situation import Situation

BOUNDS = TwistBounds((0.0, -0.5), (1.2, 0.5))
SITUATION = Situation(Path(((0.0, 0.0), (30.0, 0.0))), 0.8, BOUNDS, 0.05)

offsets, headings = st.floats(-1.0, 1.0), st.floats(-0.6, 0.6)
speeds, turns = st.floats(0.0, 1.2), st.floats(-0.5, 0.5)


def problem_at(dimensions, offset, heading, **changes):
    chosen = NegotiationSettings(dimensions=dimensions, horizon=2.0, turn_weight=0.2, **changes)
    return PROBLEMS[dimensions](chosen, SITUATION, np.array([3.0, offset, heading]))


def utility(cost, human_cost, own_cost):
    """U: 1 at the automation's wish, 0 at the human's."""
    return (human_cost - cost) / (human_cost - own_cost)


def cost_of(problem, twist):
    return float(problem.cost(np.asarray(twist, dtype=float)[None])[0])


@given(st.floats(-0.9, 0.9))
def test_minimise_finds_a_parabolas_vertex_and_a_bound(vertex):
    low, high = np.array(-0.5), np.array(0.5)
    found = minimise(lambda x: (x - vertex) ** 2, low, high)
    assert found == pytest.approx(np.clip(vertex, -0.5, 0.5), abs=1e-7)


@settings(max_examples=40, deadline=None)
@given(offsets, headings, st.sampled_from(["omega", "both"]))
def test_the_wish_costs_least(offset, heading, dimensions):
    problem = problem_at(dimensions, offset, heading, speed_weight=0.05)
    wish = problem.wish()
    v = np.linspace(0.0, 1.2, 61) if dimensions == "both" else np.array([0.8])
    grid = np.stack(np.meshgrid(v, np.linspace(-0.5, 0.5, 201)), axis=-1).reshape(-1, 2)
    assert cost_of(problem, wish) <= problem.cost(grid).min() + 1e-9


def test_on_the_path_the_wish_is_to_go_straight_on_at_the_usual_pace():
    np.testing.assert_allclose(problem_at("both", 0.0, 0.0).wish(), [0.8, 0.0], atol=1e-6)
    np.testing.assert_allclose(problem_at("omega", 0.0, 0.0).wish(), [0.8, 0.0], atol=1e-6)


@settings(max_examples=200, deadline=None)
@given(offsets, headings, speeds, turns, st.floats(0.0, 1.0), st.sampled_from(["omega", "both"]))
@example(0.0, 0.0, 1.0, 0.5, 0.0625, "both")
def test_the_negotiated_primitive_has_the_target_utility(o, h, v, w, target, dimensions):
    problem = problem_at(dimensions, o, h)
    human = np.array([v if dimensions == "both" else 0.8, w])
    own = problem.wish()
    agreed = negotiated(problem, own, human, np.array(target))
    ends = cost_of(problem, human), cost_of(problem, own)
    if ends[0] - ends[1] < 1e-3:
        return  # the two agree, and utility is not defined by more than rounding
    reached = utility(cost_of(problem, agreed), *ends)
    assert reached == pytest.approx(target, abs=1e-3)
    if dimensions == "omega":
        low, high = sorted((own[1], human[1]))
        assert low - 1e-9 <= agreed[1] <= high + 1e-9


def test_on_a_sharply_bent_path_it_has_the_target_utility_too():
    # The front has gaps there, which no weighing of the two wishes fills.
    bent = Path(((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (6.0, 3.0), (6.0, 20.0)))
    situation = Situation(bent, 0.8, BOUNDS, 0.05)
    rng = np.random.default_rng(0)
    low, high = [2.0, -1.0, -0.6, 0.0, -0.5, 0.0], [6.0, 1.0, 0.6, 1.2, 0.5, 1.0]
    drawn = rng.uniform(low, high, (5000, 6))
    pose, human, target = drawn[:, :3], drawn[:, 3:5], drawn[:, 5]
    chosen = NegotiationSettings(dimensions="both", horizon=2.0, turn_weight=0.2)
    problem = PROBLEMS["both"](chosen, situation, pose)
    own = problem.wish()
    agreed = negotiated(problem, own, human, target)
    at_agreed, at_human, at_own = problem.cost(np.stack((agreed, human, own), axis=1)).T
    apart = at_human - at_own > 1e-3
    assert apart.mean() > 0.95
    reached = utility(at_agreed[apart], at_human[apart], at_own[apart])
    np.testing.assert_allclose(reached, target[apart], atol=5e-4)


def test_a_wish_at_the_end_of_the_range_is_that_end():
    # Of a cost that bends downwards there, the vertex of no parabola.
    low, high = np.array(-0.5), np.array(0.5)
    assert minimise(lambda x: -((x + 0.6) ** 2), low, high) == 0.5
    assert minimise(lambda x: -((x - 0.6) ** 2), low, high) == -0.5


@pytest.mark.parametrize("target", [0.3, 0.5, 0.8])
def test_in_v_and_omega_it_is_the_point_of_the_level_set_that_costs_the_human_least(target):
    problem = problem_at("both", 0.4, -0.1)
    human, own = np.array([0.5, 0.3]), problem.wish()
    agreed = negotiated(problem, own, human, np.array(target))
    level = cost_of(problem, human) - target * (cost_of(problem, human) - cost_of(problem, own))
    upper = np.array(BOUNDS.upper)
    best = minimize(
        lambda p: np.sum(((p - human) / upper) ** 2),
        own,
        constraints={"type": "eq", "fun": lambda p: cost_of(problem, p) - level},
        bounds=list(zip(BOUNDS.lower, BOUNDS.upper, strict=True)),
    )
    assert best.success
    np.testing.assert_allclose(agreed, best.x, atol=3e-3)


def test_target_one_is_the_own_wish_and_zero_the_humans():
    for dimensions in PROBLEMS:
        problem = problem_at(dimensions, 0.4, -0.1)
        human, own = np.array([0.8, 0.3]), problem.wish()
        np.testing.assert_allclose(negotiated(problem, own, human, np.array(1.0)), own, atol=1e-6)
        np.testing.assert_allclose(negotiated(problem, own, human, np.array(0.0)), human, atol=1e-6)


def test_where_both_wish_the_same_they_agree():
    problem = problem_at("omega", 0.3, 0.0)
    own = problem.wish()
    np.testing.assert_array_equal(negotiated(problem, own, own, np.array(0.4)), own)


def agree(automation, observe, force, periods=12):
    automation.reset(np.random.default_rng(0), SITUATION)
    for _ in range(14 * periods):
        twist = automation.act(observe(force=force, pose=(0.0, 0.3, 0.0)))
    return twist, automation.belief()


def test_never_yields_keeps_its_wish_and_always_yields_takes_the_humans(observe):
    own, belief = agree(NeverYields(), observe, (0.0, 4.0))
    np.testing.assert_allclose(own, belief.wish, atol=1e-9)
    given_up, belief = agree(AlwaysYields(), observe, (0.0, 4.0))
    np.testing.assert_allclose(given_up[1], belief.human_wish[1], atol=1e-9)


def test_more_force_earns_more_concession(observe):
    losses = [
        agree(StubbornnessAutomation(), observe, (0.0, fy))[1].utility_loss
        for fy in (0.0, 2.0, 4.0, 7.0)
    ]
    assert losses[0] == 0.0
    assert (np.diff(losses) > 0.05).all()


@pytest.mark.parametrize("force", [(7.5, 0.0), (0.0, 7.5)])
def test_whoever_insists_fully_in_one_dimension_is_conceded_everything(observe, force):
    automation = StubbornnessAutomation(negotiation=NegotiationSettings(dimensions="both"))
    automation.reset(np.random.default_rng(0), SITUATION)
    twist = np.array([0.8, 0.0])
    for _ in range(14 * 40):
        seen = observe(force=force, pose=(0.0, 0.0, 0.0))
        seen["twist"] = twist
        twist = automation.act(seen)
    belief = automation.belief()
    assert belief.utility_loss == pytest.approx(1.0, abs=1e-3)
    np.testing.assert_allclose(twist, belief.human_wish, atol=1e-3)


def test_a_period_that_does_not_fit_the_control_period_is_refused_with_both_numbers():
    automation = StubbornnessAutomation(negotiation=NegotiationSettings(period=0.72))
    with pytest.raises(InputError, match=r"0\.72 s .* 0\.05 s; 0\.7 would be"):
        automation.reset(np.random.default_rng(0), SITUATION)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("horizon", 0.0),
        ("horizon", -2.0),
        ("period", 0.0),
        ("distance_weight", -1.0),
        ("turn_weight", -0.1),
        ("force_window", -0.1),
        ("force_max", (0.0, 7.5)),
        ("force_threshold", (-1.0, 0.0)),
    ],
)
def test_impossible_settings_are_named(name, value):
    with pytest.raises(InputError, match=rf"^{name} = "):
        NegotiationSettings(**{name: value})


@pytest.mark.parametrize("name", ["never-yields", "stubbornness"])
def test_the_wish_on_a_bent_path_turns_with_it(name):
    bent = Situation(Path(((0.0, 0.0), (5.0, 0.0), (5.0, 20.0))), 0.8, BOUNDS, 0.05)
    automation = AUTOMATIONS.get(name)()
    automation.reset(np.random.default_rng(0), bent)
    pose = np.zeros(3)
    twist = np.zeros(2)
    for _ in range(500):
        twist = automation.act(
            {
                "twist": twist,
                "force": np.zeros((1, 2)),
                "wrench": np.zeros((1, 6)),
                "force_valid": np.ones(1),
                "pose": bent.path.relative_pose(pose),
                "pose_world": pose,
                "obstacles": np.zeros((8, 4)),
                "time": np.zeros(1),
            }
        )
        pose = compose(pose, arc_displacement(twist, 0.05))
    assert pose[1] > 8.0
    assert abs(pose[0] - 5.0) < 0.1
    assert pose[2] == pytest.approx(np.pi / 2, abs=0.1)


def test_an_empty_range_of_interaction_is_refused():
    with pytest.raises(ValueError, match="interaction_min"):
        StubbornnessAutomation(interaction_min=1.0, interaction_max=1.0)


def test_a_window_averages_what_arrived_since_so_many_steps(observe):
    reading = NegotiationSettings(period=0.1, force_window=0.2)
    automation = StubbornnessAutomation(negotiation=reading)
    automation.reset(np.random.default_rng(0), SITUATION)
    read = []
    for sideways, arrived in ((1.0, 1), (3.0, 1), (2.0, 1), (4.0, 1), (9.0, 0)):
        seen = observe(force=(0.0, sideways))
        seen["force_valid"] = np.full(len(seen["force"]), float(arrived))
        automation.act(seen)
        asked = automation.belief().human_wish[1] - seen["twist"][1]
        read.append(asked * reading.force_max[1] / (BOUNDS.upper[1] * reading.sensitivity[1]))
    # Negotiations at the steps 0, 2 and 4 look four steps back; the last sample was lost.
    np.testing.assert_allclose(read[::2], [1.0, 2.0, 3.0])
