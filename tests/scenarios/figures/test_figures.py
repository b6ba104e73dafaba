"""What the figures show, asked of the figure objects; and that odd runs can be drawn at all."""

from __future__ import annotations

import matplotlib
import numpy as np
import pytest
from matplotlib.colors import to_hex

from cowalk.agents.automations.planner.settings import NegotiationSettings
from cowalk.estimation.laws.stubbornness import utility_loss
from cowalk.scenarios.expect.verdict import Verdict
from cowalk.scenarios.figures.paper import paper_figure, utility_loss_figure
from cowalk.scenarios.figures.run import draw_paper_panels, draw_run, draw_utility_loss, run_figure
from cowalk.scenarios.figures.style import FAULT
from cowalk.scenarios.figures.top_view import window_of
from cowalk.scenarios.files.schema import Scenario
from cowalk.scenarios.result import RunResult
from cowalk.scenarios.trace.columns import UNITS
from cowalk.scenarios.trace.trace import Trace
from cowalk.sim.basics.motion import arc_displacement, compose
from cowalk.sim.basics.path import Path
from cowalk.sim.world.outline import across, rectangle
from cowalk.sim.world.world import Corridor, Obstacle, World

PUDDLE = Obstacle(9.0, 0.0, 0.4, seen_by=("human",))
CORRIDOR = World(Path(((0.0, 0.0), (24.0, 0.0))), Corridor(3.0), (PUDDLE,))
OPINIONS = tuple(
    name
    for name in UNITS
    if name.startswith(("est_", "smoothed_", "wish_", "interaction", "utility", "target"))
)


def scenario(world=CORRIDOR, dimensions="omega", **changes):
    settings = NegotiationSettings(dimensions=dimensions)
    return Scenario(
        name=changes.pop("name", "synthetic"),
        seed=7,
        world=world,
        human={"name": "escalating"},
        automation={"name": "stubbornness", "negotiation": settings},
        **changes,
    )


def result(rows=400, chosen=None, columns=None, **attributes):
    """A made-up run that swerves left around 11 s, with columns replaced as asked."""
    t = 0.05 * np.arange(1, rows + 1)
    bump = np.exp(-((t - 11.0) ** 2) / 8.0)
    data = dict.fromkeys(UNITS, np.zeros(rows))
    data |= {
        "t": t,
        "v": np.full(rows, 0.8),
        "omega": np.gradient(bump, 0.05) if rows > 1 else 0 * t,
    }
    pose = np.stack((0.8 * t, 0.6 * bump, 0.0 * t), axis=-1)
    data["x"], data["y"], data["theta"] = pose.T
    data["human_x"], data["human_y"], _ = compose(pose, np.array([-0.1, -0.65, 0.0])).T
    data["fy"], data["fy_intent"] = 5.0 * bump + 0.1, 5.0 * bump
    data["true_v"], data["true_omega"] = data["v"], 0.4 * bump
    data["est_v"], data["est_omega"] = data["v"], 0.3 * bump
    data["wish_v"], data["wish_omega"] = data["v"], -0.2 * bump
    data["true_stubbornness_omega"] = 0.2 + 0.6 * bump
    data["est_stubbornness_omega"] = 0.7 * bump
    data["smoothed_stubbornness_omega"] = 0.6 * bump
    data["target_utility"] = 1.0 - 0.6 * bump
    data["footing_held"] = np.ones(rows)
    data["clearance"] = np.hypot(data["x"] - 9.0, data["y"]) - 0.68
    for name, values in (columns or {}).items():
        data[name] = np.broadcast_to(values, rows)
    trace = Trace(capacity=max(rows, 1))
    for row in zip(*data.values(), strict=True):
        trace.append(dict(zip(data, row, strict=True)))
    return RunResult(chosen or scenario(), trace, attributes.pop("summary", {}), **attributes)


def by_title(figure):
    """Axes by title, without the letter in front."""
    return {axis.get_title(loc="left").split(") ")[-1]: axis for axis in figure.axes}


def labels(axis):
    return axis.get_legend_handles_labels()[1]


def line(axis, label):
    return next(one for one in axis.lines if one.get_label() == label)


def drawn(what, tmp_path):
    draw_run(what, tmp_path / "figure.png")
    return (tmp_path / "figure.png").read_bytes()


def test_panels_in_the_papers_order_with_units():
    figure = run_figure(result())
    titles = [axis.get_title(loc="left") for axis in figure.axes]
    assert titles == [
        "Top view",
        "a) Interaction force",
        "b) Stubbornness",
        "c) Target utility",
        "d) Angular velocity",
        "e) Lateral offset",
    ]
    units = [axis.get_ylabel() for axis in figure.axes]
    assert [text.split("(")[-1] for text in units] == ["m)", "N)", "1)", "1)", "rad/s)", "m)"]
    assert figure.axes[-1].get_xlabel() == "time (s)"
    assert len({axis.get_xlim() for axis in figure.axes[1:]}) == 1
    assert figure.axes[1].get_xlim() == (0.0, 20.0)


