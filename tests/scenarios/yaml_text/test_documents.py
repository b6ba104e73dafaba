"""Whatever stands in a file, or in the place of one, is answered in one line, at once."""

import os
import subprocess
import sys
import time

import pytest
import yaml

from cowalk.scenarios import load, load_population
from cowalk.scenarios.files.loading import faults
from cowalk.scenarios.yaml_text import document, loader
from cowalk.scenarios.yaml_text.document import parse
from cowalk.sim.basics.errors import InputError

ODD = {
    "2024-13-45": "cannot be read as a date",
    "2024-01-01T25:00:00Z": "cannot be read as a date",
    "0x_": "cannot be read as a whole number",
    "0b_": "cannot be read as a whole number",
    "!!int foo": "cannot be read as a whole number",
    "!!int ''": "cannot be read as a whole number",
    "!!float x": "cannot be read as a number",
    "!!bool x": "cannot be read as true or false",
    "!!timestamp 1": "cannot be read as a date",
    "9" * 5000: "cannot be read as a whole number",
    '"\\UFFFFFFFF"': "",
    '"\\ud800"': "",
    '"\\e]0;title\\a"': "cannot be shown",
    '"\\u202egnp"': "cannot be shown",
    "18446744073709551616": "must lie below 2^63",
    "-9223372036854775809": "must lie below 2^63",
    "9" * 4000: "must lie below 2^63",
    "1e400": "a finite number is expected",
    "2024-01-01": "a date is not expected",
    "!!set {a}": "a set is not expected",
    "{null: 1}": "",
    "{2024-01-01: 1}": "",
    "{[1]: 2}": "",
    "{? {a: 1} : 2}": "",
    "&a [*a]": "contains itself",
    "&a {b: {c: *a}}": "contains itself",
    "*b": "alias",
    "{<<: 1}": "merging",
    "!<tag> x": "no tag that a scenario may hold",
}
KEYS = ("duration", "name", "plant", "  name")


@pytest.fixture(params=["CSafeLoader", "SafeLoader"])
def base(request, monkeypatch):
    """Both readers: libyaml's, and Python's own where that is not installed."""
    made = loader.reader(getattr(yaml, request.param))
    monkeypatch.setattr(loader, "Loader", made)
    monkeypatch.setattr(document, "Loader", made)


@pytest.mark.usefixtures("base")
@pytest.mark.parametrize("key", KEYS)
@pytest.mark.parametrize("value", ODD, ids=lambda value: value[:25])
def test_an_odd_value_is_a_fault_at_its_line(scenario_file, key, value):
    text = scenario_file().read_text()
    lines = text.splitlines()
    number = next(n for n, line in enumerate(lines) if line.startswith(f"{key}:"))
    lines[number] = f"{key}: {value}"
    file = scenario_file()
    file.write_text("\n".join(lines))
    found = faults(file)
    assert found[0].line == number + 1
    assert all("\n" not in fault.message and len(fault.message) < 400 for fault in found)
    if key == "duration":
        assert ODD[value] in found[0].message


@pytest.mark.parametrize("key", ["null", "2024-01-01", "1", "true", "1.5", "[1]", "? {a: 1}\n"])
def test_an_odd_key_is_a_fault(scenario_file, key):
    file = scenario_file(more=f"{key}: 1\n")
    assert faults(file)[0].line == 8


@pytest.mark.parametrize("number", [2**63, 2**64, 2**64 - 1, -(2**63) - 1, 10**400])
def test_a_population_holds_no_number_that_numpy_cannot(folder, number):
    file = folder / "large.population.yaml"
    for share in (f"{{distribution: norm, loc: 0, scale: {number}}}", number):
        human = f"{{name: slacking, parameters: {{share: {share}}}}}"
        file.write_text(f"name: large\ngroups:\n- human: {human}\n")
        with pytest.raises(InputError, match=r"large.population.yaml:3: .*must lie below 2\^63"):
            load_population(file)


def nested(opening, closing):
    return {
        f"{opening} {count} deep": f"x: {opening * count}1{closing * count}\n"
        for count in (51, 500, 100_000)
    }


def bomb(first, wrap):
    lines = [f"a0: &a0 {first}"]
    lines += [f"a{n}: &a{n} {wrap % ','.join([f'*a{n - 1}'] * 9)}" for n in range(1, 9)]
    return "\n".join(lines) + "\n"


