"""Refresh what the documents quote: ``python docs/build.py`` reruns the commands they show."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from dataclasses import asdict
from pathlib import Path

from imageio_ffmpeg import get_ffmpeg_exe

from cowalk.sim.sensor.presets import PRESETS

DOCS = Path(__file__).parent
ROOT = DOCS.parent
COMMAND = Path(sys.executable).parent / "cowalk"


def output(*arguments: str) -> str:
    """Return what a command prints, where no terminal says how wide it is."""
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    done = subprocess.run(
        [COMMAND, *arguments],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return "\n".join(line.rstrip() for line in done.stdout.strip().splitlines())


def measured(subject: str) -> str:
    """Return a subject of the benchmarks as a table; only of those that do not time."""
    sys.path.insert(0, str(ROOT))
    from benchmarks.__main__ import SUBJECTS

    rows = [f"| {what} | {value:.2g} | {unit} |" for what, value, unit in SUBJECTS[subject]()]
    return "\n".join(("| measurement | value | unit |", "|---|---|---|", *rows))


def quote(file: Path, name: str, text: str) -> None:
    """Put text between the markers ``<!-- name -->`` and ``<!-- /name -->`` of a document."""
    pattern = re.compile(rf"(<!-- {name} -->\n).*?(\n<!-- /{name} -->)", re.DOTALL)
    before = file.read_text()
    if not pattern.search(before):
        raise SystemExit(f"{file}: no place marked {name}")
    file.write_text(pattern.sub(lambda found: found[1] + text + found[2], before))


def printed_by_run(folder: str) -> str:
    """Return what the README's run prints, with its folder as the README has it."""
    return output("run", "puddle", "--out", f"{folder}/puddle").replace(folder, "runs")


def fenced(text: str, language: str = "text") -> str:
    """Return text as a code block."""
    return f"```{language}\n{text}\n```"


def shipped(name: str) -> str:
    """Return a scenario file that ships."""
    return (ROOT / "scenarios" / "library" / f"{name}.scenario.yaml").read_text().rstrip()


def preset_table() -> str:
    """Return the sensor presets as a table, a column each."""
    columns = {name: asdict(parameters) for name, (_, parameters) in PRESETS.items()}
    lines = ["| key | " + " | ".join(columns) + " |", "|---" * (len(columns) + 1) + "|"]
    lines += [
        f"| `{key}` | " + " | ".join(str(column[key]) for column in columns.values()) + " |"
        for key in next(iter(columns.values()))
    ]
    return "\n".join(lines)


def main() -> None:
    """Rerun and quote everything."""
    images = DOCS / "images"
    with tempfile.TemporaryDirectory() as folder:
        quote(ROOT / "README.md", "run", fenced(printed_by_run(folder)))
        (images / "puddle.png").write_bytes(Path(folder, "puddle", "figure.png").read_bytes())
        film = f"{folder}/puddle.mp4"
        output("run", "puddle", "--out", f"{folder}/filmed", "--video", film)
        ffmpeg = [get_ffmpeg_exe(), "-v", "error", "-y", "-ss", "11.2", "-i", film]
        subprocess.run([*ffmpeg, "-frames:v", "1", images / "seeing.png"], check=True)
        output("paper", "--out", folder)
        output("humans", "show", "escalating", "--out", str(images / "escalating.png"))
        (images / "paper.png").write_bytes(Path(folder, "panels.png").read_bytes())
    output("humans", "table", "--write", str(DOCS / "humans.md"))
    output("mutants", "metrics", "--write", str(DOCS / "metrics.md"))
    output("mutants", "expectations", "--write", str(DOCS / "expectations.md"))
    quote(DOCS / "model.md", "paper", fenced(output("paper")))
    for file, name in (("scenarios.md", "puddle"), ("world.md", "doorway")):
        quote(DOCS / file, name, fenced(shipped(name), "yaml"))
    quote(DOCS / "sensor.md", "presets", preset_table())
    quote(DOCS / "plant.md", "contact-noise", measured("contact noise"))


if __name__ == "__main__":
    main()
