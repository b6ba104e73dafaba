"""Files as loggers write them: what they leave out, put in, and name in their own way."""

import re
from datetime import datetime, timedelta, timezone

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

from cowalk.agents.humans.recorded.human import RecordedHuman
from cowalk.agents.humans.recorded.recording import Columns, read_recording
from cowalk.agents.humans.recorded.sensor import RecordingSensor
from cowalk.agents.humans.recorded.units import Units
from cowalk.sim.basics.errors import InputError

BY_NUMBER = Columns(time="0", fx="1", fy="2")
STEPS = np.arange(40) * 0.01
PUSH = np.column_stack((np.cos(STEPS), 2.0 + STEPS))


def written(tmp_path, lines, name="r.csv", end="\n"):
    file = tmp_path / name
    file.write_bytes((end.join(lines) + end).encode())
    return str(file)


def rows(time=STEPS, force=PUSH):
    return [f"{t},{x},{y}" for t, (x, y) in zip(time, force, strict=True)]


def read(file, columns=Columns(), units=Units(), **arguments):  # noqa: B008
    return read_recording(file, columns, units, **arguments)


def same(found, time=STEPS, force=PUSH):
    np.testing.assert_allclose(found[0], np.asarray(time) - time[0], atol=1e-9)
    np.testing.assert_allclose(found[1], force, atol=1e-12)


HEADER = "t_s,fx_n,fy_n"


@pytest.mark.parametrize("name", ["RUN.CSV", "Run.Csv"])
def test_endings_in_capitals_are_read_and_rows_are_lines_there_too(tmp_path, name):
    same(read(written(tmp_path, [HEADER, *rows()], name)))
    faulty = [HEADER, *rows()[:3], "0.03,,1", *rows()[4:]]
    with pytest.raises(InputError, match="no finite number in row 5 "):
        read(written(tmp_path, faulty, name))


def test_other_endings_in_capitals_are_read(tmp_path):
    table = np.column_stack((STEPS, PUSH))
    np.save(tmp_path / "r.npy", table)
    (tmp_path / "r.npy").rename(tmp_path / "R.NPY")
    same(read(str(tmp_path / "R.NPY"), BY_NUMBER))
    named = dict(zip(HEADER.split(","), table.T, strict=True))
    parquet.write_table(pa.table(named), tmp_path / "R.Parquet")
    same(read(str(tmp_path / "R.Parquet")))


@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_a_file_without_a_header_has_its_columns_by_number(tmp_path, mark):
    lines = rows()
    same(read(written(tmp_path, [mark + lines[0], *lines[1:]]), BY_NUMBER))
    with pytest.raises(InputError, match=r"it names no columns, say columns: \{time: \"0\", fx"):
        read(written(tmp_path, lines))
    with pytest.raises(InputError, match="column '2' does not hold numbers: '-' in row 2 "):
        read(written(tmp_path, [lines[0], "0.01,1,-", *lines[2:]]), BY_NUMBER)


def test_a_date_in_the_first_line_is_no_header(tmp_path):
    lines = [f"2024-03-01T12:00:00.{n:02}0,{x},{y}" for n, (x, y) in enumerate(PUSH)]
    same(read(written(tmp_path, lines), BY_NUMBER))


