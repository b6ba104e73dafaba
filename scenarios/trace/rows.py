"""Where the numbers of a trace's row come from, by the names of its columns."""

from __future__ import annotations

import numpy as np

from cowalk.agents.basics.protocols import Belief, Truth
from cowalk.estimation.scores.rows import demand, identifiable, insistence
from cowalk.sim.env.env import CowalkEnv
from cowalk.sim.robot.wheels import wheel_speeds

from .columns import UNITS


def of_state(env: CowalkEnv) -> dict[str, float]:
    """Return what a row says of plant and sensor after a control step."""
    state, reading = env.plant_state, env.sensor_reading
    force, (v, omega) = env.applied
    samples = len(reading.wrench)
    wheels = env.plant.wheels
    left, right = wheel_speeds(v, omega, *wheels) if wheels else (np.nan, np.nan)
    return dict(
        zip(
            _STATE,
            (
                *state.pose,
                *state.twist,
                v,
                omega,
                *(reading.force.sum(axis=0) / samples).tolist(),
                *(reading.wrench.sum(axis=0) / samples).tolist(),
                *force,
                *state.human_pose,
                *(state.wrench_on_base.sum(axis=0) / samples).tolist(),
                state.work,
                *state.drive,
                left,
                right,
                float(state.footing_held),
            ),
            strict=True,
        )
    )


_STATE = (
    *("x", "y", "theta", "v", "omega", "v_cmd", "omega_cmd", "fx", "fy"),
    *(name for name in UNITS if name.startswith("sensor_")),
    *("fx_intent", "fy_intent", "human_x", "human_y", "human_theta"),
    *(name for name in UNITS if name.startswith(("interaction_force", "interaction_torque"))),
    *("work", "drive_force", "drive_torque", "wheel_left", "wheel_right", "footing_held"),
)


def of_truth(truth: Truth, time: float, env: CowalkEnv) -> dict[str, float]:
    """Return what a row says of what the human wants, and what can be known of it.

    Parameters
    ----------
    truth : Truth
    time : float
        Of the row, s.
    env : CowalkEnv
        After that control step.
    """
    force, twist_before, upper = env.applied[0], env.felt, env.bounds.upper
    asked = demand(truth.stubbornness, truth.wish, twist_before, upper)
    # What the definition asks for counts as well: noise may take a force that is cut below its
    # limit again.
    meant = np.maximum(np.abs(force), np.abs(truth.strength * truth.gain * asked))
    readable = identifiable(
        time,
        truth.stubbornness,
        truth.wish,
        twist_before,
        meant,
        lower=env.bounds.lower,
        upper=upper,
        gain=truth.gain,
        force_limit=np.minimum(np.minimum(truth.strength, truth.limit), env.force_limit),
    )
    return {
        **pair("true_stubbornness", truth.stubbornness),
        **pair("true", truth.wish),
        **pair("true_demand", asked),
        **pair("true_insistence", insistence(force, truth.strength)),
        **pair("identifiable", readable.astype(float)),
    }


def of_belief(belief: Belief) -> dict[str, float]:
    """Return what a row says of what the automation believes, its own columns included."""
    return {
        **pair("est_stubbornness", belief.stubbornness),
        **pair("est_stubbornness_deviation", belief.stubbornness_deviation),
        **pair("smoothed_stubbornness", belief.stubbornness_smoothed),
        **pair("est", belief.human_wish),
        **pair("est_deviation", belief.human_wish_deviation),
        **pair("wish", belief.wish),
        "interaction": float(belief.interaction),
        "interaction_smoothed": float(belief.interaction_smoothed),
        "utility_loss": float(belief.utility_loss),
        "target_utility": float(belief.target_utility),
        "negotiation": float(belief.negotiation),
        **belief.extras,
    }


def pair(name: str, values: np.ndarray) -> dict[str, float]:
    """Return two numbers, of v and of omega, by the names of their columns."""
    v, omega = values.tolist()
    return {f"{name}_v": v, f"{name}_omega": omega}