def test_curves_carry_the_columns():
    what = result()
    axes = by_title(run_figure(what))
    for title, label, column in (
        ("Interaction force", "$F_y$ measured", "fy"),
        ("Interaction force", "$F_y$ intended", "fy_intent"),
        ("Stubbornness", r"$x_\omega$ true", "true_stubbornness_omega"),
        ("Stubbornness", r"$\hat{x}_\omega$ smoothed", "smoothed_stubbornness_omega"),
        ("Target utility", r"$U_\mathrm{target}$", "target_utility"),
        ("Angular velocity", r"$\omega_A^*$ wish", "wish_omega"),
        ("Angular velocity", r"$\hat{\omega}_H$ estimated", "est_omega"),
        ("Lateral offset", "base", "y"),
    ):
        drawn_line = line(axes[title], label)
        np.testing.assert_array_equal(drawn_line.get_xdata(), what.trace["t"])
        np.testing.assert_allclose(drawn_line.get_ydata(), what.trace[column], atol=1e-12)


def test_the_forward_dimension_is_drawn_only_where_it_is_not_zero():
    axes = by_title(run_figure(result()))
    assert labels(axes["Interaction force"]) == ["$F_y$ measured", "$F_y$ intended"]
    assert len(labels(axes["Stubbornness"])) == 3
    axes = by_title(run_figure(result(columns={"fx": 0.5, "true_stubbornness_v": 0.3})))
    assert "$F_x$ measured" in labels(axes["Interaction force"])
    assert "$x_v$ true" in labels(axes["Stubbornness"])


@pytest.mark.parametrize(
    ("dimensions", "amplitude", "shown"),
    [("both", 0.2, True), ("both", 0.0, False), ("omega", 0.2, False)],
)
def test_forward_velocity_has_a_panel_where_it_is_negotiated(dimensions, amplitude, shown):
    speed = 0.8 + amplitude * np.sin(np.arange(400) / 50.0)
    what = result(chosen=scenario(dimensions=dimensions), columns={"est_v": speed})
    assert ("Forward velocity" in by_title(run_figure(what))) is shown


def test_the_top_view_is_to_scale_and_shows_everything():
    what = result()
    figure = run_figure(what)
    figure.canvas.draw()
    axis = figure.axes[0]
    box = axis.get_window_extent()
    (left, right), (bottom, top) = axis.get_xlim(), axis.get_ylim()
    assert box.width / (right - left) == pytest.approx(box.height / (top - bottom), rel=0.01)
    assert left < -0.3
    assert right > 16.0 + 0.28
    assert bottom < -1.5
    assert top > 1.5
    assert labels(axis) == [
        "path", "base", "human", "$p_H$ true", r"$\hat{p}_H$ estimated", "$p_A^*$",
    ]  # fmt: skip
    assert any(patch.get_radius() == 0.4 for patch in axis.patches if hasattr(patch, "get_radius"))
    assert "puddle (seen by human)" in [text.get_text() for text in axis.texts]


def test_wishes_are_the_arcs_of_the_twists_over_the_horizon():
    what = result()
    axis = run_figure(what).axes[0]
    arcs = next(c for c in axis.collections if c.get_label() == "$p_A^*$").get_segments()
    starts = np.stack((what.trace["x"], what.trace["y"]), axis=-1)
    horizon = what.scenario.automation.negotiation.horizon
    for arc in arcs:
        row = int(np.argmin(np.hypot(*(starts - arc[0]).T)))
        after = min(row + 1, len(starts) - 1)
        twist = what.trace["wish_v"][after], what.trace["wish_omega"][after]
        end = compose([*starts[row], 0.0], arc_displacement(twist, horizon))
        np.testing.assert_allclose(arc[-1], end[:2], atol=1e-9)
    assert len(arcs) >= 4


def test_obstacles_and_bent_paths_enter_the_window():
    far = Obstacle(20.0, 5.0, 1.0, "pillar")
    bent = World(Path(((0.0, 0.0), (8.0, 0.0), (8.0, 8.0))), None, (far,))
    what = result(chosen=scenario(bent))
    window = window_of(what, what.trace.columns())
    assert window.right > 21.0
    assert window.top > 6.0
    offset = line(by_title(run_figure(what))["Lateral offset"], "base").get_ydata()
    expected = bent.path.relative_pose(what.trace.values[:, 1:4])[:, 1]
    np.testing.assert_allclose(offset, expected)


