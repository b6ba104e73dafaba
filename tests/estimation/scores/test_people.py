import numpy as np
import pytest

from cowalk.estimation import bootstrap, by_person, equal_weights, held_out, mean_over_people
from cowalk.estimation.scores.people import People
from cowalk.sim.basics.errors import InputError


def test_runs_then_people_then_families_count_alike():
    squared = [1.0, 3.0, 4.0, 10.0, np.nan]
    person = ["ann", "ann", "bob", "ann", "bob"]
    family = ["steady"] * 3 + ["game"] * 2
    people = by_person(squared, person, family)
    assert len(people.values) == 3
    # steady: ann 2, bob 4; game: another ann 10; the run that tells nothing counts for nobody.
    assert mean_over_people(people) == pytest.approx((3.0 + 10.0) / 2.0)


def test_a_run_that_lacks_one_of_what_is_compared_is_left_out_for_all():
    people = by_person([[1.0, 2.0], [np.nan, 50.0]], ["ann", "ann"], ["steady"] * 2)
    assert mean_over_people(people).tolist() == [1.0, 2.0]


def test_nothing_to_average_and_labels_that_do_not_fit_are_refused():
    with pytest.raises(InputError, match="nothing to average"):
        by_person([np.nan], ["ann"], ["steady"])
    with pytest.raises(InputError, match="one person and one family a run"):
        by_person([1.0, 2.0], ["ann"], ["steady"])


def population(seed, people=20, families=("a", "b")):
    rng = np.random.default_rng(seed)
    labels = np.repeat(families, people)
    hard = rng.gamma(4.0, 1.0, (labels.size, 1))  # some people are hard for everybody
    noise = rng.uniform(0.9, 1.1, (labels.size, 2))
    return People(hard * noise * (1.0, 0.8), labels)


def first(means):
    return np.sqrt(means[..., 0])


def ratio(means):
    return means[..., 1] / means[..., 0]


def test_one_seed_one_interval():
    people = population(0)
    assert bootstrap(people, first, seed=3) == bootstrap(people, first, seed=3)
    assert bootstrap(people, first, seed=3) != bootstrap(people, first, seed=4)


def test_pairing_is_kept():
    people = population(0)
    value, low, high = bootstrap(people, ratio)
    assert low < 0.8 < high
    assert value == pytest.approx(0.8, abs=0.03)
    other = np.roll(people.values[:, 1], 1)  # somebody else's
    unpaired = bootstrap(people._replace(values=np.stack((people.values[:, 0], other), 1)), ratio)
    assert high - low < 0.3 * (unpaired.high - unpaired.low)


def test_families_are_not_mixed():
    # Within each family all are alike: between families alone, people differ.
    people = People(np.array([[1.0], [1.0], [5.0], [5.0], [5.0]]), np.array([*"aabbb"]))
    assert bootstrap(people, lambda means: means[..., 0]) == (3.0, 3.0, 3.0)


def test_the_interval_holds_the_truth_about_as_often_as_it_says():
    truth = np.sqrt(4.0)  # the mean of the gamma distribution
    intervals = [bootstrap(population(seed), first, 400) for seed in range(200)]
    held = np.mean([low <= truth <= high for _, low, high in intervals])
    assert 0.88 < held <= 0.99


def test_one_person_is_no_sample():
    with pytest.raises(InputError, match="'b' has 1 person"):
        bootstrap(People(np.ones((3, 1)), np.array([*"aab"])), first)


def test_nobody_is_scored_by_what_was_fitted_on_their_family():
    person, family = np.array([*"abcdab"]), np.array([*"xxyyzz"])
    splits = list(held_out(person, family))
    assert len(splits) == 3
    for fit, score in splits:
        assert not set(family[fit]) & set(family[score])
    assert np.sum([score for _, score in splits], axis=0).tolist() == [1] * 6


def test_in_one_family_nobody_is_scored_by_what_was_fitted_on_themselves():
    person = np.array([*"aabbc"])
    for fit, score in held_out(person, ["x"] * 5):
        assert not set(person[fit]) & set(person[score])
    with pytest.raises(InputError, match="one person alone"):
        list(held_out(["a", "a"], ["x", "x"]))


def test_rows_weigh_as_people_and_families_do():
    person, family = [*"aaabc"], [*"xxxxy"]
    weights = equal_weights(person, family)
    assert weights == pytest.approx([1 / 12] * 3 + [1 / 4, 1 / 2])
    values = np.array([1.0, 2.0, 6.0, 5.0, 9.0])
    assert weights @ values == pytest.approx(mean_over_people(by_person(values, person, family)))
