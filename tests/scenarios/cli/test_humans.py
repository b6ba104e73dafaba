"""The commands about humans, as a user calls them."""

import json
import re
from functools import partial

import numpy as np
import pytest
from matplotlib.image import imread

from cowalk.agents import IMPERFECTIONS
from cowalk.scenarios.files.assembling import build_human
from cowalk.scenarios.files.loading import load
from cowalk.scenarios.files.schema import HumanComponent
from cowalk.scenarios.people.loading import load_population
from cowalk.scenarios.people.person import Person
from cowalk.scenarios.people.responses import answer, fixed_points, push, settled_stubbornness
from cowalk.scenarios.studies import human_pictures
from cowalk.scenarios.studies.human_table import compare_humans, estimate, row, write_table
from cowalk.sim.basics.errors import InputError

NONE = {"collision": 0, "grip lost": 0, "lost footing": 0}


def built(name, **parameters):
    return build_human(HumanComponent(name=name, parameters=parameters), "unicycle", 0.05)


def test_sample_prints_what_the_population_draws(cowalk):
    code, out, _ = cowalk("humans", "sample", "uncertain", "-n", "3", "--seed", "7", "--json")
    assert code == 0
    people = [
        Person(HumanComponent.model_validate(each.pop("human")), **each)
        for each in json.loads(out)["people"]
    ]
    assert people == load_population("uncertain").draw(3, seed=7)
    code, out, _ = cowalk("humans", "sample", "uncertain", "-n", "3", "--seed", "7")
    assert code == 0
    for person in people:
        assert person.human.name in out
        assert person.kind in out
        assert f"height {person.plant['body']['height']:.3g}" in " ".join(out.split())


def test_people_for_a_plant_whose_body_walks_are_drawn_without_ripple(cowalk):
    for plant, there in (("unicycle", True), ("bullet", False)):
        code, out, _ = cowalk("humans", "sample", "determined", "-n", "2", "--plant", plant)
        assert (code, "gait-ripple" in out) == (0, there)


def test_show_draws_a_human(cowalk, tmp_path):
    file = tmp_path / "deep" / "human.png"
    code, out, _ = cowalk("humans", "show", "steady", "--imperfection", "tremor", "--out", file)
    assert code == 0
    assert "0.50" in out  # the default level
    assert imread(file).shape == (868, 1400, 4)


def test_show_says_where_its_picture_is_and_where_both_dimensions_settle(cowalk, folder):
    level = "human.parameters.level=[0.2,0.6]"
    code, out, _ = cowalk("humans", "show", "steady", "--set", level, "--out", "mine", "--json")
    assert code == 0
    found = json.loads(out)
    assert found["picture"] == "mine.png"
    assert (folder / "mine.png").is_file()
    expected = {"v": [pytest.approx(0.2)], "omega": [pytest.approx(0.6)]}
    assert found["fixed points"] == expected


@pytest.mark.parametrize("name", IMPERFECTIONS.names())
def test_every_imperfection_is_seen_alone(cowalk, tmp_path, name):
    file = tmp_path / "alone.png"
    code, out, _ = cowalk("humans", "show", "--imperfection", name, "--out", file, "--json")
    assert code == 0
    assert imread(file).std() > 0.02
    # What it does is large enough to be seen: tremor, the smallest, is 1 % of 10 N.
    assert json.loads(out)["largest change"] >= 0.09


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("show",), "name a human model, an --imperfection, or both"),
        (("show", "steady", "--out", "x.pdf"), "pictures are PNG; write x.png"),
        (("show", "stedy"), "unknown human 'stedy'; did you mean 'steady'?"),
        (("show", "steady", "--imperfection", "tremro"), "did you mean 'tremor'?"),
        (("show", "steady", "--set", "human.name=game"), "cowalk humans show game"),
        (("show", "steady", "--set", "plant=bullet"), "only keys of human can be set here"),
        (("show", "steady", "--set", "human.parameters.level=[2,0]"), "level = "),
        (("sample", "uncertain", "--plant", "bulet"), "did you mean 'bullet'?"),
        (("table", "--plant", "bullet", "--write", "no.md"), "--write no.md: cannot be read"),
        (("sample", "nobody"), "unknown population 'nobody'"),
    ],
)
def test_a_mistake_gets_one_line(cowalk, arguments, message):
    code, out, error = cowalk("humans", *arguments)
    assert code == 2
    assert message in error
    assert error.count("\n") == 1
    assert not out


