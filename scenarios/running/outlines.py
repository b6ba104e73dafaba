"""What a run leaves behind about its bodies: their outlines, and what they ran into."""

from __future__ import annotations

from cowalk.sim.basics.motion import world_to_base
from cowalk.sim.env.env import CowalkEnv
from cowalk.sim.world.contact import contact
from cowalk.sim.world.outline import Outline


def outlines(env: CowalkEnv) -> dict[str, Outline]:
    """Return the outlines of a plant's bodies, that of a load in base axes."""
    found, state = dict(env.plant.bodies.outlines), env.plant_state
    if state.load_pose is not None:
        x, y = world_to_base(state.pose, state.load_pose[:2]).tolist()
        found["load"] = found["load"].moved((x, y, state.load_pose[2] - state.pose[2]))
    return found


def extent(env: CowalkEnv) -> tuple[float, float, float]:
    """Return how far bodies and arms now reach to the left of, to the right of and behind a base.

    From its centre, in its axes, m.
    """
    poses, parts = env.plant_state.poses, env.plant.bodies.parts
    boxes = []
    for number, outline in parts:
        x, y = world_to_base(poses[0], poses[number][:2]).tolist()
        boxes.append(outline.moved((x, y, poses[number][2] - poses[0][2])).box)
    backs, _, rights, lefts = zip(*boxes, strict=True)
    return max(lefts), -min(rights), -min(backs)


def collision(env: CowalkEnv) -> dict[str, str] | None:
    """Return which body of a finished run touches what, by its key, or None if none does."""
    plant, state = env.plant, env.plant_state
    found = contact(env.world, plant.bodies, state.poses, plant.distances, state.time)
    return {"body": found.body, "thing": found.thing} if found else None
