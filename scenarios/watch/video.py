"""A run as a video: chase and top camera, force, both wishes, beliefs beside the truth."""

from __future__ import annotations

import os
import subprocess
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from cowalk.sim.basics.errors import InputError, SimulationError
from cowalk.sim.basics.motion import compose
from cowalk.sim.view import top_view as topview
from cowalk.sim.view.camera import Camera, level_camera

from ..export.file import unfinished, writable_file
from ..figures.style import AUTOMATION, HUMAN
from .video_frame import (
    FORCE,
    HEADER,
    HEIGHT,
    INSET,
    METRES_PER_NEWTON,
    PALE,
    VIEW,
    WIDTH,
    VideoFrame,
    draw_arrow,
    draw_band,
    draw_shadow,
)
from .watcher import Filmed, arc_points

if TYPE_CHECKING:
    from cowalk.sim.env.env import CowalkEnv

    from ..files.schema import Scenario
    from ..trace.trace import Trace

FRAMES_PER_SECOND = 20
"""At most about so many; a slower control rate gives a frame each step."""
BANDS = (
    ("true", 0.16, PALE, 0.8),
    ("est", 0.07, HUMAN, 0.9),
    ("wish", 0.07, AUTOMATION, 0.9),
)
"""Prefix of the trace columns, width in m, colour and opacity of each wish, undermost first."""


ARROW_ABOVE = 0.12
"""How far above the handle the force is drawn, m: the hand is to be seen."""


class Video:
    """A watcher that writes an H.264 video, in real time at the control rate.

    A plant without cameras is drawn from above. Until it is finished it is called
    ``NAME.unfinished.mp4``, which can be played whatever ends the process; a film that is there
    already stays until then.

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
        self.file = writable_file(file, ".mp4")
        # Absolute, so that no name is taken for an option or a protocol.
        self._written = str(unfinished(self.file.absolute()))
        self._encoder = _encoder()
        self._process: subprocess.Popen[bytes] | None = None

    def start(self, scenario: Scenario, env: CowalkEnv) -> None:
        """See `Watcher.start`."""
        self._every = max(1, round(scenario.rates.control / FRAMES_PER_SECOND))
        self._horizon = scenario.automation.negotiation.horizon
        self._frame = VideoFrame(
            scenario.name,
            f"human {scenario.human.name}    automation {scenario.automation.name}    "
            f"plant {scenario.plant.name}    seed {scenario.seed}",
        )
        self._top = HEADER + (INSET[1] if isinstance(env.plant, Filmed) else 60)
        _labels(self._frame, self._top)
        self._frame.keep()
        rate = f"{scenario.rates.control}/{self._every}"
        raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{WIDTH}x{HEIGHT}", "-r", rate]
        packed = ["-c:v", "libx264", "-preset", "veryfast", "-crf", "23", "-pix_fmt", "yuv420p"]
        # Written in fragments of 2 s that play by themselves, joined at the end: what there is
        # can be played even if the encoder is killed.
        packed += ["-g", str(2 * FRAMES_PER_SECOND), "-movflags", "hybrid_fragmented"]
        self._process = subprocess.Popen(
            [self._encoder, "-y", "-v", "error", *raw, "-i", "-", *packed, self._written],
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
        row = trace.last()
        frame = self._frame
        frame.clear()
        frame.clock(row["t"])
        plant = env.plant
        if isinstance(plant, Filmed):
            viewer = plant.viewer()
            outlines = env.plant.bodies.outlines.values()
            for kind, size, place in (
                ("chase", VIEW, (0, HEADER)),
                ("top", INSET, (VIEW[0], HEADER)),
            ):
                camera = viewer.camera(kind, *size)
                seen, upright = viewer.look(camera)
                image = seen.copy()
                for outline, pose in zip(outlines, env.plant_state.poses, strict=True):
                    draw_shadow(image, camera, outline.at(pose))
                self._draw_wishes(image, camera, row)
                image.paste(seen, mask=upright)
                _draw_force(image, camera, row, plant.handle)
                frame.place(image, *place)
        else:
            camera = level_camera(*topview.window(env.world, env.plant_state, *VIEW), *VIEW)
            drawn = topview.draw(env.world, env.plant_state, env.plant.bodies, *VIEW, force=False)
            image = Image.fromarray(drawn)
            self._draw_wishes(image, camera, row)
            _draw_force(image, camera, row, (0.0, 0.0, 0.0))
            frame.place(image, 0, HEADER)
        _gauges(frame, self._top, row)
        return frame.pixels()

    def _draw_wishes(self, image: Image.Image, camera: Camera, row: dict[str, float]) -> None:
        pose = np.array([row["x"], row["y"], row["theta"]])
        for prefix, width, colour, opacity in BANDS:
            wish = np.array([row[f"{prefix}_v"], row[f"{prefix}_omega"]])
            arc = arc_points(pose, wish, self._horizon)
            draw_band(image, camera, arc, width, colour, opacity)

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
        try:
            os.replace(self._written, self.file)
        except OSError as error:
            raise SimulationError(f"{self._cannot}: {error.strerror}") from error

    def _failure(self, said: bytes | None = None) -> str:
        if said is None and self._process is not None:
            _, said = self._process.communicate()
        self._process = None
        reason = (said or b"").decode(errors="replace").strip().splitlines()
        with suppress(OSError):
            os.remove(self._written)
        return f"{self._cannot}: {reason[-1] if reason else 'no reason given'}"

    @property
    def _cannot(self) -> str:
        return f"the video {self.file} cannot be written"


def _draw_force(
    image: Image.Image, camera: Camera, row: dict[str, float], handle: tuple[float, float, float]
) -> None:
    """Draw the measured force above the handle (base axes, m)."""
    pose = (row["x"], row["y"], row["theta"])
    x, y, height = handle
    height += ARROW_ABOVE
    tip = (x + row["fx"] * METRES_PER_NEWTON, y + row["fy"] * METRES_PER_NEWTON, 0.0)
    ends = compose(pose, [(x, y, 0.0), tip])
    draw_arrow(image, *camera.project([(*end[:2], height) for end in ends]))


def _labels(frame: VideoFrame, top: float) -> None:
    """Write what stays the same from frame to frame."""
    frame.heading(top + 16, "the human's stubbornness")
    frame.key(top + 38, ((PALE, "true"), (HUMAN, "believed by the automation")))
    frame.label(top + 60, "forward")
    frame.label(top + 85, "turning")
    frame.heading(top + 122, "utility the automation demands")
    frame.label(top + 144, "target")
    frame.heading(top + 182, "force on the handle")
    frame.key(top + 236, ((FORCE, "force"), (HUMAN, "human's wish"), (AUTOMATION, "automation's")))


def _gauges(frame: VideoFrame, top: float, row: dict[str, float]) -> None:
    for line, dimension in enumerate(("v", "omega")):
        frame.gauge(
            top + 60 + 25 * line,
            row[f"est_stubbornness_{dimension}"],
            HUMAN,
            row[f"true_stubbornness_{dimension}"],
        )
    frame.gauge(top + 144, row["target_utility"], AUTOMATION)
    # Adding zero makes -0.0 a plain one.
    fx, fy = (round(row[name], 1) + 0.0 for name in ("fx", "fy"))
    frame.reading(top + 204, f"{fx:+.1f} N forward   {fy:+.1f} N left")


def _encoder() -> str:
    """Return the path of ffmpeg."""
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        found: str = get_ffmpeg_exe()
    except (ImportError, RuntimeError) as error:
        raise InputError(
            "a film needs a video encoder, which is not installed: pip install imageio-ffmpeg"
        ) from error
    return found
