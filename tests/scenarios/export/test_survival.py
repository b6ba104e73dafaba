"""Results that survive: nothing old is harmed, nothing new is lost, whatever ends the process."""

import json
import os
import resource
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from cowalk.scenarios import load, recover_run, run, write_run
from cowalk.scenarios.export import claim as claims
from cowalk.scenarios.export.claim import Claim
from cowalk.scenarios.export.run_folder import PIECES, RunFolder
from cowalk.scenarios.trace.stream import TraceStream, read_stream
from cowalk.scenarios.trace.trace import Trace
from cowalk.sim import InputError

SHORT = ["plant=unicycle", "duration=5"]


@pytest.fixture(scope="module")
def short():
    return run(load("puddle", SHORT))


def written(folder):
    """Return what lies in a folder: text or bytes by name."""
    return {path.name: path.read_bytes() for path in Path(folder).iterdir()}


def bits(trace):
    return trace.values.tobytes()


class Claimed(Exception):
    pass


def test_recording_while_it_runs_changes_no_bit_and_no_folder_means_no_file(
    tmp_path, monkeypatch, short
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("cowalk.scenarios.trace.stream.MOST", 7)
    assert bits(run(load("puddle", SHORT)).trace) == bits(short.trace)
    assert list(tmp_path.iterdir()) == []
    with RunFolder("kept") as place:
        result = run(load("puddle", SHORT), watchers=[place])
        assert (tmp_path / "kept/unfinished/trace.arrow").stat().st_size > 10_000
        place.keep(result)
    assert bits(result.trace) == bits(short.trace)
    assert bits(Trace.read(tmp_path / "kept/trace.parquet")) == bits(short.trace)
    assert sorted(written("kept")) == ["scenario.yaml", "summary.json", "trace.parquet"]


def test_a_stream_is_read_to_its_last_whole_batch_wherever_it_ends(tmp_path, short):
    file, rows = tmp_path / "trace.arrow", short.trace.values
    stream, sizes = TraceStream(file), []
    growing = Trace(short.trace.units)
    for row in rows:
        growing.append(dict(zip(growing.units, row, strict=True)))
        if len(growing) % 20 == 0:
            stream.write(growing)
            sizes.append(file.stat().st_size)
    whole = file.read_bytes()
    for end in [*range(sizes[0], len(whole), 997), *sizes, *(size - 1 for size in sizes[1:])]:
        file.write_bytes(whole[:end])
        batches = sum(size <= end for size in sizes)
        np.testing.assert_array_equal(read_stream(file).values, rows[: 20 * batches])
    for end in (0, 1, 100):
        file.write_bytes(whole[:end])
        with pytest.raises(InputError, match=r"trace\.arrow: no trace of a run"):
            read_stream(file)


def test_a_disk_that_is_full_for_a_while_costs_no_row(tmp_path, short, monkeypatch):
    file, rows = tmp_path / "trace.arrow", short.trace.values
    stream, growing = TraceStream(file), Trace(short.trace.units)
    usual = TraceStream._append

    def full(self, message):
        with self._file.open("ab") as out:  # half of it has come through
            out.write(message[: len(message) // 2])
        raise OSError(28, "No space left on device")

    for number, row in enumerate(rows):
        growing.append(dict(zip(growing.units, row, strict=True)))
        monkeypatch.setattr(TraceStream, "_append", full if 30 < number < 70 else usual)
        stream.write(growing)
    np.testing.assert_array_equal(read_stream(file).values, rows)


KILLED = """
import sys
from cowalk.scenarios.cli.main import main
from cowalk.scenarios.trace import stream
stream.EVERY = 0.1
main()
"""
ENDLESS = [
    *("--plant", "unicycle", "--human", "steady", "--set", "human.parameters.level=[0,0]"),
    *("--set", "duration=80000", "--set", "world.path.points=[[0,0],[90000,0]]"),
    *("--set", "expect={}", "--set", "world.corridor.width=100"),
]


def test_a_run_that_is_killed_is_recovered(tmp_path, cowalk, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_run(run(load("puddle", SHORT)), "kept", figure=False)
    before = written("kept")
    command = [sys.executable, "-c", KILLED, "run", "puddle", *ENDLESS, "--out", "kept"]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    stream = Path("kept/unfinished/trace.arrow")
    deadline = time.monotonic() + 60.0
    while not (stream.exists() and stream.stat().st_size > 300_000):
        assert time.monotonic() < deadline
        assert process.poll() is None
        time.sleep(0.02)
    code, _, said = cowalk("run", "puddle", "--out", "kept")
    assert (code, said.count("\n")) == (2, 1)
    assert "--out kept: another run is writing there" in said
    process.kill()
    process.wait()
    assert written_files("kept") == before
    code, out, _ = cowalk("recover", "kept", "--json")
    assert code == 0
    found = json.loads(out)
    assert found["end"] == "recovered"
    assert found["metrics"]["distance walked"]["value"] > 1.0
    trace = Trace.read(Path("kept/trace.parquet"))
    assert len(trace) > 300
    seconds = f"duration={len(trace) / 20:g}"
    again = [word for word in ENDLESS if "=" in word and not word.startswith("duration")]
    same = run(load("puddle", ["plant=unicycle", "human=steady", *again, seconds])).trace
    assert bits(trace) == bits(same)
    assert sorted(written("kept")) == ["scenario.yaml", "summary.json", "trace.parquet"]
    code, _, said = cowalk("recover", "kept")
    assert code == 2
    assert "has left anything there" in said


def written_files(folder):
    return {path.name: path.read_bytes() for path in Path(folder).iterdir() if path.is_file()}


def test_what_a_killed_run_has_left_outlives_the_next_one(tmp_path, short, monkeypatch):
    monkeypatch.chdir(tmp_path)
    leave(short, "kept")
    with RunFolder("kept") as place:
        assert place.left == Path("kept/unfinished-1")
        place.keep(short)
    result = recover_run("kept/unfinished-1")
    assert bits(result.trace) == bits(short.trace)
    assert sorted(written("kept/unfinished-1")) == [
        "scenario.yaml",
        "summary.json",
        "trace.parquet",
    ]


def leave(result, folder):
    """Leave what a run does that is killed: no part of it is closed."""
    place = RunFolder(folder)
    place.start(result.scenario, None)
    place.step(None, result.trace)
    place.close()
    place._claim.release()  # as the system does


class Killed(BaseException):
    """The process ends here."""


@pytest.mark.parametrize("failure", [Killed(), OSError(5, "Input/output error")])
def test_old_and_new_files_are_never_mixed(tmp_path, monkeypatch, short, failure):
    usual = Path.rename
    for ends_after in range(11):
        folder = tmp_path / f"{type(failure).__name__}-{ends_after}"
        folder.mkdir()
        for name in PIECES:
            (folder / name).write_text("old")
        (folder / "notes.txt").write_text("the user's")
        done = 0

        def rename(path, target, ends_after=ends_after):
            nonlocal done
            done += 1
            if done == ends_after + 1 or (done > ends_after and isinstance(failure, Killed)):
                raise failure
            return usual(path, target)

        with monkeypatch.context() as patch:
            patch.setattr(Path, "rename", rename)
            place = RunFolder(folder)
            with suppress(Killed, InputError):
                place.keep(short)
            place._claim.release()
        here = written_files(folder)
        assert here.pop("notes.txt") == b"the user's"
        assert len({text == b"old" for text in here.values()}) <= 1, here
        finished = done <= ends_after
        if isinstance(failure, OSError):
            assert (set(here) == set(PIECES)) is not finished
            continue
        with RunFolder(folder) as place:
            assert place.finished is not finished
        here = written(folder)
        assert set(here) == {"notes.txt", "trace.parquet", "summary.json", "scenario.yaml"}
        assert json.loads(here["summary.json"])["scenario"] == "puddle"
    assert finished


def test_files_of_the_users_stay_and_nothing_is_left_of_a_refusal(tmp_path, short, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("kept").mkdir()
    for name in (".write-test", "notes.txt"):
        Path("kept", name).write_text("mine")
    write_run(short, "kept", figure=False)
    assert Path("kept/.write-test").read_text() == Path("kept/notes.txt").read_text() == "mine"
    Path("taken/trace.parquet").mkdir(parents=True)
    Path("taken/summary.json").write_text("old")
    with pytest.raises(InputError, match=r"taken/trace\.parquet is a folder: a file is to be"):
        write_run(short, "taken")
    assert sorted(path.name for path in Path("taken").iterdir()) == [
        "summary.json",
        "trace.parquet",
    ]
    with RunFolder("new/below"):
        pass
    assert not Path("new").exists()
    Path("mine/unfinished").mkdir(parents=True)
    Path("mine/unfinished/notes.txt").write_text("mine")
    with pytest.raises(InputError, match="mine/unfinished is in the way"):
        write_run(short, "mine")
    assert Path("mine/unfinished/notes.txt").read_text() == "mine"


def test_one_run_at_a_time_writes_to_a_folder(tmp_path, short):
    with RunFolder(tmp_path / "kept") as place:
        with pytest.raises(InputError, match="another run is writing there"):
            write_run(short, tmp_path / "kept")
        place.keep(short)
    write_run(short, tmp_path / "kept", figure=False)


def test_a_picture_that_cannot_be_drawn_costs_nothing_else(
    tmp_path, short, cowalk, scenario_file, monkeypatch
):
    def fails(result, file):
        Path(file).write_text("half of it")
        raise MemoryError("no room for pixels")

    monkeypatch.setattr("cowalk.scenarios.figures.run.draw_run", fails)
    with pytest.warns(RuntimeWarning, match="no picture was drawn"):
        write_run(short, tmp_path / "kept")
    assert sorted(written(tmp_path / "kept")) == ["scenario.yaml", "summary.json", "trace.parquet"]
    code, _, said = cowalk("run", scenario_file(), "--out", "kept")
    assert code == 0
    why = "MemoryError: no room for pixels"
    assert said == f"cowalk: warning: no picture was drawn ({why}); all else is kept\n"


def cowalk_process(*arguments, **options):
    code = "from cowalk.scenarios.cli.main import main; main()"
    command = [sys.executable, "-c", code, *arguments]
    return subprocess.run(command, stderr=subprocess.PIPE, timeout=120, **options)


def test_a_file_that_may_not_grow_is_one_line_and_harms_nothing(tmp_path, short):
    write_run(short, tmp_path / "kept", figure=False)
    before = written(tmp_path / "kept")

    def limited():
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

    ended = cowalk_process(
        *("run", "puddle", "--set", "plant:=unicycle", "--out", "kept", "--no-figure"),
        cwd=tmp_path,
        preexec_fn=limited,
        stdout=subprocess.PIPE,
    )
    assert ended.returncode == 2
    assert ended.stderr.count(b"\n") == 1
    assert b"kept/trace.parquet: cannot be written (File too large)" in ended.stderr
    assert written_files(tmp_path / "kept") == before


def test_text_is_written_as_utf_8_whatever_the_locale(tmp_path):
    file = tmp_path / "w.scenario.yaml"
    text = "name: w\ndescription: größe ≥ 1\nduration: 1.0\nplant: unicycle\n"
    text += "world: {path: {points: [[0, 0], [30, 0]]}}\nhuman: steady\nautomation: never-yields\n"
    file.write_text(text, encoding="utf-8")
    plain = {"PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "LC_ALL": "C"}
    options = {"cwd": tmp_path, "env": os.environ | plain, "stdout": subprocess.PIPE}
    ended = cowalk_process("run", file.name, "--json", "--no-figure", **options)
    assert (ended.returncode, ended.stderr) == (0, b"")
    assert json.loads(ended.stdout)["end"] == "time"
    assert load(tmp_path / "runs/w/scenario.yaml").description == "größe ≥ 1"
    ended = cowalk_process("run", file.name, "--out", "größe", **options)
    assert (ended.returncode, ended.stderr) == (0, b"")
    assert len(Trace.read(tmp_path / "größe/trace.parquet")) == 20


def test_a_reader_that_has_gone_is_one_line_and_the_run_is_kept(tmp_path):
    reading, writing = os.pipe()
    os.close(reading)
    ended = cowalk_process(
        *("run", "puddle", "--set", "plant:=unicycle", "--no-figure", "--out", "kept"),
        cwd=tmp_path,
        stdout=writing,
    )
    os.close(writing)
    assert ended.returncode == 2
    assert ended.stderr == b"cowalk: standard output was closed: not all was printed\n"
    assert len(Trace.read(tmp_path / "kept/trace.parquet")) > 100


def test_a_folder_that_is_read_only_is_refused(tmp_path, short):
    if os.access("/proc", os.W_OK) and os.geteuid() == 0:
        target = Path("/proc/cowalk")  # nobody, not even root, makes a folder there
    else:
        target = tmp_path / "locked" / "kept"
        target.parent.mkdir(mode=0o500)
    with pytest.raises(InputError, match="cannot write there"):
        write_run(short, target)


def test_a_system_without_locks_on_folders_goes_on_without(tmp_path, short, monkeypatch):
    monkeypatch.setattr(claims, "fcntl", None)
    assert Claim(tmp_path / "kept", PIECES, "trace.arrow")._lock is None
