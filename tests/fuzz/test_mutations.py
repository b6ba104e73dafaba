"""Mutations of what ships: whatever it is, the answer is one line, within 2 s and 500 MB.

``make fuzz`` tries 10,000; COWALK_FUZZ says how many, COWALK_FUZZ_FROM from which seed on. What
fails is printed with the line that repeats it.
"""

import io
import os
import random
import resource
import signal
import sys
import time
import traceback
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np
import pytest
import yaml

from cowalk.scenarios import load, load_population
from cowalk.scenarios.cli.main import main
from cowalk.scenarios.files.loading import faults
from cowalk.scenarios.people.loading import population_library
from cowalk.scenarios.running.trial import trial
from cowalk.sim.basics.errors import InputError

COUNT = int(os.environ.get("COWALK_FUZZ", "180"))
FIRST = int(os.environ.get("COWALK_FUZZ_FROM", "0"))
ROOT = Path(__file__).parents[2]
SCENARIOS = sorted((ROOT / "scenarios" / "library").glob("*.scenario.yaml"))
POPULATIONS = sorted(population_library().values())
LONGEST, LARGEST = 2.0, 500_000
"""CPU time in s, and memory in KiB, of one answer."""

WORDS = (
    "null 0 1 -1 0.5 1e308 -1e308 1e-300 .nan .inf -.inf 2024-13-45 0x_ 18446744073709551616 true "
    "off [] {} '' ' ' a [1,2] [[1]] {a: 1} !!int a !!python/name:os.system *a &a [*a] \"\\0\" "
    '"\\e[31m" "\\UFFFFFFFF" ${x} ../../etc/passwd /dev/zero ~nobody/x os:system steady '
    "puddle.urdf [0,0,0] [1e9,1e9] 1_0 1:30 <<: {{}} {name: steady} "
    "{distribution: norm} {name: 3} {parameters: [1]} [null] [.nan, .nan] 123456789012345"
)
VALUES = [None, True, False, 0, 1, -1, 2, 0.5, 1e308, -1e308, 1e-300, 5e-324, 2**64, 10**30]
VALUES += [float("nan"), float("inf"), "", "a", "steady", "bullet", "os:system", "x" * 300, "\0"]
VALUES += [[], {}, [1, 2], [0.0, 0.0], [[0.0, 0.0]], {"a": 1}, {"name": "steady"}, [None], 0.001]
PIECES = (
    "always eventually until unless historically once since next prev rise fall not and or "
    "implies iff xor abs sqrt exp pow rate min max s_next s_prev ( ) [0:1s] [1s:0s] [0:1e9s] "
    "[0,0.05] x v fy t clearance > < >= <= == != + - * / 1 0 -1 1e400 1e-9 , ; : . a b = import"
)


def scenario(rng, folder):
    text = _mutated(rng, rng.choice(SCENARIOS).read_text(), tree=True)
    file = folder / "mutated.scenario.yaml"
    file.write_bytes(text)
    if not faults(file) and b"seed" in text[: rng.randrange(200, 800)]:  # a part of them
        assert not trial(load(file))


def population(rng, folder):
    file = folder / "mutated.population.yaml"
    file.write_bytes(_mutated(rng, rng.choice(POPULATIONS).read_text(), tree=True))
    load_population(file).draw(2, 0, rng.choice(["unicycle", "bullet"]))


def command(rng, folder):
    name = rng.choice([file.name.partition(".")[0] for file in SCENARIOS])
    data = yaml.safe_load(next(f for f in SCENARIOS if f.name.startswith(name)).read_text())
    keys = [".".join(map(str, path)) for path, _ in _leaves(data)]
    keys += [
        "plant.parameters.robot",
        "sensor.rate",
        "automation.negotiation.horizon",
        "x",
        "",
        ".",
    ]
    odd = [str(value) for value in VALUES] + WORDS.split()
    options = []
    for _ in range(rng.randrange(1, 4)):
        kind = rng.randrange(3)
        if kind == 0:
            sign = rng.choice(["=", "=", ":=", ""])
            options += ["--set", f"{rng.choice(keys)}{sign}{rng.choice(odd)}"]
        elif kind == 1:
            flags = [
                "human",
                "automation",
                "smoother",
                "observer",
                "front-end",
                "plant",
                "sensor",
                "seed",
            ]
            options += [f"--{rng.choice(flags)}", rng.choice(odd)]
        else:
            options += [rng.choice(["--json", "--show", "--no-figure", "--samples", "--nothing"])]
    short = ["--set", "duration=0.1", "--no-figure", "--out", str(folder / "run")]
    _command(
        rng.choice(
            [
                ["run", name, *short, *options],
                ["run", name, "--show", *options],
                ["run", rng.choice(odd), *short, *options],
                ["check", rng.choice(odd), rng.choice(odd)],
                ["humans", "sample", rng.choice(["healthy-adults", *odd]), "-n", rng.choice(odd)],
                ["humans", "show", rng.choice(odd), *options, "--out", str(folder / "show.png")],
                ["list", rng.choice(odd)],
                ["new", rng.choice(["human", "scenario", *odd]), rng.choice(odd)],
                ["recover", rng.choice(odd)],
            ]
        )
    )