def test_an_automation_without_opinion(tmp_path):
    what = result(columns=dict.fromkeys(OPINIONS, np.nan))
    axes = by_title(run_figure(what))
    assert labels(axes["Stubbornness"]) == [r"$x_\omega$ true"]
    assert labels(axes["Target utility"]) == []
    assert [text.get_text() for text in axes["Target utility"].texts] == ["nothing recorded"]
    assert "$p_H$ true" in labels(axes["Top view"])
    assert "$p_A^*$" not in labels(axes["Top view"])
    assert drawn(what, tmp_path)


def test_holes_in_a_column_stay_holes():
    values = np.where(np.arange(400) < 100, np.nan, 0.5)
    shown = line(
        by_title(run_figure(result(columns={"target_utility": values})))["Target utility"],
        r"$U_\mathrm{target}$",
    ).get_ydata()
    np.testing.assert_array_equal(np.isnan(shown), np.isnan(values))


@pytest.mark.parametrize(
    ("clearance", "label"),
    [(0.25, "closest: 0.25 m clear"), (-0.1, "overlap: 0.10 m"), (np.inf, None), (np.nan, None)],
)
def test_closest_approach(clearance, label):
    what = result(columns={"clearance": clearance})
    found = labels(by_title(run_figure(what))["Lateral offset"])
    assert found == (["base", label] if label else ["base"])


def test_the_closest_approach_stands_at_its_time():
    what = result()
    what.trace.values[:20, list(UNITS).index("clearance")] = np.inf
    what.trace.values[20:40, list(UNITS).index("clearance")] = np.nan
    marks = [one for one in run_figure(what).axes[-1].lines if one.get_marker() == "v"]
    assert marks[0].get_xdata()[0] == what.trace["t"][np.nanargmin(what.trace["clearance"])]


@pytest.mark.parametrize("rows", [0, 1, 2])
def test_short_traces(rows, tmp_path):
    what = result(rows, error="human 'mine:Human' failed")
    assert drawn(what, tmp_path)
    if rows == 1:
        force = line(by_title(run_figure(what))["Interaction force"], "$F_y$ measured")
        assert force.get_marker() == "o"


@pytest.mark.parametrize(
    ("attributes", "reason"),
    [
        ({"error": "human 'mine:Human' failed at t = 10 s: ValueError: $\\nosuch$"}, "ValueError"),
        ({"summary": {"end": "collision"}}, "collision"),
    ],
)
def test_an_early_end_is_marked_with_its_reason(attributes, reason, tmp_path):
    what = result(200, **attributes)
    figure = run_figure(what)
    assert "ENDED EARLY" in figure.get_suptitle()
    assert reason in figure.get_supxlabel()
    axes = by_title(figure)
    assert "ended at 10 s" in [text.get_text() for text in axes["Interaction force"].texts]
    assert axes["Interaction force"].get_xlim()[1] == pytest.approx(12.5)
    assert "ended here" in labels(axes["Top view"])
    assert drawn(what, tmp_path)


def test_a_run_that_went_its_whole_way_is_not_marked():
    figure = run_figure(result(summary={"end": "goal"}))
    assert "ENDED EARLY" not in figure.get_suptitle()
    assert "ended here" not in labels(figure.axes[0])


def test_the_footer_says_what_the_sensor_lost():
    shares = {"samples": 100, "saturated": 0.25, "lost": 0.0}
    said = "sensor: 25 % of samples at the end of a channel's range"
    texts = [
        run_figure(result(summary={"end": "goal", "sensor": sensor})).get_supxlabel()
        for sensor in (shares, shares | {"saturated": 0.0})
    ]
    assert [said in text for text in texts] == [True, False]


def test_heading_and_verdicts():
    verdicts = [
        Verdict("dry", "always (clearance >= 0.0)", 0.132, True),
        Verdict("gentle", "always (fy <= 4.0)", -1.1, False, 9.85),
        Verdict("known", "always (wish_v > 0)", np.nan, False, 0.05, "wish_v is not a number"),
    ]
    figure = run_figure(result(verdicts=verdicts))
    heading = figure.get_suptitle()
    for part in ("synthetic", "bullet", "escalating", "stubbornness", "seed 7", "2 of 3"):
        assert part in heading.replace("\n", " ")
    first, second, third = figure.get_supxlabel().split("\n")
    assert first.startswith("pass   dry")
    assert "margin 0.132" in first
    assert second.startswith("FAIL   gentle")
    assert "-1.1, first violated at t = 9.85 s" in second
    assert "not a number" in third
    assert "nan" not in third


def test_the_same_run_gives_the_same_bytes_whatever_the_user_has_set(tmp_path):
    plain = drawn(result(100), tmp_path)
    with matplotlib.rc_context({"font.size": 20.0, "axes.grid": False, "lines.linewidth": 9.0}):
        before = dict(matplotlib.rcParams)
        assert drawn(result(100), tmp_path) == plain
        assert dict(matplotlib.rcParams) == before
    assert plain[:4] == b"\x89PNG"
    assert b"Software" not in plain
    assert int.from_bytes(plain[16:20], "big") == 1400


