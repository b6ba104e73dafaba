"""Parameters that name a file, marked so that who reads them from a file knows."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any, get_args

_MARK = object()

FileName = Annotated[str, _MARK]
"""Text that names a file. In a scenario file, a relative one begins where that file lies."""


def names_file(hint: Any) -> bool:
    """Return whether a parameter with an annotation names a file: a `FileName`, or a path.

    Parameters
    ----------
    hint : annotation
        With what `typing.Annotated` adds.
    """
    if hint is os.PathLike or (isinstance(hint, type) and issubclass(hint, Path)):
        return True
    arms = get_args(hint)
    return any(arm is _MARK or names_file(arm) for arm in arms)