def formula(rng, folder):
    pieces = PIECES.split()
    text = " ".join(rng.choice(pieces) for _ in range(rng.randrange(1, 12)))
    if rng.random() < 0.6:
        text = _grown(rng, rng.randrange(1, 5))
    base = load("walk").model_copy(update={"expect": {}})
    from cowalk.scenarios.expect.verdict import syntax_error
    from cowalk.scenarios.running.trial import _unjudged
    from cowalk.scenarios.trace.columns import UNITS

    if syntax_error(text, UNITS, base.rates.period, base.duration) is None:
        judged = base.model_copy(update={"expect": {"it": text}})
        assert not _unjudged(judged, tuple(UNITS))


def robot(rng, folder):
    robots = sorted((ROOT / "sim" / "robot" / "models").glob("*.urdf"))
    text = rng.choice(robots).read_text()
    mesh = f"a{rng.choice(['.stl', '.obj', '.dae', '.STL', '.ply', ''])}"
    cube = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
    cube += "f 1 2 3\nf 2 3 4\nf 5 6 7\nf 6 7 8\nf 1 5 2\nmtllib ../../etc/passwd\n"
    (folder / mesh).write_bytes(_mutated(rng, cube))
    if rng.random() < 0.5:
        shape = (
            f'<mesh filename="{rng.choice([mesh, mesh, "/etc/passwd", "package://x", ".", ""])}"'
        )
        text = text.replace("<cylinder", shape + "/><cylinder", rng.randrange(3))
    odd = [str(value) for value in VALUES]
    parts = text.split('"')
    for _ in range(rng.randrange(3)):
        parts[rng.randrange(len(parts))] = rng.choice(odd)
    file = folder / "mutated.urdf"
    file.write_bytes(
        _mutated(rng, '"'.join(parts)) if rng.random() < 0.5 else '"'.join(parts).encode()
    )
    made = load("walk", [f"plant.parameters.robot.urdf={file}", "expect={}"])
    if rng.random() < 0.3:
        assert not trial(made)


def recording(rng, folder):
    ending = rng.choice([".csv", ".parquet", ".npy", ".npz"])
    file = folder / f"mutated{ending}"
    rows = np.column_stack((np.arange(100) * 0.01, np.zeros(100), np.ones(100)))
    if ending == ".csv":
        np.savetxt(file, rows, delimiter=",", header="t_s,fx_n,fy_n", comments="")
    elif ending == ".parquet":
        import pyarrow as pa
        from pyarrow import parquet

        names = ("t_s", "fx_n", "fy_n")
        table = pa.table({name: rows[:, i] for i, name in enumerate(names)})
        parquet.write_table(table, file)
    elif ending == ".npy":
        np.save(file, np.rec.fromarrays(rows.T, names="t_s,fx_n,fy_n"))
    else:
        np.savez(file, t_s=rows[:, 0], fx_n=rows[:, 1], fy_n=rows[:, 2])
    data = bytearray(file.read_bytes())
    for _ in range(rng.randrange(1, 6)):
        data[rng.randrange(len(data))] = rng.randrange(256)
    file.write_bytes(data[: rng.choice([len(data), rng.randrange(len(data))])])
    swap = ["human=recorded", f"human.parameters.file={file}", "plant=unicycle", "expect={}"]
    assert not trial(load("walk", swap))


KINDS = (scenario, population, command, formula, robot, recording)


