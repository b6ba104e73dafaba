"""A window for plants that draw pictures but have no viewer of their own."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..basics.errors import InputError

_image: Any = None


def show(picture: np.ndarray) -> None:
    """Show a picture, uint8, shape (height, width, 3), in one window that is reused.

    Raises
    ------
    InputError
        If no window can be opened.
    """
    global _image
    from matplotlib import pyplot as plt

    if plt.get_backend().lower() == "agg":  # what matplotlib falls back to
        raise InputError(
            "no window can be opened: there is no display, or no toolkit that matplotlib can draw "
            "windows with; run without the window"
        )
    if _image is None or not plt.fignum_exists(_image.figure.number):
        figure = plt.figure("cowalk", figsize=(8, 6))
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set_axis_off()
        _image = axes.imshow(picture)
        plt.show(block=False)
    _image.set_data(picture)
    _image.figure.canvas.draw_idle()
    _image.figure.canvas.flush_events()