def test_names_that_are_no_formulas_and_not_in_the_font(tmp_path):
    assert drawn(result(100, chosen=scenario(name="price $\\nosuch$ 水")), tmp_path)


def test_reported_values_stand_on_their_panels(tmp_path):
    marks = [
        ("stubbornness", 9.0, 0.4, "0.40"),
        ("stubbornness", 9.7, 0.33, "0.33"),
        ("target_utility", 15.5, float("nan"), "15.5 s"),
        ("y", 11.0, 0.52, "0.52 m"),
    ]
    figure = paper_figure(result(), marks)
    axes = by_title(figure)
    assert len(figure.axes) == 5
    diamonds = next(one for one in axes["Stubbornness"].lines if one.get_marker() == "D")
    assert list(zip(*diamonds.get_data(), strict=True)) == [(9.0, 0.4), (9.7, 0.33)]
    assert [text.get_text() for text in axes["Stubbornness"].texts] == ["0.40", "0.33"]
    assert not [one for one in axes["Target utility"].lines if one.get_marker() == "D"]
    assert any(
        np.array_equal(one.get_xdata(), [15.5, 15.5]) for one in axes["Target utility"].lines
    )
    assert "reported in the paper" in labels(axes["Interaction force"])
    with pytest.raises(KeyError, match="speed"):
        paper_figure(result(), [("speed", 1.0, 1.0, "1")])
    draw_paper_panels(result(), tmp_path / "panels.png", marks)
    assert (tmp_path / "panels.png").stat().st_size > 20_000


def test_every_panel_of_the_paper_keeps_its_height():
    # A mark without a value once pushed the panels apart.
    figure = paper_figure(result(), [("omega", 12.0, float("nan"), "12 s")])
    figure.canvas.draw()
    heights = [axis.get_position().height for axis in figure.axes]
    assert min(heights) > 0.12
    assert max(heights) == pytest.approx(min(heights), rel=0.05)


def test_legends_leave_the_titles_free():
    what = result(
        chosen=scenario(dimensions="both"),
        columns={
            "est_v": np.linspace(0.6, 0.9, 400),
            "fx": 0.5,
            "fx_intent": 0.4,
            "true_stubbornness_v": 0.3,
            "est_stubbornness_v": 0.2,
            "smoothed_stubbornness_v": 0.2,
        },
    )
    for figure in (run_figure(what), paper_figure(result(), [("y", 11.0, 0.5, "0.5")])):
        figure.canvas.draw()
        for axis in figure.axes:
            title = axis.title if axis.title.get_text() else axis._left_title
            assert axis.get_legend().get_window_extent().x0 > title.get_window_extent().x1


def test_utility_loss_curves(tmp_path):
    settings = ((-2.0, 2.0), (-1.0, 1.0), (0.0, 2.0))
    axis = utility_loss_figure(settings).axes[0]
    for one, (low, high) in zip(axis.lines, settings, strict=True):
        x, y = one.get_data()
        assert (x[0], x[-1]) == (-2.0, 2.0)
        np.testing.assert_allclose(y, utility_loss(x, low, high))
        assert y.min() >= 0.0
        assert y.max() <= 1.0
    assert len({one.get_linestyle() for one in axis.lines}) == 3
    draw_utility_loss(tmp_path / "loss.png")
    assert (tmp_path / "loss.png").stat().st_size > 5_000


def test_bodies_are_drawn_by_their_outlines_and_in_red_where_they_ended():
    outlines = {
        "base": rectangle(-0.2, 0.8, -0.25, 0.25),
        "human": across(0.45, 0.24),
        "load": rectangle(-1.6, -0.4, -0.2, 0.2, underside=0.9),
    }
    touched = {"body": "load", "thing": "world.obstacles.0 (pillar)"}
    what = result(
        columns={"theta": np.pi / 2, "human_theta": np.pi / 2},
        outlines=outlines,
        summary={"end": "collision", "contact": touched},
    )
    figure = run_figure(what)
    # Breadth along x: they walk along y.
    sizes = {"base": (0.5, 1.0), "human": (0.45, 0.24), "load": (0.4, 1.2)}
    drawn = {name: [] for name in sizes}
    for collection in figure.axes[0].collections:
        for path in collection.get_paths():
            extent = np.ptp(path.vertices, axis=0)
            for name, size in sizes.items():
                if np.allclose(extent, size, atol=0.011):
                    drawn[name].append(to_hex(collection.get_edgecolor()[0]).upper())
    for name, colours in drawn.items():
        assert len(colours) > 3, name
        assert colours.count(FAULT) == 1, name
    assert "collision of the load with world.obstacles.0 (pillar)" in figure.get_supxlabel()