@pytest.mark.parametrize(
    "before",
    [
        ["# a remark", "#", HEADER],
        ["# a remark, with a comma", f"# {HEADER}"],
        ["t_s , fx_n,\tfy_n"],
        [f"\ufeff{HEADER}"],
        ["", "", HEADER, ""],
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_remarks_blanks_and_marks_before_the_rows_are_no_names(tmp_path, before, end):
    same(read(written(tmp_path, [*before, *rows()], end=end)))
    faulty = [*before, *rows()[:7], "", "0.07,off,1", *rows()[8:]]
    with pytest.raises(InputError, match=f"'off' in row {len(before) + 9} "):
        read(written(tmp_path, faulty, end=end))


@pytest.mark.parametrize("word", ["OVERLOAD", "-", "fy_n", "1.2.3", "0x1F", "1_0", "1 N", "true!"])
@pytest.mark.parametrize("long", [False, True])
def test_a_word_in_a_cell_is_named_with_its_row(tmp_path, word, long):
    count = 60_000 if long else 300  # more than Arrow guesses types from
    lines = [f"{n * 0.002:.3f},{n % 7 / 7:.12f},{n % 5 / 5:.12f}" for n in range(count)]
    lines[count - 100] = f"{(count - 100) * 0.002:.3f},1.0,{word}"
    file = written(tmp_path, [HEADER, *lines])
    message = f"column 'fy_n' does not hold numbers: {word!r} in row {count - 98} (1 such rows)"
    with pytest.raises(InputError, match=re.escape(message)) as refused:
        read(file)
    assert "\n" not in str(refused.value)


def test_whole_numbers_may_turn_into_fractions_late_in_a_long_file(tmp_path):
    count = 120_000
    lines = [f"{n / 500!r},0,0" for n in range(count - 1)] + [f"{(count - 1) / 500!r},0.5,0.25"]
    force = read(written(tmp_path, [HEADER, *lines]))[1]
    np.testing.assert_array_equal(force[-2:], [[0.0, 0.0], [0.5, 0.25]])


def test_a_rate_stands_for_a_column_of_time(tmp_path):
    file = written(tmp_path, ["Fx,Fy", *(f"{x},{y}" for x, y in PUSH)])
    columns = Columns(fx="Fx", fy="Fy")
    same(read(file, columns, rate=120.0), np.arange(len(PUSH)) / 120.0)
    with pytest.raises(InputError, match=r"no column 't_s'; .*; if none holds the time, say rate"):
        read(file, columns)
    with pytest.raises(InputError, match="no column 'clock'"):
        read(file, Columns(time="clock", fx="Fx", fy="Fy"), rate=120.0)
    assert RecordedHuman(file=file, columns=columns, rate=120.0).rate == 120.0


@pytest.mark.parametrize("rate", [100.0, 100.5])
def test_a_rate_beside_a_column_of_time_must_agree(tmp_path, rate):
    file = written(tmp_path, [HEADER, *rows()])
    same(read(file, rate=rate))
    for other in (50.0, 120.0, 103.0):
        message = f"^rate = {other:g} Hz: column 't_s' of .* says 100 Hz; leave one of them out"
        with pytest.raises(InputError, match=message) as refused:
            read(file, rate=other)
        assert refused.value.at == ("rate",)


def test_stamps_rounded_to_milliseconds_agree_with_their_rate(tmp_path):
    count = 240
    lines = [f"{round(n * 1000 / 120)},1,2" for n in range(count)]
    time, _ = read(written(tmp_path, ["t_ms,fx_n,fy_n", *lines]), Columns(time="t_ms"), rate=120.0)
    assert time[-1] == pytest.approx((count - 1) / 120, abs=1e-3)


DATES = {
    "T": lambda moment: moment.isoformat(timespec="milliseconds"),
    "space": lambda moment: moment.isoformat(" ", timespec="microseconds"),
    "comma": lambda moment: f'"{moment.isoformat(timespec="milliseconds").replace(".", ",")}"',
    "Z": lambda moment: moment.isoformat(timespec="milliseconds") + "Z",
    "zone": lambda moment: moment.replace(tzinfo=timezone(timedelta(hours=1))).isoformat(
        timespec="milliseconds"
    ),
    "clock": lambda moment: moment.time().isoformat(timespec="milliseconds"),
}


@pytest.mark.parametrize("form", DATES)
def test_time_may_be_given_as_dates(tmp_path, form):
    start = datetime(2024, 2, 29, 23, 59, 59, 500_000 - 400_000 * (form == "clock"))
    moments = [DATES[form](start + timedelta(seconds=t)) for t in STEPS]
    lines = [f"{moment},{x},{y}" for moment, (x, y) in zip(moments, PUSH, strict=True)]
    same(read(written(tmp_path, ["stamp,fx_n,fy_n", *lines]), Columns(time="stamp")))
    lines[4] = "noon,1,2"
    with pytest.raises(InputError, match=r"column 'stamp' .*'noon' in row 6 "):
        read(written(tmp_path, ["stamp,fx_n,fy_n", *lines]), Columns(time="stamp"))


def test_dates_in_parquet_and_numpy_are_read_whatever_the_columns_unit(tmp_path):
    stamps = np.datetime64("2024-03-01T12:00:00") + (STEPS * 1e6).astype("timedelta64[us]")
    table = {"t [ms]": stamps, "fx_n": PUSH[:, 0], "fy_n": PUSH[:, 1]}
    parquet.write_table(pa.table(table), tmp_path / "r.parquet")
    same(read(str(tmp_path / "r.parquet"), Columns(time="t [ms]")))
    np.savez(tmp_path / "r.npz", **table)
    same(read(str(tmp_path / "r.npz"), Columns(time="t [ms]")))
    np.savez(tmp_path / "r.npz", **table | {"t [ms]": stamps - stamps[0]})
    same(read(str(tmp_path / "r.npz"), Columns(time="t [ms]")))
    np.savez(tmp_path / "r.npz", t_s=STEPS, fx_n=stamps, fy_n=STEPS)
    with pytest.raises(InputError, match="'fx_n' does not hold numbers, but dates"):
        read(str(tmp_path / "r.npz"))


def test_rows_without_any_force_are_those_of_other_signals(tmp_path):
    lines = []
    for row in rows():
        lines += [f"{row},", f"{float(row.partition(',')[0]) + 0.003:g},,,7.5"]
    same(read(written(tmp_path, [f"{HEADER},yaw", *lines])))
    lines[10] = "0.05,,2.0,"  # half a force
    with pytest.raises(InputError, match="'fx_n' has no finite number in row 12 "):
        read(written(tmp_path, [f"{HEADER},yaw", *lines]))
    lines[10:20] = [f"{0.05 + n / 1000:g},,,1" for n in range(10)]
    with pytest.raises(InputError, match=r"nothing for 0.06 s from 0.04 s on \(row 10, "):
        read(written(tmp_path, [f"{HEADER},yaw", *lines]))
    with pytest.raises(InputError, match="holds 0 rows; at least 2"):
        read(written(tmp_path, [HEADER, *(f"{t},," for t in STEPS)]))


def test_rows_of_one_topic_are_chosen_by_what_stands_in_them(tmp_path):
    lines = []
    for row in rows():
        lines += [f"/wrench,{row}", f"/velocity,{row.partition(',')[0]},9,9"]
    file = written(tmp_path, [f"topic,{HEADER}", *lines])
    same(read(file, rows={"topic": "/wrench"}))
    with pytest.raises(InputError, match="'t_s' does not rise in row 3"):
        read(file)
    with pytest.raises(InputError, match="'topic' holds no '/wrensh'; did you mean '/wrench'"):
        read(file, rows={"topic": "/wrensh"})
    with pytest.raises(InputError, match="no column 'tropic'; did you mean 'topic'"):
        read(file, rows={"tropic": "/wrench"})
    without = written(tmp_path, ["id,fx_n,fy_n", *(f"{n % 2},{n},{n}" for n in range(20))])
    same(
        read(without, rows={"id": "1"}, rate=50.0),
        np.arange(10) / 50.0,
        np.repeat(np.arange(1.0, 20.0, 2.0)[:, None], 2, axis=1),
    )


THREE = np.column_stack((PUSH, -1.0 - STEPS))


def three(tmp_path):
    lines = [f"{t},{x},{y},{z}" for t, (x, y, z) in zip(STEPS, THREE, strict=True)]
    return written(tmp_path, [f"{HEADER},fz_n", *lines])


@pytest.mark.parametrize(
    ("sensor", "expected"),
    [
        ({}, PUSH),
        ({"signs": (-1, 1, 1)}, PUSH * (-1, 1)),
        ({"signs": (-1, -1, -1)}, -PUSH),
        ({"rpy": (0, 0, np.pi / 2)}, PUSH[:, ::-1] * (-1, 1)),
        ({"rpy": (np.pi, 0, 0)}, PUSH * (1, -1)),
        ({"rpy": (0, np.pi / 2, 0)}, THREE[:, [2, 1]]),
        ({"rpy": (0, np.pi / 2, 0), "signs": (1, 1, -1)}, THREE[:, [2, 1]] * (-1, 1)),
        ({"zero": 0.2}, PUSH - PUSH[:20].mean(axis=0)),
        ({"zero": 0.2, "signs": (1, -1, 1)}, (PUSH - PUSH[:20].mean(axis=0)) * (1, -1)),
    ],
)
def test_a_sensor_may_be_turned_count_the_other_way_and_read_something_at_rest(
    tmp_path, sensor, expected
):
    columns = Columns(fz="fz_n")
    found = read(three(tmp_path), columns, sensor=RecordingSensor(**sensor))[1]
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_what_is_wrong_with_a_sensor_is_said_where_it_is(tmp_path):
    file = three(tmp_path)
    tilted = RecordingSensor(rpy=(0.0, 0.5, 0.0))
    with pytest.raises(InputError, match=r"^columns\.fz: sensor\.rpy tilts the sensor") as refused:
        read(file, sensor=tilted)
    assert refused.value.at == ("columns", "fz")
    with pytest.raises(InputError, match=r"^sensor\.zero = 2 s: must be shorter than the"):
        read(file, sensor=RecordingSensor(zero=2))
    with pytest.raises(InputError, match=r"^signs = \(1, 0.5, 1\): each must be 1 or -1"):
        RecordingSensor(signs=(1, 0.5, 1))
