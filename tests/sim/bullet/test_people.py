"""People of any size hold on and walk: a grid of heights and builds."""

import numpy as np
import pytest

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.anthropometry import BodyParameters, yaw_inertia
from cowalk.sim.body.walker import Legs, WalkerParameters, legs_of
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.pair import stability
from cowalk.sim.world.world import World

WORLD = World(Path(((0, 0), (60, 0))))
HEIGHTS, MASS_INDICES = (1.2, 1.4, 1.75, 2.05, 2.2), (15.0, 22.0, 40.0)


@pytest.mark.parametrize("coupling", ["handle", "stretcher"])
@pytest.mark.parametrize("hand", ["left", "right", "both"])
@pytest.mark.parametrize("height", HEIGHTS)
def test_people_of_any_size_walk_along(height, hand, coupling):
    for index in MASS_INDICES:
        plant = BulletPlant(
            Rates(),
            body={"height": height, "mass": index * height**2, "hand": hand},
            coupling={"kind": coupling},
            walker={"hand_stiffness": 50.0, "hand_damping": 5.0},
            gait={"enabled": True},
        )
        plant.reset(WORLD, np.random.default_rng(0))
        states = [plant.step((0.8, 0.0), (0.0, 0.0)) for _ in range(60)]
        plant.close()
        x, y, yaw = np.subtract(states[-1].human_pose, states[-1].pose) - plant._pair.place
        assert abs(states[-1].twist[0] - 0.8) < 0.05
        assert np.hypot(x, y) < 0.15, "in their place, but for the sway"
        assert abs(yaw) < 0.15
        force = np.concatenate([state.force_on_base for state in states[40:]])[:, :2]
        limit = 12.0 if coupling == "handle" else 30.0
        assert np.hypot(*force.T).max() < limit


def test_legs_go_with_the_body_and_the_default_persons_are_as_given():
    walker = WalkerParameters(stiffness=1000.0, damping=333.3, yaw_stiffness=37.1, yaw_damping=9.7)
    assert legs_of(walker, BodyParameters()) == Legs(1000.0, 333.3, 37.1, 9.7)
    child = BodyParameters(1.2, 35.0)
    legs = legs_of(walker, child)
    turn = yaw_inertia(child) / yaw_inertia(BodyParameters())
    assert turn < 0.25
    assert legs == pytest.approx((500.0, 333.3 / 2.0, 37.1 * turn, 9.7 * turn))


@pytest.mark.parametrize(("height", "mass", "most"), [(1.4, 29.4, 0.025), (1.2, 21.6, 0.0125)])
def test_legs_that_are_too_late_are_not_blamed_on_the_physics_rate(height, mass, most, monkeypatch):
    """What gains that do not go with the body would do."""
    usual = BodyParameters()
    monkeypatch.setattr(stability, "legs_of", lambda walker, _: legs_of(walker, usual))
    with pytest.raises(InputError) as refused:
        BulletPlant(Rates(), body={"height": height, "mass": mass})
    message = str(refused.value)
    assert message.startswith("walker.delay = 0.05 s: the legs of this body")
    assert f"({height} m, {mass} kg)" in message
    assert f"at most {most} works here, or lower walker.damping and walker.yaw" in message
    plant = BulletPlant(Rates(), body={"height": height, "mass": mass}, walker={"delay": most})
    plant.close()


@pytest.mark.parametrize(
    ("walker", "words"),
    [({"delay": 0.2}, "walker.delay = 0.2 s: the legs"), ({"yaw_damping": 60.0}, "walker.yaw_da")],
)
@pytest.mark.parametrize(("height", "mass"), [(1.3, 30.0), (2.1, 110.0)])
def test_what_is_refused_of_anybody_is_named(height, mass, walker, words):
    with pytest.raises(InputError, match=words):
        BulletPlant(Rates(), body={"height": height, "mass": mass}, walker=walker)
