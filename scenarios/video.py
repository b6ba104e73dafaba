"""A run as a video: chase and top camera, the force, both sides' wishes, beliefs beside the truth."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from cowalk.sim import topview
from cowalk.sim.camera import Camera, level_camera
from cowalk.sim.errors import InputError, SimulationError
from cowalk.sim.motion import compose

from .figures_style import AUTOMATION, HUMAN
from .results import UNITS
from .video_frame import (
    FORCE,
    HEADER,
    INSET,
    METRES_PER_NEWTON,
    PALE,
    VIEW,
    WIDTH,
    HEIGHT,
    Frame,
    draw_arrow,
    draw_band,
)
from .watching import arc_points, writable_file

if TYPE_CHECKING:
    from cowalk.sim.bullet_view import Viewer
    from cowalk.sim.env import CowalkEnv

    from .results import Trace
    from .schema import Scenario

FRAMES_PER_SECOND = 20
"""At most about so many; a slower control rate gives a frame each step."""
BANDS = (
    ("true", 0.16, PALE, 0.8),
    ("est", 0.07, HUMAN, 0.9),
    ("wish", 0.07, AUTOMATION, 0.9),
)
"""Prefix of the trace columns, width in m, colour and opacity of each wish, undermost first."""


@runtime_checkable
class Filmed(Protocol):
    """A plant whose bodies a camera can see."""

    @property
    def handle(self) -> tuple[float, float, float]:
        """Where the handle is, base axes, m."""

    def viewer(self) -> Viewer:
        """Return what shows the plant as it is now."""


class Video:
    """A watcher that writes an H.264 video, in real time at the control rate.

    A plant without cameras is drawn from above. The file can be played whatever ends the run.

    Parameters
    ----------
    file : str or Path
        Ends in ``.mp4``; its folder is created.

    Raises
    ------
    InputError
        If the file cannot be written, or no video encoder is installed.
    """

    def __init__(self, file: str | Path) -> None:
        self.file = writable_file(file, "--video", ".mp4")
        self._encoder = _encoder()
        self._process: subprocess.Popen[bytes] | None = None

    def start(self, scenario: Scenario, env: CowalkEnv) -> None:
        """See `Watcher.start`."""
        self._every = max(1, round(scenario.rates.control / FRAMES_PER_SECOND))
        self._horizon = scenario.automation.negotiation.horizon
        self._frame = Frame(
            scenario.name,
            f"human {scenario.human.name}    automation {scenario.automation.name}    "
            f"plant {scenario.plant.name}    seed {scenario.seed}",
        )
        rate = f"{scenario.rates.control}/{self._every}"
        raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{WIDTH}x{HEIGHT}", "-r", rate]
        packed = ["-c:v", "libx264", "-preset", "veryfast", "-crf", "23", "-pix_fmt", "yuv420p"]
        # Written in fragments that play by themselves, joined at the end: nothing is lost if
        # even the encoder is killed.
        packed += ["-movflags", "hybrid_fragmented", "-fflags", "+bitexact"]
        self._process = subprocess.Popen(
            [self._encoder, "-y", "-v", "error", *raw, "-i", "-", *packed, str(self.file)],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            start_new_session=True,  # an interrupt from the keyboard is ours alone
        )

    def step(self, env: CowalkEnv, trace: Trace) -> None:
        """See `Watcher.step`."""
        if (len(trace) - 1) % self._every:
            return
        assert self._process is not None
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(self.picture(env, trace).tobytes())
        except OSError as error:
            raise SimulationError(self._failure()) from error

    def picture(self, env: CowalkEnv, trace: Trace) -> NDArray[np.uint8]:
        """Return the frame of the trace's last row, uint8, shape (544, 960, 3)."""
        row = dict(zip(UNITS, trace.values[-1].tolist(), strict=True))
        frame = self._frame
        frame.clear()
        frame.clock(row["t"])
        plant = env.plant
        if isinstance(plant, Filmed):
            viewer = plant.viewer()
            handle = plant.handle
            for kind, size, place in (
                ("chase", VIEW, (0, HEADER)),
                ("top", INSET, (VIEW[0], HEADER)),
            ):
                camera = viewer.camera(kind, *size)
                frame.place(self._scene(viewer.picture(*size, kind), camera, row, handle), *place)
            top = HEADER + INSET[1]
        else:
            camera = level_camera(*topview.window(env.world, env.plant_state, *VIEW), *VIEW)
            drawn = topview.draw(env.world, env.plant_state, *VIEW, force=False)
            frame.place(self._scene(drawn, camera, row, (0.0, 0.0, 0.0)), 0, HEADER)
            top = HEADER + 60
        _gauges(frame, top, row)
        return frame.pixels()

    def _scene(
        self,
        seen: NDArray[np.uint8],
        camera: Camera,
        row: dict[str, float],
        handle: tuple[float, float, float],
    ) -> Image.Image:
        """Draw wishes and force into what a camera sees."""
        image = Image.fromarray(seen)
        pose = np.array([row["x"], row["y"], row["theta"]])
        for prefix, width, colour, opacity in BANDS:
            wish = np.array([row[f"{prefix}_v"], row[f"{prefix}_omega"]])
            draw_band(
                image, camera, arc_points(pose, wish, self._horizon), width, colour, opacity
            )
        push = np.array([row["fx"], row["fy"]]) * METRES_PER_NEWTON
        ends = compose(pose, [(*handle[:2], 0.0), (*(handle[:2] + push), 0.0)])
        tail, tip = camera.project([(*end[:2], handle[2]) for end in ends])
        draw_arrow(image, tail, tip)
        return image

    def close(self) -> None:
        """See `Watcher.close`.

        Raises
        ------
        SimulationError
            If the video could not be finished.
        """
        process, self._process = self._process, None
        if process is None:
            return
        _, said = process.communicate()
        if process.returncode != 0:
            raise SimulationError(self._failure(said))

    def _failure(self, said: bytes | None = None) -> str:
        if said is None and self._process is not None:
            _, said = self._process.communicate()
        self._process = None
        reason = (said or b"").decode(errors="replace").strip().splitlines()
        return f"the video {self.file} cannot be written: {reason[-1] if reason else 'no reason'}"


def _gauges(frame: Frame, top: float, row: dict[str, float]) -> None:
    frame.heading(top + 16, "the human's stubbornness")
    frame.key(top + 38, ((PALE, "true"), (HUMAN, "believed by the automation")))
    for line, (name, dimension) in enumerate((("forward", "v"), ("turning", "omega"))):
        frame.gauge(
            top + 60 + 25 * line,
            name,
            row[f"est_stubbornness_{dimension}"],
            HUMAN,
            row[f"true_stubbornness_{dimension}"],
        )
    frame.heading(top + 122, "utility the automation demands")
    frame.gauge(top + 144, "target", row["target_utility"], AUTOMATION)
    frame.heading(top + 182, "force on the handle")
    frame.reading(top + 204, f"{row['fx']:+.1f} N forward   {row['fy']:+.1f} N left", "")
    frame.key(top + 236, ((FORCE, "force"), (HUMAN, "human's wish"), (AUTOMATION, "automation's")))


def _encoder() -> str:
    """Return the path of ffmpeg."""
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        found: str = get_ffmpeg_exe()
    except (ImportError, RuntimeError) as error:
        raise InputError(
            "--video needs a video encoder, which is not installed: pip install imageio-ffmpeg"
        ) from error
    return found
