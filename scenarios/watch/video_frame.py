"""One frame of a video: what the cameras see, with force and wishes in it, and gauges beside it."""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFilter, ImageFont

from cowalk.sim.basics.motion import Array
from cowalk.sim.view.camera import Camera

from ..figures.style import AGREED, MUTED

WIDTH, HEIGHT = 960, 544
"""Size of a frame in pixels: whole multiples of 16, as video encoders want them."""
HEADER = 64
VIEW = (640, HEIGHT - HEADER)
"""Size of the large picture."""
INSET = (WIDTH - VIEW[0], 208)
"""Size of the small one."""
FORCE = "#FFC20A"
"""Colour of the force: told from both sides' colours by hue and by brightness."""
METRES_PER_NEWTON = 0.1
"""Length of the force arrow."""
PAPER, LINE, PALE = "#FFFFFF", "#E4E4E4", "#F0BE9F"
SMOOTH = 4
"""Pixels a side that are averaged into one at the edges of arrows and bands."""
_FONTS = Path(matplotlib.get_data_path(), "fonts", "ttf")
_FACES: dict[tuple[int, bool], ImageFont.FreeTypeFont] = {}


def _face(size: int, bold: bool = False) -> ImageFont.FreeTypeFont:
    if (size, bold) not in _FACES:
        name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
        _FACES[size, bold] = ImageFont.truetype(str(_FONTS / name), size)
    return _FACES[size, bold]


def _fill(image: Image.Image, outline: Array, colour: str, opacity: float = 1.0) -> None:
    """Fill a polygon, pixels (n, 2), with smooth edges; one with unknown corners is left out."""
    if not np.isfinite(outline).all():
        return
    left, top = np.maximum(np.floor(outline.min(axis=0)).astype(int) - 1, 0)
    right, bottom = np.minimum(np.ceil(outline.max(axis=0)).astype(int) + 1, image.size)
    if right <= left or bottom <= top:
        return
    mask = Image.new("L", ((right - left) * SMOOTH, (bottom - top) * SMOOTH))
    corners = ((outline - (left, top)) * SMOOTH).ravel().tolist()
    ImageDraw.Draw(mask).polygon(corners, fill=round(255 * opacity))
    image.paste(colour, (int(left), int(top)), mask.reduce(SMOOTH))


def draw_arrow(image: Image.Image, tail: Array, tip: Array, colour: str = FORCE) -> None:
    """Draw an outlined, see-through arrow between two pixels; nothing if it is too short to see."""
    along = tip - tail
    length = float(np.hypot(*along))
    if not length > 4.0:
        return
    along = along / length
    side = np.array([-along[1], along[0]])
    head = min(16.0, 0.6 * length)

    def outline(grow: float) -> Array:
        shaft, wing, neck = 2.5 + grow, 7.0 + 1.4 * grow, length - head - grow
        ahead = np.array([-grow, neck, neck, length + 2.0 * grow, neck, neck, -grow])
        beside = np.array([shaft, shaft, wing, 0.0, -wing, -shaft, -shaft])
        return np.asarray(tail + ahead[:, None] * along + beside[:, None] * side)

    _fill(image, outline(1.5), AGREED, 0.6)
    _fill(image, outline(0.0), colour, 0.9)


def draw_band(
    image: Image.Image, camera: Camera, arc: Array, width: float, colour: str, opacity: float
) -> None:
    """Draw a band on the floor.

    Parameters
    ----------
    image : Image
    camera : Camera
        Which gave the image.
    arc : ndarray, shape (n, 3)
        World x, y (m) and heading (rad) of its middle line.
    width : float
        m.
    colour : str
    opacity : float
        In [0, 1].
    """
    across = np.stack((-np.sin(arc[:, 2]), np.cos(arc[:, 2])), axis=-1) * width / 2.0
    edges = np.concatenate((arc[:, :2] + across, (arc[:, :2] - across)[::-1]))
    floor = np.concatenate((edges, np.full((len(edges), 1), 0.01)), axis=-1)
    _fill(image, camera.project(floor), colour, opacity)


