"""What the gait does to the measured force: where its peaks are, how high, and where from."""

import math

import numpy as np
import pytest
from scipy import signal

from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.footing import Footing
from cowalk.sim.body.gait import GaitParameters, step_frequency
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.sensor.presets import sensor_preset
from cowalk.sim.sensor.sensor import ForceSensor
from cowalk.sim.world.world import World

WORLD = World(Path(((0, 0), (60, 0))))
RELAXED = {"hand_stiffness": 50.0, "hand_damping": 5.0}
"""The low end of what is measured for human arms."""


class Walk:
    """Forty steps of walking straight with nothing intended, after six seconds to settle."""

    def __init__(self, speed, seed=0, walker=RELAXED, **gait):
        plant = BulletPlant(Rates(), walker=walker, gait=gait)
        plant.reset(WORLD, np.random.default_rng(seed))
        for _ in range(120):
            plant.step((speed, 0.0), (0.0, 0.0))
        steps = math.ceil(40.0 / step_frequency(speed) * 20.0)
        states = [plant.step((speed, 0.0), (0.0, 0.0)) for _ in range(steps)]
        plant.close()
        self.wrenches = [state.wrench_on_base for state in states]
        self.force = np.concatenate(self.wrenches)[:, :2]
        self.speed = states[-1].twist[0]
        bases = np.array([state.pose for state in states])
        places = np.array([state.human_pose for state in states])[:, :2] - bases[:, :2]
        cos, sin = np.cos(bases[:, 2]), np.sin(bases[:, 2])
        self.place = np.stack(
            (cos * places[:, 0] + sin * places[:, 1], cos * places[:, 1] - sin * places[:, 0]), -1
        )
        self.arm, self.posture = plant._pair.body.arms[0], plant._pair.body.posture


def amplitude(samples, rate, frequencies):
    """Return the amplitude (rows: frequencies) of each column, by a Hann-windowed transform."""
    window = np.hanning(len(samples))[:, None]
    time = np.arange(len(samples)) / rate
    waves = np.exp(-2j * np.pi * np.outer(frequencies, time))
    return 2.0 * np.abs(waves @ ((samples - samples.mean(axis=0)) * window)) / window.sum()


def peak(samples, rate, axis):
    frequencies = np.arange(0.3, 4.0, 0.004)
    return frequencies[amplitude(samples, rate, frequencies)[:, axis].argmax()]


@pytest.fixture(scope="module", params=[0.8, 1.2])
def walk(request):
    return request.param, Walk(request.param, enabled=True)


def test_peaks_are_at_the_step_frequency_and_half_of_it(walk):
    speed, measured = walk
    steps = step_frequency(speed)
    assert measured.speed == pytest.approx(speed, abs=0.01)
    assert peak(measured.force, 240.0, 0) == pytest.approx(steps, rel=0.02)
    assert peak(measured.force, 240.0, 1) == pytest.approx(steps / 2.0, rel=0.02)


def impedance_force(measured, speed, percentile, k=50.0, b=5.0):
    """Return the force of a sway, fore-aft at the step frequency and lateral at half of it, N.

    F = (K + j w B - w^2 Lambda) x: the arm's spring, damper, and inertia between a moving
    shoulder and a held hand, for small sway.
    """
    mass = measured.arm.apparent_mass(*measured.posture)
    sizes = []
    for axis, frequency in enumerate((step_frequency(speed), step_frequency(speed) / 2.0)):
        w = 2.0 * math.pi * frequency
        impedance = (k + 1j * w * b) * np.eye(2) - w**2 * mass
        sway = GaitParameters(percentile=percentile).sway_at(speed)[axis]
        sizes.append(abs(impedance[axis, axis]) * sway / 2.0)
    return np.array(sizes)


def test_the_ripple_is_within_the_band_of_measured_sway(walk):
    """Sway is published, its force is not: the band is that of the sway, through the arm."""
    speed, measured = walk
    steps = step_frequency(speed)
    ripple = np.diag(amplitude(measured.force, 240.0, [steps, steps / 2.0]))
    low, middle, high = (impedance_force(measured, speed, p) for p in (5.0, 50.0, 95.0))
    assert (low < ripple).all()
    assert (ripple < high).all()
    # The arm's levers turn as it gives way, and the trunk turns a little: not the small sway.
    assert ripple == pytest.approx(middle, rel=0.15)


def test_the_trunk_sways_as_measured(walk):
    speed, measured = walk
    steps = step_frequency(speed)
    sway = np.diag(amplitude(measured.place, 20.0, [steps, steps / 2.0]))
    assert 2.0 * sway == pytest.approx(GaitParameters().sway_at(speed), rel=0.07)


