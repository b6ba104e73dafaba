"""Plain shapes as Rerun shows them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from cowalk.sim.view.shapes import Shape


def archetypes(rr: Any, shapes: Iterable[Shape]) -> Iterator[tuple[str, Any]]:
    """Yield an entity path and what to log there, one for each part and kind of shape.

    Parameters
    ----------
    rr : module
        ``rerun``, which is optional and therefore handed in.
    shapes : iterable of Shape
        Meshes without a file are left out.
    """
    groups: dict[tuple[str, str], list[Shape]] = {}
    for shape in shapes:
        groups.setdefault((shape.part, shape.kind), []).append(shape)
    for (part, kind), same in groups.items():
        if kind == "mesh":
            for number, shape in enumerate(shape for shape in same if shape.file):
                yield f"{part}/mesh-{number}", rr.Asset3D(path=shape.file)
        else:
            yield f"{part}/{kind}", _batch(rr, kind, same)


def _batch(rr: Any, kind: str, shapes: list[Shape]) -> Any:
    sizes = np.array([shape.size for shape in shapes])
    middles = np.array([shape.place[0] for shape in shapes])
    look: dict[str, Any] = {
        "colors": [[round(255 * share) for share in shape.colour] for shape in shapes],
        "quaternions": [rr.Quaternion(xyzw=shape.place[1]) for shape in shapes],
        "fill_mode": "solid",
    }
    if kind == "capsule":
        # Rerun's capsules start at their place, ours have it in the middle.
        x, y, z, w = np.array([shape.place[1] for shape in shapes]).T
        axis = (2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y))
        starts = middles - np.stack(axis, axis=-1) * sizes[:, :1] / 2.0
        return rr.Capsules3D(lengths=sizes[:, 0], radii=sizes[:, 1], translations=starts, **look)
    look["centers"] = middles
    if kind == "cylinder":
        return rr.Cylinders3D(lengths=sizes[:, 0], radii=sizes[:, 1], **look)
    if kind == "sphere":
        return rr.Ellipsoids3D(radii=sizes[:, 0], **look)
    return rr.Boxes3D(sizes=sizes, **look)
