"""The sensor's section of a scenario: a preset by its name, and what is changed about it."""

import itertools

import numpy as np
import pytest

from cowalk.scenarios import run
from cowalk.scenarios.files.loading import faults, load, to_yaml
from cowalk.scenarios.trace.sensor_faults import sensor_faults
from cowalk.sim.basics.errors import InputError
from cowalk.sim.body.grip import GRIPS
from cowalk.sim.robot.coupling import COUPLINGS
from cowalk.sim.robot.drive import DRIVES
from cowalk.sim.sensor.parameters import SensorParameters
from cowalk.sim.sensor.presets import PRESETS, sensor_preset


@pytest.fixture
def with_sensor(folder):
    def write(sensor):
        file = folder / "sensing.scenario.yaml"
        file.write_text(
            "name: sensing\nworld: {path: {points: [[0, 0], [5, 0]]}}\nplant: unicycle\n"
            f"sensor: {sensor}\nhuman: steady\nautomation: stubbornness\n"
        )
        return file

    return write


def test_a_preset_stands_for_its_parameters(with_sensor):
    assert load(with_sensor("laboratory")).sensor == sensor_preset("laboratory")
    changed = load(with_sensor("{preset: industrial, noise_density: 0.5, bias: [1, 2]}")).sensor
    assert changed == sensor_preset("industrial", noise_density=0.5, bias=(1.0, 2.0))
    assert load(with_sensor("{noise_density: 0.1}")).sensor == SensorParameters(noise_density=0.1)


@pytest.mark.parametrize("off", ["off", "none", "false", "null", "{}"])
def test_a_sensor_can_be_taken_off(with_sensor, off):
    assert load(with_sensor(off)).sensor == SensorParameters()
    assert load(with_sensor("industrial"), (f"sensor={off}",)).sensor == SensorParameters()
    if off != "{}":
        assert load(with_sensor(f"{{preset: {off}}}")).sensor == SensorParameters()
        late = load(with_sensor("industrial"), (f"sensor.preset={off}", "sensor.latency=0.01"))
        assert late.sensor == sensor_preset("none", latency=0.01)


def test_a_preset_can_be_set_and_changed_from_the_command_line(with_sensor):
    file = with_sensor("laboratory")
    changed = load(file, ("sensor=low-cost", "sensor.range=50")).sensor
    assert changed == sensor_preset("low-cost", range=50.0)
    assert load(file, ("sensor.preset=industrial",)).sensor == sensor_preset("industrial")


def test_what_is_written_out_loads_as_an_equal_sensor(with_sensor, folder):
    scenario = load(with_sensor("low-cost"))
    copy = folder / "copy.yaml"
    copy.write_text(to_yaml(scenario))
    assert load(copy).sensor == scenario.sensor


@pytest.mark.parametrize(
    ("sensor", "named"),
    [
        (
            "laboratry",
            "sensor.preset: unknown sensor preset 'laboratry'; did you mean 'laboratory'?",
        ),
        ("{preset: 3}", "unknown sensor preset '3'"),
        ("{preset: low-cost, rang: 3}", "sensor.rang: unknown key; did you mean 'range'?"),
        ("{noise: [0.1, 0.1]}", "sensor.noise: unknown key"),
        ("{drop_rate: 2}", "sensor.drop_rate = 2.0: must lie between 0 and 0.99"),
        ("{bias: [1, a]}", "sensor.bias.1 = 'a': a number is expected, not text"),
        ("{tare: 1}", "sensor.tare = 1: true or false is expected"),
        ("{bias: [1, 2, 3, 4]}", "bias has 4 entries; give one number, or 3 for x, y and z"),
        ("{torque_range: -1}", "torque_range = -1.0 N m: must lie between 0.001 and 100000 N m"),
        (
            "{cross_talk: [[0, 1, 2]]}",
            "cross_talk = ((0.0, 1.0, 2.0),): give one number, or 6 rows",
        ),
        ("{cross_talk: [[1, 2], [3]]}", "cross_talk = ((1.0, 2.0), (3.0,)): give one number, or 6"),
        ("{torque_bias: []}", "sensor.torque_bias has 0 entries; give one number, or 3 for x, y"),
        ("{bias: [0, 1e300]}", "sensor.bias = 1e+300 N: must lie between -10000 and 10000 N"),
        ("{preset: industrial, range: 0.005}", "sensor.resolution = 0.01 N: must not be above"),
        ("{rate: 0.0001}", "sensor.rate = 0.0001 Hz: must lie between 1 and 1e+06 Hz, or be 0"),
    ],
)
def test_faults_are_named(with_sensor, sensor, named):
    file = with_sensor(sensor)
    found = faults(file)
    assert any(named in str(fault) for fault in found), found
    assert {fault.line for fault in found} == {4}
    with pytest.raises(InputError):
        load(file)