BOMBS = {
    **nested("[", "]"),
    **nested("{a: ", "}"),
    "deep blocks": "".join(f"{' ' * n}a:\n" for n in range(600)),
    "nested aliases": bomb("[x]", "[%s]"),
    "nested merges": bomb("{x: 1}", "{<<: [%s]}"),
    "merges in keys": bomb("{x: 1}", "{y: [%s]}"),
    "1.4 MB of unknown keys": "".join(f"key{n}: {n}\n" for n in range(100_000)),
    "0.9 MB of unknown keys": "".join(f"key{n}: {n}\n" for n in range(65_000)),
    "as many keys as there may be": "".join(f"keys{n}: {n}\n" for n in range(4_900)),
    "2 MB of text": f"description: {'x' * 2_000_000}\n",
    "0.9 MB of anchors": "".join(f"- &a{n} x\n" for n in range(75_000)),
    "one long key": f"? {'x' * 900_000}\n: 1\n",
    "a long name": f"sensor: {'x' * 900_000}\n",
    "a long formula": f"expect: {{a: {'x' * 900_000}}}\n",
    "a deep formula": f"expect: {{a: {'(' * 400_000}}}\n",
    "a formula of many parts": f"expect: {{a: {' and '.join(['(x > 1)'] * 9_000)}}}\n",
    "open brackets": "[" * 900_000,
    "open quotes": "'" + "''" * 400_000,
    "remarks": "# x\n" * 240_000,
    "lines": "\n" * 990_000,
}
PROBE = """
import resource, sys, time
from pathlib import Path
from cowalk.scenarios.files.loading import faults
from cowalk.sim.basics.errors import InputError
faults(Path(sys.argv[1]))
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
for name in sys.argv[2:]:
    begun = time.process_time()
    try:
        said = [fault.message for fault in faults(Path(name))]
    except InputError as error:
        said = [str(error)]
    spent = time.process_time() - begun
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) // 1024
    print(f"{spent:.2f}", grown, len(said), max(map(len, said), default=0), sep="\\t")
"""


def test_no_document_takes_long_or_fills_the_memory(scenario_file, folder):
    names = []
    for number, text in enumerate(BOMBS.values()):
        (folder / f"{number}.yaml").write_text(text)
        names.append(f"{number}.yaml")
    done = subprocess.run(
        [sys.executable, "-c", PROBE, str(scenario_file()), *names],
        capture_output=True,
        text=True,
        check=True,
        cwd=folder,
        timeout=100,
    )
    for name, line in zip(BOMBS, done.stdout.splitlines(), strict=True):
        spent, grown, said, longest = line.split("\t")
        assert float(spent) < 2.0, (name, line)
        assert int(grown) < 100, (name, line)
        assert int(said) > 0, name
        assert int(longest) < 500, name


def test_aliases_count_as_often_as_they_are_written_out():
    row = "[" + ",".join("x" * 99) + "]"  # with the list itself 100
    assert not parse(f"a: &a {row}\nb: [{','.join(['*a'] * 98)}]").problems
    (problem,) = parse(f"a: &a {row}\nb: [{','.join(['*a'] * 99)}]").problems
    assert "more than 10,000 values" in problem.message


@pytest.mark.parametrize("place", ["file", "urdf", "recording", "population"])
@pytest.mark.parametrize("what", ["pipe", "folder", "device", "socket", "bytes", "gone", "null"])
def test_what_is_no_file_is_refused_without_waiting(scenario_file, folder, place, what):
    ending = {"urdf": ".urdf", "recording": ".csv"}.get(place, ".yaml")
    path = folder / f"odd{ending}"
    if what == "pipe":
        os.mkfifo(path)
    elif what == "folder":
        path.mkdir()
    elif what == "device":
        path.symlink_to("/dev/zero")
    elif what == "socket":
        import socket

        with socket.socket(socket.AF_UNIX) as opened:
            opened.bind(str(path))
    elif what == "bytes":
        path.write_bytes(b"name: \xff\xfe\x00")
    elif what == "null":
        path = folder / "odd\0.yaml"
    bullet = scenario_file(("plant: unicycle", "plant: bullet"))
    begun = time.monotonic()
    swap = "human=recorded"
    in_quotes = str(path).replace("\0", "\\0")
    reads = {
        "file": lambda: load(path),
        "population": lambda: load_population(path),
        "urdf": lambda: load(bullet, [f'plant.parameters.robot.urdf="{in_quotes}"']),
        "recording": lambda: load(bullet, [swap, f'human.parameters.file="{in_quotes}"']),
    }
    with pytest.raises(InputError) as refused:
        reads[place]()
    assert time.monotonic() - begun < 2.0
    assert "\n" not in str(refused.value)


def test_names_that_no_file_can_have_are_refused(cowalk):
    for name in ("x" * 5000, "x" * 5000 + ".yaml", "/" * 5000 + "x", "~nobody/x.yaml", ""):
        code, out, error = cowalk("run", name)
        assert (code, out) == (2, "")
        assert len(error.splitlines()) == 1
