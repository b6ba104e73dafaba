"""Every column of a trace and its unit."""

from __future__ import annotations

from collections.abc import Mapping

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.seats import SEATS
from cowalk.sim.env.reward import TERMS

UNITS = {
    "t": "s",
    "x": "m",
    "y": "m",
    "theta": "rad",
    "v": "m/s",
    "omega": "rad/s",
    "v_cmd": "m/s",
    "omega_cmd": "rad/s",
    "fx": "N",
    "fy": "N",
    "sensor_force_x": "N",
    "sensor_force_y": "N",
    "sensor_force_z": "N",
    "sensor_torque_x": "N m",
    "sensor_torque_y": "N m",
    "sensor_torque_z": "N m",
    "fx_intent": "N",
    "fy_intent": "N",
    "human_x": "m",
    "human_y": "m",
    "human_theta": "rad",
    "true_stubbornness_v": "1",
    "true_stubbornness_omega": "1",
    "true_v": "m/s",
    "true_omega": "rad/s",
    "true_demand_v": "1",
    "true_demand_omega": "1",
    "true_insistence_v": "1",
    "true_insistence_omega": "1",
    "identifiable_v": "1",
    "identifiable_omega": "1",
    "est_stubbornness_v": "1",
    "est_stubbornness_omega": "1",
    "smoothed_stubbornness_v": "1",
    "smoothed_stubbornness_omega": "1",
    "est_v": "m/s",
    "est_omega": "rad/s",
    "wish_v": "m/s",
    "wish_omega": "rad/s",
    "interaction": "1",
    "interaction_smoothed": "1",
    "utility_loss": "1",
    "target_utility": "1",
    "negotiation": "1",
    "clearance": "m",
    "interaction_force_x": "N",
    "interaction_force_y": "N",
    "interaction_force_z": "N",
    "interaction_torque_x": "N m",
    "interaction_torque_y": "N m",
    "interaction_torque_z": "N m",
    "work": "J",
    "drive_force": "N",
    "drive_torque": "N m",
    "wheel_left": "rad/s",
    "wheel_right": "rad/s",
    "footing_held": "1",
    "est_stubbornness_deviation_v": "1",
    "est_stubbornness_deviation_omega": "1",
    "est_deviation_v": "m/s",
    "est_deviation_omega": "rad/s",
    "negotiated": "1",
    "reward_human": "1",
    "reward_automation": "1",
    **{f"reward_{seat}_{term}": "1" for seat in SEATS for term in TERMS},
}
"""Every column that each trace has and its unit, in the order of the file.

Row k describes control step k: the state at its end, the decisions in force during it, and
what was measured averaged over it. `fx` and `fy` are the measured force in base axes,
`sensor_...` the whole reading in the sensor's axes, about its origin, `interaction_...` the
wrench itself before the sensor, base axes, about the handle. `work` is what the human did to the
base at the handle in the step, `drive_force` what the ground did along the base and
`drive_torque` about the point of its axle beside the handle, both means over the step.
`wheel_...` is what the command asks of the driven wheels, `footing_held` 1 until the human
loses their footing, `negotiated` 1 in a step that began with a negotiation, `reward_SEAT_TERM`
what each term added to a seat's reward. `true_...` is the human's truth, NaN where nobody knows
it, `identifiable_...` 1 where their stubbornness could be read from force. Columns that an
automation or its observer adds follow these.
"""


def all_columns(added: Mapping[str, str]) -> dict[str, str]:
    """Return the columns of a trace, with those that parts add, and their units.

    Raises
    ------
    InputError
        If an added name is taken, or it or its unit is no text.
    """
    for name, unit in added.items():
        if not (isinstance(name, str) and name and isinstance(unit, str)):
            raise InputError(
                f"column {name!r}: {unit!r}: give a name and a unit, {{'urgency': '1'}}"
            )
        if name in UNITS:
            raise InputError(f"column {name!r}: every trace has it; give another name")
    return UNITS | dict(added)
