"""Lines of sight, in plain floats: it is asked for a few lines at a time.

A line is first judged on the floor plan; what it passes there hides only as far as it is lower.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple


class Screen(NamedTuple):
    """A rectangle that hides what is behind it.

    Attributes
    ----------
    number : int
        Which occluder it is.
    x, y : float
        Centre, m.
    cos, sin : float
        Of the direction of its length.
    half_length, half_width : float
        Half of its sides, m.
    height : float
        m.
    """

    number: int
    x: float
    y: float
    cos: float
    sin: float
    half_length: float
    half_width: float
    height: float


class Pillar(NamedTuple):
    """A disc that hides what is behind it.

    Attributes
    ----------
    number : int
        Which occluder it is.
    x, y, radius, height : float
        m.
    """

    number: int
    x: float
    y: float
    radius: float
    height: float


Point = tuple[float, float, float]


def below(eye: Point, point: Point, height: float) -> tuple[Point, Point] | None:
    """Return the part of a line that lies below a height, as two points of that height or less.

    Parameters
    ----------
    eye, point : (x, y, z)
        Ends of the line, m.
    height : float
        m.
    """
    low, high = (eye, point) if eye[2] <= point[2] else (point, eye)
    if low[2] >= height:
        return None
    if high[2] <= height:
        return low, high
    share = (height - low[2]) / (high[2] - low[2])
    dx, dy = high[0] - low[0], high[1] - low[1]
    return low, (low[0] + share * dx, low[1] + share * dy, height)


def behind_screen(
    eye: Point, point: Point, screens: Iterable[Screen], itself: int = -1
) -> Screen | None:
    """Return a rectangle that the line from an eye to a point passes through, if any.

    The separating axis test of a segment and a rectangle; a line along an edge does not count.

    Parameters
    ----------
    eye, point : (x, y, z)
        m.
    screens : iterable of Screen
    itself : int
        Number of the occluder that does not count.
    """
    middle_x, middle_y = (eye[0] + point[0]) / 2.0, (eye[1] + point[1]) / 2.0
    ray_x, ray_y = middle_x - eye[0], middle_y - eye[1]
    top = max(eye[2], point[2])
    for screen in screens:
        number, x, y, cos, sin, half_length, half_width, height = screen
        if number == itself:
            continue
        dx, dy = middle_x - x, middle_y - y
        along, ray_along = abs(cos * dx + sin * dy), cos * ray_x + sin * ray_y
        if along >= half_length + abs(ray_along):
            continue
        across, ray_across = abs(cos * dy - sin * dx), cos * ray_y - sin * ray_x
        if across >= half_width + abs(ray_across):
            continue
        turn = abs(dx * ray_y - dy * ray_x)
        if turn <= half_length * abs(ray_across) + half_width * abs(ray_along):
            if height >= top:
                return screen
            part = below(eye, point, height)
            if part is not None and behind_screen(*part, (screen,)) is not None:
                return screen
    return None


def behind_pillar(
    eye: Point, point: Point, pillars: Iterable[Pillar], itself: int = -1
) -> Pillar | None:
    """Return a disc that the line from an eye to a point passes through, if any.

    Parameters
    ----------
    eye, point : (x, y, z)
        m.
    pillars : iterable of Pillar
    itself : int
        Number of the occluder that does not count.
    """
    ray_x, ray_y = point[0] - eye[0], point[1] - eye[1]
    square = ray_x * ray_x + ray_y * ray_y
    top = max(eye[2], point[2])
    for pillar in pillars:
        number, x, y, radius, height = pillar
        if number == itself:
            continue
        dx, dy = x - eye[0], y - eye[1]
        share = dx * ray_x + dy * ray_y
        if share > 0.0 and square > 0.0:
            share = min(share / square, 1.0)
            dx, dy = dx - share * ray_x, dy - share * ray_y
        if dx * dx + dy * dy < radius * radius:
            if height >= top:
                return pillar
            part = below(eye, point, height)
            if part is not None and behind_pillar(*part, (pillar,)) is not None:
                return pillar
    return None
