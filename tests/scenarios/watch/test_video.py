"""Films of runs: what the file holds, what is drawn where, and that watching changes nothing."""

import subprocess
import sys

import imageio_ffmpeg
import numpy as np
import pytest

from cowalk.scenarios import load, make_env, run
from cowalk.scenarios.trace.trace import Trace
from cowalk.scenarios.watch.video import ARROW_ABOVE, Video
from cowalk.scenarios.watch.video_frame import FORCE, HEADER, HEIGHT, INSET, VIEW, WIDTH
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.view.scene import Scene, look_at
from cowalk.sim.view.viewer import CAMERA_SIDE
from cowalk.sim.world.world import World

SHORT = "duration=0.3"


def decoded(file):
    """Return what a player says about a file, and its frames."""
    command = [imageio_ffmpeg.get_ffmpeg_exe(), "-i", file, "-f", "rawvideo", "-pix_fmt", "rgb24"]
    played = subprocess.run([*command, "-"], capture_output=True, check=True)
    frames = np.frombuffer(played.stdout, np.uint8).reshape(-1, HEIGHT, WIDTH, 3)
    return played.stderr.decode().partition("Output #0")[0], frames


def near(picture, colour, tolerance=40):
    """Return where a picture has a colour (#rrggbb)."""
    wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return (np.abs(picture.astype(int) - wanted) < tolerance).all(axis=-1)


class Stills:
    """A watcher that lets a film be drawn from rows of one's own."""

    def __init__(self, video, **row):
        self.video, self.row = video, row
        self.frame = None

    def start(self, scenario, env):
        self.video.start(scenario, env)

    def step(self, env, trace):
        own = Trace()
        last = trace.last()
        own.append(last | self.row)
        self.env, self.frame = env, self.video.picture(env, own)
        plant = env.plant
        if hasattr(plant, "viewer"):
            self.camera = plant.viewer().camera("chase", *VIEW)
            self.handle = plant.handle

    def close(self):
        self.video.close()


def still(tmp_path, **row):
    video = Video(tmp_path / "still.mp4")
    watcher = Stills(video, **row)
    result = run(load("puddle", ["duration=0.05"]), watchers=[watcher])
    assert result.error is None, result.error
    return watcher


@pytest.mark.parametrize("plant", ["bullet", "unicycle"])
def test_a_film_is_h264_in_real_time_and_changes_no_bit_of_the_run(tmp_path, plant):
    scenario = load("puddle", [SHORT, f"plant={plant}"])
    files = [tmp_path / "deep" / "one.mp4", tmp_path / "two.mp4"]
    traces = [run(scenario, watchers=[Video(file)]).trace for file in files]
    assert files[0].read_bytes() == files[1].read_bytes(), "frames are deterministic"
    assert traces[0].values.tobytes() == run(scenario).trace.values.tobytes()
    about, frames = decoded(files[0])
    for words in ("Video: h264", "yuv420p", f"{WIDTH}x{HEIGHT}", "20 fps"):
        assert words in about
    assert len(frames) == len(traces[0]) == 6


def test_a_fast_control_rate_still_plays_in_real_time(tmp_path):
    rates = ["rates.control=80", "rates.physics=240", "rates.sensor=240"]
    run(load("puddle", [SHORT, "plant=unicycle", *rates]), watchers=[Video(tmp_path / "a.mp4")])
    about, frames = decoded(tmp_path / "a.mp4")
    assert "20 fps" in about
    assert len(frames) == 6


def test_the_arrow_is_the_measured_force_at_the_handle(tmp_path):
    watcher = still(tmp_path, fx=0.0, fy=5.0)
    x, y, height = watcher.handle
    height += ARROW_ABOVE
    tail, tip = watcher.camera.project([(x, y, height), (x, y + 0.5, height)])
    drawn = near(watcher.frame[HEADER:, : VIEW[0]], FORCE, 30)
    row, column = np.argwhere(drawn).T
    along = (tip - tail) / np.hypot(*(tip - tail))
    reach = (np.stack((column, row), axis=-1) - tail) @ along
    assert reach.min() == pytest.approx(0.0, abs=4.0)
    assert reach.max() == pytest.approx(np.hypot(*(tip - tail)), abs=4.0)
    none = still(tmp_path, fx=0.0, fy=0.0)
    assert near(none.frame[HEADER:, : VIEW[0]], FORCE, 30).sum() == 0


def test_hand_and_handle_are_where_the_arrow_starts():
    env = make_env("puddle")
    env.reset(seed=0)
    viewer = env.plant.viewer()
    camera = viewer.camera("chase", *VIEW)
    actors = np.asarray(viewer.look(camera)[1]) > 0
    places = Scene(viewer.client).places()
    column, row = camera.project(env.plant.handle).astype(int)
    assert actors[row, column], "somebody is there, not floor or wall"
    np.testing.assert_allclose(places["base/handle"][0], env.plant.handle, atol=1e-6)
    feet = camera.project([*env.plant_state.human_pose[:2], 0.9]).astype(int)
    assert actors[feet[1], feet[0]]
    assert not actors[:20].any(), "nobody in the sky"
    assert 0.02 < actors.mean() < 0.3
    env.close()