def _mutated(rng, text, *, tree=False):
    """Return a text with something else in places: bytes, lines or, of a tree, values."""
    if tree and rng.random() < 0.45:
        data = yaml.safe_load(text)
        if isinstance(data, dict):
            for _ in range(rng.randrange(1, 3)):
                path, _ = rng.choice(_leaves(data))
                place = data
                for step in path[:-1]:
                    place = place[step]
                if rng.random() < 0.8:
                    place[path[-1]] = rng.choice(VALUES)
                else:
                    del place[path[-1]]
            return yaml.safe_dump(data, allow_unicode=True).encode("utf-8", "replace")
    lines = text.split("\n")
    for _ in range(rng.randrange(1, 4)):
        at = rng.randrange(len(lines))
        how = rng.randrange(6)
        if how == 0:
            lines[at] = ""
        elif how == 1:
            lines.insert(at, rng.choice(lines))
        elif how == 2:
            lines[at] = " " * rng.randrange(4) + lines[at].strip()
        elif how == 3:
            key, colon, _ = lines[at].partition(":")
            lines[at] = f"{key}{colon} {rng.choice(WORDS.split())}"
        elif how == 4 and lines[at]:
            place = rng.randrange(len(lines[at]))
            sign = rng.choice("\t:{}[]'\"#&*!%@,-.0e\x00\u202e\xe9\x85")
            lines[at] = lines[at][:place] + sign + lines[at][place + rng.randrange(3) :]
        else:
            other = rng.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
    data = bytearray("\n".join(lines).encode())
    if rng.random() < 0.1 and data:
        data[rng.randrange(len(data))] = rng.randrange(256)
    return bytes(data)


def _leaves(value, path=()):
    """Return place and value of all that a document holds."""
    found = [(path, value)] if path else []
    if isinstance(value, dict | list):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            found += _leaves(item, (*path, key))
    return found


def _grown(rng, depth, number=False):
    """Return a formula of a shape that rtamt has."""
    if number:
        if depth <= 0:
            return rng.choice(["x", "v", "fy", "1", "0.5", "clearance", "t"])
        one, two = _grown(rng, depth - 1, True), _grown(rng, depth - 1, True)
        shapes = [
            "abs({0})",
            "sqrt({0})",
            "exp({0})",
            "rate({0})",
            "pow({0}, {1})",
            "min({0}, {1})",
        ]
        return rng.choice(
            [*shapes, "({0} + {1})", "({0} - {1})", "({0} * {1})", "({0} / {1})"]
        ).format(one, two)
    if depth <= 0:
        one, two = _grown(rng, 1, True), _grown(rng, 1, True)
        return f"({one} {rng.choice(['>', '<', '>=', '<=', '==', '!='])} {two})"
    one, two = _grown(rng, depth - 1), _grown(rng, depth - 1)
    bound = rng.choice(["", "", "[0:1s]", "[0.5s:2s]", "[0:0]", "[100:200ms]"])
    unary = [
        "always",
        "eventually",
        "historically",
        "once",
        "next",
        "prev",
        "s_next",
        "s_prev",
        "rise",
        "fall",
        "not",
    ]
    binary = ["until", "unless", "since", "and", "or", "implies", "iff", "xor"]
    if rng.random() < 0.5:
        return f"{rng.choice(unary)}{bound} ({one})"
    return f"({one} {rng.choice(binary)}{bound} {two})"


def _command(arguments):
    """Run a command; it ends with 0, 1 or 2 and complains in one line at most."""
    sys.argv = ["cowalk", *arguments]
    said = io.StringIO()
    with redirect_stdout(io.StringIO()), redirect_stderr(said):
        try:
            main()
        except SystemExit as end:
            code = end.code
    assert code in (0, 1, 2), (arguments, code, said.getvalue()[-2000:])
    assert "Traceback" not in said.getvalue(), arguments


def _too_long(number, frame):
    raise TimeoutError("no answer within 60 s")


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_every_mutation_is_answered(kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["cowalk"])
    signal.signal(signal.SIGALRM, _too_long)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    wrong = []
    for seed in range(FIRST, FIRST + -(-COUNT // len(KINDS))):
        begun = time.process_time()
        signal.alarm(60)
        try:
            kind(random.Random(f"{kind.__name__} {seed}"), tmp_path)
            why = ""
        except InputError as error:
            why = f"more than one line: {error}" if "\n" in str(error) else ""
        except BaseException as error:
            last = traceback.extract_tb(error.__traceback__)[-1]
            why = f"{type(error).__name__}: {error} ({last.filename}:{last.lineno})"
        finally:
            signal.alarm(0)
        spent = time.process_time() - begun
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        if spent > LONGEST and seed > FIRST:  # the first one imports everything
            why = why or f"took {spent:.1f} s"
        if grown > LARGEST:
            why, before = why or f"took {grown // 1024} MB", before + grown
        if why:
            again = f"COWALK_FUZZ=1 COWALK_FUZZ_FROM={seed} pytest tests/fuzz/test_mutations.py"
            again += f" -k {kind.__name__}"
            wrong.append(f"{again}\n    {why[:1500]}")
    assert not wrong, "\n".join([f"{len(wrong)} of them:", *wrong[:40]])
