"""Mesh files: read once, judged, and handed on to who draws as a copy that holds nothing else.

A mesh may come from anybody. The engine's own readers end the process where an index points
nowhere, and follow names of further files; it is given only what was read here.
"""

from __future__ import annotations

from functools import lru_cache
from io import BytesIO
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from ..basics.file_names import read_file
from ..basics.motion import Array

READ = (".obj", ".stl", ".dae", ".ply", ".off", ".glb")
"""Endings of files that hold all of a mesh by themselves."""
MOST_BYTES = 200_000_000
"""Of a file (inferred): published robots have up to some ten million."""
FARTHEST = 1e6
"""From its origin to a corner (inferred): a robot of 5 m, drawn in hundredths of a millimetre."""

Mesh = tuple[Array, NDArray[np.int64]]
"""Vertices, shape (n, 3), m, and triangles, shape (m, 3)."""


def read_mesh(name: str) -> Mesh:
    """Return the vertices of a mesh file, shape (n, 3), m, and its triangles, shape (m, 3).

    A file that states its unit, as COLLADA does, is read in it; others are in m. Which way is
    up in COLLADA is not followed, as robots are published. No other file is read, whatever it
    names.

    Raises
    ------
    ValueError
        If it cannot be read, or has no triangles, or corners that are not finite or not there.
    """
    suffix = Path(name).suffix.lower()
    if suffix not in READ:
        raise ValueError(f"mesh {name!r}: must be one of {', '.join(READ)}")
    try:
        found = Path(name).stat()
        return _read(name, found.st_mtime_ns, found.st_size)
    except OSError as error:
        raise ValueError(f"mesh {name!r} cannot be read: {error.strerror}") from error


@lru_cache(maxsize=256)
def _read(name: str, changed: int, size: int) -> Mesh:
    # Slow to import, and needed for meshes alone.
    import trimesh

    try:
        # Read by us: no reader then opens another file that this one names, or waits for a pipe.
        data = BytesIO(read_file(Path(name), MOST_BYTES))
        with np.errstate(all="ignore"):
            mesh = trimesh.load_mesh(data, file_type=Path(name).suffix.lower().removeprefix("."))
        if mesh.units is not None:
            mesh.convert_units("meters")
        vertices, faces = np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces)
    except ImportError as error:
        if error.name == "charset_normalizer":  # to guess what text is not UTF-8 may be
            what = f"mesh {name!r} cannot be read: neither binary of its kind nor text in UTF-8"
            raise ValueError(what) from error
        raise ValueError(f"mesh {name!r}: {error}; or give it as STL or OBJ") from error
    except Exception as error:  # readers of a dozen formats raise what they like
        raise ValueError(
            f"mesh {name!r} cannot be read: {type(error).__name__}: {error}"
        ) from error
    right = vertices.ndim == faces.ndim == 2 and vertices.shape[1:] == faces.shape[1:] == (3,)
    if not (right and len(faces) and np.isfinite(vertices).all()):
        raise ValueError(f"mesh {name!r}: must have triangles with finite corners")
    if np.abs(vertices).max() > FARTHEST:
        raise ValueError(f"mesh {name!r}: has corners beyond {FARTHEST:g}, in whatever unit")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise ValueError(f"mesh {name!r}: has triangles with corners that are not there")
    for array in (vertices, faces):
        array.flags.writeable = False  # others get them as well
    return vertices, faces


def copy_meshes(urdf: str, folder: str) -> str:
    """Return a robot whose mesh files are copies in a folder: triangles and nothing else.

    Parameters
    ----------
    urdf : str
        Of a robot whose meshes `read_mesh` took, by absolute paths.
    folder : str
    """
    root = ElementTree.fromstring(urdf)
    copies: dict[str, str] = {}
    for mesh in root.iter("mesh"):
        name = mesh.get("filename", "")
        if name not in copies:
            copies[name] = str(Path(folder, f"mesh_{len(copies)}.stl"))
            _write(Path(copies[name]), *read_mesh(name))
        mesh.set("filename", copies[name])
    return ElementTree.tostring(root, encoding="unicode")


def _write(file: Path, vertices: Array, faces: NDArray[np.int64]) -> None:
    """Write binary STL."""
    corners = vertices[faces].astype("<f4")
    facet = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facets = np.zeros(len(faces), dtype=facet)
    facets["corners"] = corners
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    facets["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0.0)
    file.write_bytes(bytes(80) + np.uint32(len(faces)).tobytes() + facets.tobytes())
