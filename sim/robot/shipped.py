"""The mobile base that ships, in numbers."""

from __future__ import annotations

BASE_RADIUS = 0.28
"""Radius of the disc that bounds the mobile base that ships, m."""

CAMERA_PLACE = (0.12, 0.0, 1.17)
"""Where the mobile base that ships sees from, base axes, m (inferred)."""
