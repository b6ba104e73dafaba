"""The watchers that write a file, by what is asked for."""

from __future__ import annotations

from pathlib import Path

from .watcher import Watcher


def watchers(video: Path | None = None, recording: Path | None = None) -> list[Watcher]:
    """Return the watchers that write what is asked for.

    Parameters
    ----------
    video : Path, optional
        ``.mp4``, see `cowalk.scenarios.watch.video.Video`.
    recording : Path, optional
        ``.rrd``, see `cowalk.scenarios.watch.rerun_log.RerunLog`.

    Raises
    ------
    InputError
        If a file cannot be written, or what writes it is not installed.
    """
    # Each brings libraries that take a while to import.
    found: list[Watcher] = []
    if video is not None:
        from .video import Video

        found.append(Video(video))
    if recording is not None:
        from .rerun_log import RerunLog

        found.append(RerunLog(recording))
    return found