@pytest.mark.parametrize("hand", ["left", "right", "both"])
@pytest.mark.parametrize("coupling", ["handle", "stretcher"])
@pytest.mark.parametrize("height", [1.2, 1.75, 2.2])
def test_people_of_any_height_are_wholly_in_the_picture_with_some_air(height, coupling, hand):
    body = {"height": height, "mass": 70.0 * (height / 1.75) ** 2, "hand": hand}
    plant = BulletPlant(Rates(), body=body, coupling={"kind": coupling})
    state = plant.reset(World(Path(((0.0, 0.0), (20.0, 0.0)))), np.random.default_rng(0))
    viewer = plant.viewer()
    camera = viewer.camera("chase", *VIEW)
    actors = np.asarray(viewer.look(camera)[1]) > 0
    plant.close()
    rows, columns = (np.flatnonzero(actors.any(axis=axis)) for axis in (1, 0))
    for found, size in ((rows, VIEW[1]), (columns, VIEW[0])):
        assert 0.05 * size < found[0] < found[-1] < 0.97 * size
    head = camera.project((*state.human_pose[:2], height))[1]
    feet = camera.project((*state.human_pose[:2], 0.0))[1]
    assert 0.3 * VIEW[1] < feet - head < 0.8 * VIEW[1], "and not far away either"
    if height <= 1.75:
        middle = np.add(state.pose[:2], state.human_pose[:2]) / 2.0
        usual = look_at((*middle, 0.8), 3.3, -90.0 - CAMERA_SIDE, -24.0, 50.0, VIEW)
        np.testing.assert_array_equal(camera.view, usual.view)
        np.testing.assert_array_equal(camera.projection, usual.projection)


@pytest.mark.parametrize("height", [1.2, 1.75, 2.1])
@pytest.mark.parametrize("length", [2.0, 3.0])
def test_who_carries_a_long_load_is_wholly_in_the_picture(length, height):
    load = {"kind": "stretcher", "length": length}
    plant = BulletPlant(Rates(), body={"height": height}, coupling=load)
    state = plant.reset(World(Path(((0.0, 0.0), (20.0, 0.0)))), np.random.default_rng(0))
    camera = plant.viewer().camera("chase", *VIEW)
    plant.close()
    for high in (0.0, height):
        column, row = camera.project((*state.human_pose[:2], high))
        assert 0.1 * VIEW[0] < column < 0.9 * VIEW[0]
        assert 0.1 * VIEW[1] < row < 0.95 * VIEW[1]


@pytest.mark.parametrize(("share", "other"), [(0.25, 0.75), (0.75, 0.25)])
def test_bars_are_as_long_as_what_they_stand_for(tmp_path, share, other):
    watcher = still(
        tmp_path,
        est_stubbornness_v=share,
        true_stubbornness_v=other,
        est_stubbornness_omega=np.nan,
        true_stubbornness_omega=0.0,
        target_utility=other,
    )
    panel = watcher.frame[HEADER + INSET[1] :, VIEW[0] + 86 : WIDTH - 62]
    full = panel.shape[1]
    orange, pale, blue = (near(panel, c, 10) for c in ("#D55E00", "#F0BE9F", "#0072B2"))
    bars = slice(58, 82)
    assert orange[bars].sum(axis=1).max() == pytest.approx(share * full, abs=3)
    assert pale[bars].sum(axis=1).max() == pytest.approx(other * full, abs=3)
    assert orange[84:108].sum() == 0, "an unknown belief has no bar"
    assert blue[140:164].sum(axis=1).max() == pytest.approx(other * full, abs=3)


def test_the_pair_walks_through_the_film(tmp_path):
    scenario = load("puddle", ["duration=1.2", "rates.control=10"])
    run(scenario, watchers=[Video(tmp_path / "a.mp4")])
    _, frames = decoded(tmp_path / "a.mp4")
    seen = frames[[0, 7, 11], HEADER:, : VIEW[0]].astype(int)
    changed = np.abs(np.diff(seen, axis=0)).max(axis=-1) > 20
    assert (changed.mean(axis=(1, 2)) > 0.01).all()


def test_a_run_that_dies_midway_leaves_a_film_of_it(folder, scenario_file):
    scenario = load(str(scenario_file()), ["human=my_models:TurnsToNan"])
    result = run(scenario, watchers=[Video(folder / "a.mp4")])
    assert "nan" in result.error
    assert len(decoded(folder / "a.mp4")[1]) == len(result.trace) == 21


def test_an_encoder_that_dies_costs_the_film_and_nothing_else(tmp_path):
    (tmp_path / "a.mp4").write_text("an older film")
    video = Video(tmp_path / "a.mp4")

    class Killer:
        def start(self, scenario, env):
            video._process.kill()
            video._process.wait()

        def step(self, env, trace):
            pass

        def close(self):
            pass

    result = run(load("puddle", [SHORT, "plant=unicycle"]), watchers=[video, Killer()])
    assert result.error is None
    (said,) = result.lost
    assert "a.mp4 cannot be written" in said
    plain = run(load("puddle", [SHORT, "plant=unicycle"]))
    assert result.trace.values.tobytes() == plain.trace.values.tobytes()
    assert [file.name for file in tmp_path.iterdir()] == ["a.mp4"]
    assert (tmp_path / "a.mp4").read_text() == "an older film"


def test_bad_files_are_refused_before_the_run(tmp_path):
    (tmp_path / "taken").write_text("a regular file")
    with pytest.raises(InputError, match=r"run.avi: the name must end in .mp4"):
        Video(tmp_path / "run.avi")
    with pytest.raises(InputError, match=r"below.mp4: cannot write there"):
        Video(tmp_path / "taken" / "below.mp4")


def test_without_an_encoder_one_line_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(InputError, match=r"needs a video encoder.*: pip install imageio-ffmpeg"):
        Video(tmp_path / "a.mp4")
