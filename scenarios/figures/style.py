"""The colours and the style that every figure shares, and what keeps text clear of data."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

import matplotlib.style
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patheffects import AbstractPathEffect, withStroke
from matplotlib.transforms import ScaledTranslation

# After Okabe and Ito: hues told apart with any colour vision; dashes and widths help in print.
HUMAN, HUMAN_DARK = "#D55E00", "#7A3300"
HUMAN_FORWARD, HUMAN_FORWARD_DARK = "#E69F00", "#8A6100"
AUTOMATION = "#0072B2"
AGREED = "#1A1A1A"
REPORTED = "#00795A"
MUTED = "#8C8C8C"
FAULT = "#8B0A3D"

STYLE: dict[str, Any] = {
    "font.size": 8.5,
    "axes.titlesize": 9.0,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#E4E4E4",
    "grid.linewidth": 0.6,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "legend.handlelength": 1.7,
    "legend.columnspacing": 1.1,
    "legend.borderaxespad": 0.0,
    "legend.borderpad": 0.2,
    "lines.linewidth": 1.3,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
}


@contextmanager
def house_style() -> Iterator[None]:
    """Draw and save within: our style on matplotlib's defaults, whatever the user has set."""
    with matplotlib.style.context(["default", STYLE]):
        yield


def new_figure(width: float, height: float, dpi: int) -> Figure:
    """Return an empty figure, size in inches, that needs neither pyplot nor a display."""
    figure = Figure(figsize=(width, height), dpi=dpi, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def save(figure: Figure, file: Path | BinaryIO) -> None:
    """Write a PNG whose bytes depend on the picture alone."""
    with house_style(), warnings.catch_warnings():
        # A name in a script that the font lacks shows as boxes; the picture is still worth it.
        warnings.filterwarnings("ignore", message="Glyph")
        if engine := figure.get_layout_engine():
            # savefig would draw everything once more for the layout alone.
            engine.execute(figure)
            figure.set_layout_engine("none")
        figure.savefig(file, metadata={"Software": None})


def label_unit(axis: Axes, text: str) -> None:
    """Label the vertical axis at one place in all panels, however wide the tick labels are."""
    axis.set_ylabel(text)
    left = ScaledTranslation(-0.53, 0.0, axis.figure.dpi_scale_trans)
    axis.yaxis.set_label_coords(0.0, 0.5, axis.transAxes + left)


def halo() -> list[AbstractPathEffect]:
    """Return the white outline that keeps text readable across curves."""
    return [withStroke(linewidth=2.5, foreground="white")]


def legend_above(axis: Axes) -> None:
    """Put the legend on the title's line, right-aligned, where it can never hide data."""
    if number := len(axis.get_legend_handles_labels()[1]):
        legend = axis.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=number)
        # The title keeps the line free; in the layout, an overlong legend would narrow every panel.
        legend.set_in_layout(False)