def test_check_takes_an_agent(cowalk, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = "from cowalk.agents.humans.steady import SteadyHuman\nclass Faulty(SteadyHuman):\n"
    text += "    def truth(self):\n        return None\n"
    (tmp_path / "faulty_models.py").write_text(text)
    code, out, _ = cowalk("check", "faulty_models:Faulty")
    assert code == 2
    assert out == (
        "faulty_models:Faulty (human): truth returned None: "
        "return Truth(wish=np.array([v, omega]), stubbornness=np.array([s_v, s_omega]))\n"
    )
    code, out, _ = cowalk("check", "cowalk.agents.humans.steady:SteadyHuman")
    assert (code, out) == (0, "cowalk.agents.humans.steady:SteadyHuman: no fault (human)\n")


def test_an_agent_that_cannot_be_found_is_an_error_like_any_other(cowalk, folder):
    code, out, error = cowalk("check", "nowhere:Nobody", "my_models:Quiet")
    assert code == 2
    assert error == "cowalk: 'nowhere:Nobody' cannot be imported: No module named 'nowhere'\n"
    assert out.startswith("my_models:Quiet (human): ")


def test_humans_list_is_list_humans(cowalk):
    for arguments in ((), ("--json",)):
        assert cowalk("humans", "list", *arguments) == cowalk("list", "humans", *arguments)
    assert "tit-for-tat" in cowalk("humans", "list")[1]


def test_imperfections_and_populations_are_listed(cowalk):
    for kind, names in (("imperfections", IMPERFECTIONS.names()), ("populations", ["determined"])):
        code, out, _ = cowalk("list", kind, "--json")
        assert code == 0
        described = {entry["name"]: entry["description"] for entry in json.loads(out)[kind]}
        assert set(names) <= set(described)
        assert all(described.values())


def test_a_steady_human_answers_as_the_definition_says():
    human = built("steady", level=[0.5, 0.5])
    unyielding, yielding = answer(human, 0.0), answer(human, 1.0)
    # gain s (p_H - p_A)/p_ub of 7.5 N, forward: 2 * 0.5 * (0.8 - 0.6)/1.2
    np.testing.assert_allclose(unyielding.force[:, 0], 7.5 * 0.2 / 1.2)
    assert np.ptp(unyielding.force[:, 1]) < 1e-12
    assert np.abs(yielding.force[-20:]).max() < 0.1


CONCESSIONS = np.linspace(0.0, 1.0, 11)


@pytest.mark.parametrize(
    ("curve", "points", "jumps"),
    [
        (lambda c: 0.75 - 0.5 * c, [0.5], []),
        (lambda c: 0.3, [0.3], []),
        (lambda c: 0.0, [0.0], []),
        (lambda c: 1.0 / (1.0 + np.exp(60.0 * (c - 0.45))), [0.4531], []),  # steep
        (lambda c: float(c > 0.703), [0.0, 1.0], [0.703]),
        (lambda c: 0.9 - 0.8 * (c > 0.52), [], [0.52]),
        (lambda c: 1.0 if c < 1.0 else np.nan, [], []),
    ],
)
def test_fixed_points_are_where_the_curves_meet_not_where_one_jumps(curve, points, jumps):
    values = np.array([curve(c) for c in CONCESSIONS], dtype=float)
    found, jumped = fixed_points(CONCESSIONS, values, np.vectorize(curve, otypes=[float]))
    assert found == pytest.approx(points, abs=1e-3)
    assert jumped == pytest.approx(jumps, abs=1e-3)


def settled(name, *concessions, **parameters):
    return settled_stubbornness(built(name, **parameters), np.array(concessions))


def test_settled_stubbornness_is_what_the_page_says():
    d_v = (0.8 - 0.6) / 1.2
    np.testing.assert_allclose(settled("steady", 0.1, level=[0.2, 0.6]), [[0.2, 0.6]])
    # s0 (1 - c), also where the little that is left in v is less than a twentieth of its bound
    np.testing.assert_allclose(settled("tit-for-tat", 0.3, 0.8)[:, 0], [0.7, 0.2], atol=1e-3)
    np.testing.assert_allclose(settled("slacking", 0.2)[0, 0], 0.4 * 0.8 * d_v / 0.2, atol=1e-3)
    # Insisted on slowly: in v u = D/tolerance = 0.83, which takes more than 10 s from 0.3 to 1.
    np.testing.assert_allclose(settled("escalating", 0.1)[0], [1.0, 1.0])
    # B v_ub/(gain F_max) = 1.2, cut to 1; in omega the wish lies beyond the bound.
    np.testing.assert_allclose(settled("impedance", 0.1, 0.9), 1.0)
    np.testing.assert_allclose(settled("crossover", 0.1, 0.9), 0.75)


class OneAtATime:
    """A human of a user's, who answers for one without saying so."""

    def __init__(self, human):
        self.human = human

    def reset(self, rng, situation):
        self.human.reset(rng, situation)

    def act(self, observation):
        force = self.human.act(observation)
        return force if force.ndim == 1 else force[0]

    def truth(self):
        return self.human.truth()


@pytest.mark.parametrize("name", ["escalating", "game", "tit-for-tat", "crossover"])
def test_a_batch_settles_where_each_human_alone_does(name):
    human, concessions = built(name), np.array([0.0, 0.35, 1.0])
    alone = settled_stubbornness(OneAtATime(human), concessions)
    np.testing.assert_allclose(settled_stubbornness(human, concessions), alone, rtol=1e-12)


@pytest.mark.parametrize("name", ["steady", "conceding", "tit-for-tat", "escalating"])
def test_nothing_settles_where_nothing_is_left_to_insist_on(name):
    assert np.isnan(settled(name, 1.0)).all()


def test_a_conceding_humans_clock_makes_no_fixed_point(cowalk, tmp_path):
    file = tmp_path / "picture.png"
    code, out, _ = cowalk("humans", "show", "conceding", "--out", file, "--json")
    assert code == 0
    assert json.loads(out)["fixed points"] == {"v": [0.0], "omega": [0.0]}


def test_an_open_loop_human_is_shown_on_a_push(cowalk, tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr(
        human_pictures, "draw_human", lambda human, *rest: shown.append(human) or {}
    )
    assert cowalk("humans", "show", "open-loop", "--out", tmp_path / "picture.png")[0] == 0
    assert (np.abs(answer(shown[0], 0.0).force).max(axis=0) > 1.0).all()


def test_the_prescribed_push_rises_holds_and_ends():
    profile = np.array(push(8.0, 10.0))
    assert profile[:, 2].max() == pytest.approx(10.0)
    assert (profile[profile[:, 0] > 5.7, 2] == 0.0).all()


def test_an_interval_covers_the_mean_as_often_as_it_says():
    rng = np.random.default_rng(0)
    hits = [(e := estimate(rng.normal(3.0, 1.0, 30))).low <= 3.0 <= e.high for _ in range(200)]
    assert 0.88 <= np.mean(hits) <= 0.98  # 95 %, the bootstrap of 30 a little less


def test_an_estimate_leaves_out_what_is_not_known():
    assert estimate(np.array([np.nan, 2.0, 4.0])).value == 3.0
    assert estimate(np.array([2.0, 2.0])).low == estimate(np.array([2.0, 2.0])).high == 2.0
    assert np.isnan(estimate(np.array([np.nan]))).all()
    alone = estimate(np.array([np.nan, 2.0]))
    assert alone.value == 2.0
    assert np.isnan([alone.low, alone.high]).all()


def test_the_table_compares_pairs_and_goes_into_a_document(tmp_path):
    scenario = load("puddle", ["plant=unicycle", "duration=6.0"])
    pairs = {"humans": ("steady", "slacking"), "automations": ("never-yields", "always-yields")}
    cells = compare_humans(scenario, 3, jobs=1, **pairs)
    assert [(cell.human, cell.automation) for cell in cells] == [
        (human, automation) for human in pairs["humans"] for automation in pairs["automations"]
    ]
    for cell in cells:
        effort = cell.metrics["intended effort"]
        assert effort.low <= effort.value <= effort.high
        assert cell.runs == cell.known["intended effort"] == 3
        assert cell.passes == 0  # of the puddle's expectations, in 6 s
        assert cell.ended_early == NONE
    steady = cells[0].metrics  # walks 6 s at the 0.8 m/s that both want
    a_metre = steady["intended effort a metre"].value
    assert a_metre == pytest.approx(steady["intended effort"].value / 4.8, rel=0.02)
    assert cells == compare_humans(scenario, 3, jobs=1, **pairs)
    file = tmp_path / "humans.md"
    file.write_text("# Humans\n\n<!-- humans-table -->\nold\n<!-- /humans-table -->\n\nThe end.\n")
    write_table(file, cells, "puddle", "unicycle", 3)
    text = file.read_text()
    assert "old" not in text
    assert text.endswith("<!-- /humans-table -->\n\nThe end.\n")
    assert len(re.findall(r"^\| (steady|slacking) ", text, re.MULTILINE)) == 4
    with pytest.raises(InputError, match="no place for the table"):
        write_table(_without_marks(tmp_path), cells, "puddle", "unicycle", 3)
    with pytest.raises(InputError, match="at least 2 seeds"):
        compare_humans(scenario, 1)


def test_the_table_says_which_runs_ended_early(cowalk):
    pair = {"humans": ("bounded-memory",), "automations": ("never-yields", "always-yields")}
    straight, weaving = compare_humans(load("puddle", ["plant=unicycle"]), 2, jobs=1, **pair)
    assert straight.ended_early == NONE
    assert weaving.ended_early == NONE | {"collision": 2}
    assert row(straight)[-1] == "none"
    assert row(weaving)[-1] == "2 by collision"
    # They carry on for less long, so that less effort adds up; it is not less by the metre.
    weaving, straight = weaving.metrics, straight.metrics
    assert weaving["intended effort"].value < straight["intended effort"].value


def test_the_table_is_printed_with_its_note_and_as_json(cowalk, scenario_file, monkeypatch):
    few = partial(compare_humans, jobs=1, humans=("steady",))
    monkeypatch.setattr("cowalk.scenarios.studies.human_table.compare_humans", few)
    file = scenario_file(("duration: 3.0", "duration: 1.0"))
    code, out, _ = cowalk("humans", "table", file, "-n", "2", "--json")
    assert code == 0
    (first, *_) = json.loads(out)["cells"]
    assert first["ended_early"] == NONE
    assert set(first["metrics"]) >= {"intended effort", "intended effort a metre"}
    code, out, _ = cowalk("humans", "table", file, "-n", "2")
    assert "ended early" in out
    assert "compare that by the metre" in out


def _without_marks(folder):
    file = folder / "other.md"
    file.write_text("nothing\n")
    return file