@pytest.mark.parametrize(("percentile", "least", "most"), [(50.0, 0.14, 0.19), (95.0, 0.2, 0.26)])
def test_walking_takes_a_share_of_the_weight_that_shoes_hold(percentile, least, most, monkeypatch):
    asked = []
    bear = Footing.bear

    def noted(self, x, y):
        asked.append(math.hypot(x, y))
        return bear(self, x, y)

    monkeypatch.setattr(Footing, "bear", noted)
    for speed in (0.8, 1.2):
        asked.clear()
        plant = BulletPlant(Rates(), gait={"enabled": True, "percentile": percentile})
        plant.reset(WORLD, np.random.default_rng(0), (speed, 0.0))
        for _ in range(60):
            plant.step((speed, 0.0), (0.0, 0.0))
        plant.close()
        assert least < max(asked) / (70.0 * 9.81) < most


def test_relaxed_contact_is_as_light_as_measured():
    """Contact without a task measures at most 3 N (s41598-024-53991-4)."""
    for seed in (0, 1):
        force = Walk(0.8, seed, enabled=True).force
        assert np.hypot(*force.T).mean() <= 3.0


@pytest.fixture(scope="module")
def gliding():
    return Walk(0.8)


def test_without_gait_there_is_no_ripple(gliding):
    assert np.hypot(*gliding.force.T).max() < 0.05


INDUSTRIAL = sensor_preset("industrial")


def read(walked):
    """Return the planar force behind the industrial sensor."""
    sensor = ForceSensor(INDUSTRIAL, 240)
    sensor.reset(np.random.default_rng(0))
    return np.concatenate([sensor.measure(wrench).force for wrench in walked.wrenches])


def floor(samples):
    """Return the amplitude that the sensor's noise shows in a line of the spectrum, N.

    Standard deviation of a Hann-windowed line: density times sqrt(2 B), the window's noise
    bandwidth B being 1.5 over the duration.
    """
    return INDUSTRIAL.noise_density * math.sqrt(2.0 * 1.5 * 240.0 / samples)


def test_peaks_and_band_stand_behind_the_industrial_sensor(walk):
    """It delays the gait and lays noise under it, and changes its size by no more than 3 %."""
    speed, measured = walk
    steps = step_frequency(speed)
    lines = [steps, steps / 2.0]
    seen = read(measured)
    assert peak(seen, 240.0, 0) == pytest.approx(steps, rel=0.02)
    assert peak(seen, 240.0, 1) == pytest.approx(steps / 2.0, rel=0.02)
    ripple = np.diag(amplitude(seen, 240.0, lines))
    low, _, high = (impedance_force(measured, speed, p) for p in (5.0, 50.0, 95.0))
    assert (low < ripple).all()
    assert (ripple < high).all()
    noise = floor(len(seen))
    assert ripple.min() > 30.0 * noise, "far above the floor"
    exact = np.diag(amplitude(measured.force, 240.0, lines))
    # Cross-talk mixes the axes, whose lines are apart, so that only 2 % of the other's remain.
    assert ripple == pytest.approx(exact, rel=0.03)
    # Where there is no gait the floor is as high as the sensor says (Rayleigh: mean sqrt(pi)/2).
    quiet = amplitude(seen - measured.force, 240.0, np.arange(10.0, 20.0, 0.11))
    assert quiet.mean() == pytest.approx(noise * math.sqrt(math.pi) / 2.0, rel=0.25)


def test_without_gait_the_industrial_sensor_reads_its_own_noise(gliding):
    seen, steps = read(gliding), step_frequency(0.8)
    assert amplitude(seen, 240.0, [steps, steps / 2.0]).max() < 0.05
    assert np.hypot(*seen.mean(axis=0)) < 0.05, "what noise has left in the tare"
    # Of the white noise a sample keeps what the low-pass's response to an impulse sums up to.
    low_pass = signal.butter(2, INDUSTRIAL.low_pass, fs=240.0)
    response = signal.lfilter(*low_pass, np.eye(1, 480)[0])
    expected = INDUSTRIAL.noise_density * math.sqrt(120.0 * response @ response)
    assert seen.std(axis=0) == pytest.approx((expected, expected), rel=0.05)


def test_more_sway_more_force_and_a_softer_arm_less():
    plain, more = Walk(0.8, enabled=True).force, Walk(0.8, enabled=True, percentile=95.0).force
    stiffer = {"hand_stiffness": 100.0, "hand_damping": 10.0}
    firm = Walk(0.8, walker=stiffer, enabled=True).force
    assert (more.std(axis=0) > 1.3 * plain.std(axis=0)).all()
    assert (firm.std(axis=0) > 1.5 * plain.std(axis=0)).all()


def test_standing_still_reads_nothing():
    plant = BulletPlant(Rates(), gait={"enabled": True})
    plant.reset(WORLD, np.random.default_rng(0))
    states = [plant.step((0.0, 0.0), (0.0, 0.0)) for _ in range(60)]
    plant.close()
    assert np.abs(np.concatenate([s.force_on_base for s in states])).max() < 1e-6
