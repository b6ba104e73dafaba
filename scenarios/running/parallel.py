"""Many runs at once, in processes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from joblib import Parallel, delayed

from .runner import Progress

T = TypeVar("T")


def each_of(
    function: Callable[..., T],
    tasks: Sequence[tuple[Any, ...]],
    progress: Progress | None = None,
    jobs: int = -1,
) -> list[T]:
    """Return what a function gives of each task, in their order.

    Parameters
    ----------
    function : callable
        Of a module, since it is sent to other processes.
    tasks : sequence of tuple
        Its arguments.
    progress : callable, optional
        Called with the tasks done and their total.
    jobs : int
        Processes at once; -1 is one a core.
    """
    outcomes = Parallel(n_jobs=jobs, return_as="generator")(
        delayed(function)(*task) for task in tasks
    )
    found: list[T] = []
    for outcome in outcomes:
        found.append(outcome)
        if progress is not None:
            progress(len(found), len(tasks))
    return found