def test_shares_of_lost_and_saturated_samples_are_told(with_sensor):
    told = []
    for sensor in ("{drop_rate: 0.05}", "{range: 2.0}", "{}"):
        # From standing, so that there is something to push for.
        changes = ["duration=10", "human.parameters.level=[1, 1]", "start=standing"]
        result = run(load(with_sensor(sensor), changes))
        assert result.error is None, result.error
        told.append((result.summary["sensor"], sensor_faults(result.summary)))
    (lossy, lost), (narrow, saturated), (_, well) = told
    # 6 s to the end of the corridor, at 240 Hz; losses are binomial: five standard deviations.
    assert lossy["samples"] > 1200
    apart = 5.0 * (0.05 * 0.95 / lossy["samples"]) ** 0.5
    assert lossy["lost"] == pytest.approx(0.05, abs=apart)
    assert lossy["saturated"] == narrow["lost"] == 0.0
    assert (
        lost
        == f"{100.0 * lossy['lost']:.2g} % of samples lost on their way, an older one read again"
    )
    assert narrow["saturated"] > 0.0
    assert (
        saturated
        == f"{100.0 * narrow['saturated']:.2g} % of samples at the end of a channel's range"
    )
    assert well is None


@pytest.mark.parametrize(
    ("share", "said"),
    [
        (1.0, "100 %"),
        (0.9996, "over 99 %"),
        (0.994, "99 %"),
        (0.123, "12 %"),
        (0.0996, "10 %"),
        (0.0512, "5.1 %"),
        (0.000814, "0.081 %"),
    ],
)
def test_a_share_is_said_in_plain_digits(share, said):
    summary = {"sensor": {"saturated": share, "lost": 0.0}}
    assert sensor_faults(summary) == f"{said} of samples at the end of a channel's range"


OPTIONS = list(itertools.product(PRESETS, DRIVES, GRIPS, COUPLINGS))


@pytest.mark.parametrize("option", OPTIONS, ids="-".join)
def test_every_sensor_on_every_way_of_building_the_plant(option):
    preset, drive, grip, coupling = option
    built = [
        f"plant.parameters.drive.kind={drive}",
        f"plant.parameters.grip.kind={grip}",
        f"plant.parameters.coupling.kind={coupling}",
        "duration=1.5",
        "expect={}",
    ]
    if (drive, coupling) == ("wheels", "stretcher") and preset != "industrial":
        with pytest.raises(InputError, match=r"sensor.torque_range = .* 25.* N m about y"):
            run(load("walk", [*built, f"sensor={preset}"]))
        built.append("plant.parameters.coupling.mass=4")
    sensed = [run(load("walk", [*built, f"sensor={preset}"])) for _ in range(2)]
    assert sensed[0].error is None, sensed[0].error
    assert sensed[0].trace.values.tobytes() == sensed[1].trace.values.tobytes()
    read = sensed[0].trace.columns()
    assert all(np.isfinite(read[name]).all() for name in read if name.startswith("sensor_"))