def draw_shadow(image: Image.Image, camera: Camera, outline: Array) -> None:
    """Darken the floor under a body: its outline, shape (n, 2), m, world axes."""
    corners = camera.project(np.concatenate((outline, np.zeros((len(outline), 1))), axis=-1))
    if not np.isfinite(corners).all():
        return
    low, high = corners.min(axis=0), corners.max(axis=0)
    soft = 0.12 * float((high - low).min())
    left, top = (np.floor(low) - 3.0 * soft).astype(int)
    right, bottom = (np.ceil(high) + 3.0 * soft).astype(int)
    if right <= 0 or bottom <= 0 or left >= image.width or top >= image.height:
        return
    mask = Image.new("L", (int(right - left), int(bottom - top)))
    ImageDraw.Draw(mask).polygon((corners - (left, top)).ravel().tolist(), fill=90)
    image.paste("#101418", (int(left), int(top)), mask.filter(ImageFilter.GaussianBlur(soft)))


class VideoFrame:
    """A frame being composed.

    Parameters
    ----------
    title, details : str
        First and second line of the header.
    """

    def __init__(self, title: str, details: str) -> None:
        self._blank = Image.new("RGB", (WIDTH, HEIGHT), PAPER)
        draw = ImageDraw.Draw(self._blank)
        draw.text((18, 10), title, AGREED, _face(21, bold=True))
        draw.text((18, 38), details, MUTED, _face(13))
        self._image = self._blank
        self._draw = draw  # labels come before `keep`, values after `clear`

    def keep(self) -> None:
        """Let every new frame begin with what was drawn so far: lettering is slow."""
        self._blank = self._image.copy()

    def clear(self) -> None:
        """Start a new frame."""
        self._image = self._blank.copy()
        self._draw = ImageDraw.Draw(self._image)

    def clock(self, time: float) -> None:
        """Show the time, s."""
        place = (WIDTH - 18, HEADER / 2.0)
        self._draw.text(place, f"{time:.2f} s", AGREED, _face(24, bold=True), anchor="rm")

    def place(self, picture: Image.Image, left: int, top: int) -> None:
        """Put a picture."""
        self._image.paste(picture, (left, top))

    def heading(self, top: float, text: str) -> None:
        """Write the heading of a group of gauges."""
        self._draw.text((VIEW[0] + 18, top), text, AGREED, _face(13, bold=True))

    def key(self, top: float, entries: tuple[tuple[str, str], ...]) -> None:
        """Explain colours, (colour, text) each, in one line."""
        left = VIEW[0] + 18.0
        for colour, text in entries:
            self._draw.rectangle((left, top + 3, left + 13, top + 12), colour)
            self._draw.text((left + 18, top), text, AGREED, _face(12))
            left += 18 + self._draw.textlength(text, _face(12)) + 14

    def label(self, top: float, name: str) -> None:
        """Write what a gauge shows."""
        self._draw.text((VIEW[0] + 18, top + 9), name, AGREED, _face(13), anchor="lm")

    def gauge(self, top: float, value: float, colour: str, truth: float = math.nan) -> None:
        """Show a value in [0, 1] as a bar, and the truth as a pale one around it."""
        left, right = VIEW[0] + 86, WIDTH - 62
        self._draw.rectangle((left, top, right, top + 18), "#F4F4F4")
        for share, inset, paint in ((truth, 0, PALE), (value, 4, colour)):
            if math.isfinite(share):
                end = left + (right - left) * min(max(share, 0.0), 1.0)
                self._draw.rectangle((left, top + inset, end, top + 18 - inset), paint)
        said = f"{value:.2f}" if math.isfinite(value) else "-"
        self._draw.text((WIDTH - 18, top + 9), said, AGREED, _face(13), anchor="rm")

    def reading(self, top: float, text: str) -> None:
        """Write a line."""
        self._draw.text((VIEW[0] + 18, top + 9), text, AGREED, _face(13), anchor="lm")

    def pixels(self) -> NDArray[np.uint8]:
        """Return the frame, uint8, shape (HEIGHT, WIDTH, 3)."""
        return np.asarray(self._image)
