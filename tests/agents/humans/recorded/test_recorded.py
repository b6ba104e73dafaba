"""Forces from files: what is read, how it is resampled, and what is refused."""

import sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyarrow import parquet

from cowalk.agents.humans.recorded.human import RecordedHuman
from cowalk.agents.humans.recorded.recording import Columns, read_recording
from cowalk.agents.humans.recorded.resampling import resample
from cowalk.agents.humans.recorded.units import Units
from cowalk.scenarios.cli import main as cli
from cowalk.scenarios.trace.trace import Trace
from cowalk.sim.basics.errors import InputError

SHARED = Path(__file__).parents[5] / "shared" / "data" / "panda_comanipulation"
NO_RNG = np.random.default_rng(0)


def write_csv(file, time, fx, fy, header="t_s,fx_n,fy_n"):
    rows = np.column_stack((time, fx, fy))
    np.savetxt(file, rows, delimiter=",", header=header, comments="", fmt="%.9g")
    return str(file)


def play(human, situation, observe, steps):
    human.reset(NO_RNG, situation)
    return np.array([human.act(observe(time=k * situation.period)) for k in range(steps)])


def test_every_format_reads_the_same(tmp_path):
    time = np.arange(100) * 0.002
    fx, fy = np.sin(time), np.cos(time)
    table = np.column_stack((time, fx, fy))
    np.save(tmp_path / "plain.npy", table)
    named = np.rec.fromarrays(table.T, names="t_s,fx_n,fy_n")
    np.save(tmp_path / "named.npy", np.asarray(named, dtype=named.dtype))
    np.savez(tmp_path / "r.npz", t_s=time, fx_n=fx, fy_n=fy)
    parquet.write_table(pa.table({"t_s": time, "fx_n": fx, "fy_n": fy}), tmp_path / "r.parquet")
    write_csv(tmp_path / "r.csv", time, fx, fy)
    for file in ("plain.npy", "named.npy", "r.npz", "r.parquet", "r.csv"):
        columns = Columns(time="0", fx="1", fy="2") if file == "plain.npy" else Columns()
        read_time, force = read_recording(str(tmp_path / file), columns, Units())
        np.testing.assert_allclose(read_time, time, atol=1e-8)
        np.testing.assert_allclose(force, table[:, 1:], atol=1e-8)


def test_columns_are_mapped_and_units_converted(tmp_path):
    file = write_csv(
        tmp_path / "r.csv", [1000, 1002, 1004], [0, 10, 20], [1, 2, 3], "clock,side,ahead"
    )
    columns = Columns(time="clock", fx="ahead", fy="side")
    time, force = read_recording(file, columns, Units(time="ms", force="lbf"))
    np.testing.assert_allclose(time, [0.0, 0.002, 0.004])
    np.testing.assert_allclose(force[1], [2 * 4.4482216, 10 * 4.4482216])


def test_a_runs_own_trace_can_be_replayed(tmp_path):
    parquet.write_table(
        pa.table(
            [pa.array(np.arange(4) * 0.05), pa.array(np.ones(4)), pa.array(np.zeros(4))],
            schema=pa.schema(
                [
                    pa.field("t", pa.float64(), metadata={"unit": "s"}),
                    pa.field("fx", pa.float64(), metadata={"unit": "N"}),
                    pa.field("fy", pa.float64(), metadata={"unit": "N"}),
                ]
            ),
        ),
        tmp_path / "trace.parquet",
    )
    columns = Columns(time="t", fx="fx", fy="fy")
    read_recording(str(tmp_path / "trace.parquet"), columns, Units())
    with pytest.raises(InputError, match=r"column 'fx' is in 'N', the scenario says 'mN'"):
        read_recording(str(tmp_path / "trace.parquet"), columns, Units(force="mN"))


@pytest.mark.parametrize(
    ("header", "factors"),
    [
        ("t_ms,fx_mn,fy_kn", (1e-3, 1e-3, 1e3)),
        ("t [us],Fx [mN],Fy [lbf]", (1e-6, 1e-3, 4.4482216152605)),
        ("time (ms),force/N,side_mN", (1e-3, 1.0, 1e-3)),
        ("t,fx,fy", (1.0, 1.0, 1.0)),
    ],
)
def test_a_unit_in_a_columns_name_counts_where_the_scenario_names_none(tmp_path, header, factors):
    steps = np.array([0.0, 1.0, 2.0]) * 0.01 / factors[0]
    file = write_csv(tmp_path / "r.csv", steps, [1, 2, 3], [-0.1, 0.0, 0.2], header)
    names = header.split(",")
    columns = Columns(time=names[0], fx=names[1], fy=names[2])
    time, force = read_recording(file, columns, Units())
    np.testing.assert_allclose(time, [0.0, 0.01, 0.02])
    np.testing.assert_allclose(force, np.array([[1, -0.1], [2, 0], [3, 0.2]]) * factors[1:])


@pytest.mark.parametrize(
    ("header", "units", "message"),
    [
        ("t_s,fx_mn,fy_n", Units(force="N"), r"column 'fx_mn' is in 'mN', the scenario says 'N'"),
        ("t_ms,fx_n,fy_n", Units(time="s"), r"column 't_ms' is in 'ms', the scenario says 's'"),
    ],
)
def test_a_unit_in_a_columns_name_that_the_scenario_contradicts_is_refused(
    tmp_path, header, units, message
):
    file = write_csv(tmp_path / "r.csv", RISING, np.ones(10), np.ones(10), header)
    names = header.split(",")
    with pytest.raises(InputError, match=message) as refused:
        read_recording(file, Columns(time=names[0], fx=names[1], fy=names[2]), units)
    assert "\n" not in str(refused.value)


def test_a_unit_that_nobody_knows_is_refused(tmp_path):
    fields = [pa.field("t_s", pa.float64()), pa.field("fx_n", pa.float64())]
    fields.append(pa.field("fy_n", pa.float64(), metadata={"unit": "stone"}))
    columns = [pa.array(RISING), pa.array(RISING), pa.array(RISING)]
    parquet.write_table(pa.table(columns, schema=pa.schema(fields)), tmp_path / "r.parquet")
    with pytest.raises(InputError, match=r"column 'fy_n' is in 'stone'; known: N, mN"):
        read_recording(str(tmp_path / "r.parquet"), Columns(), Units())


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("fx [V]", "V"),
        ("fx_nm", "nm"),
        ("fx (kg)", "kg"),
        ("fx_g", "g"),
        ("fx_mV", "mV"),
        ("fx [m/s]", "m/s"),
        ("fx/counts", "counts"),
        ("/ft/x/V", "V"),
        ("fx (N m)", "N m"),
        ("fx [N·m]", "N·m"),
        ("fx [m]", "m"),
        ("fx (deg/s)", "deg/s"),
        ("fx [V] raw", "V"),
        ("fx_ms", "ms"),
        ("fx [stone]", "stone"),
    ],
)
def test_what_is_no_force_is_not_read_as_newtons(tmp_path, name, unit):
    file = write_csv(tmp_path / "r.csv", RISING, np.ones(10), np.ones(10), f"t_s,{name},fy_n")
    with pytest.raises(InputError, match=f"is in '{unit}'; known: N, mN") as refused:
        read_recording(file, Columns(fx=name), Units())
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("name", ["t_n", "t [Hz]", "t_min"])
def test_what_is_no_time_is_not_read_as_seconds(tmp_path, name):
    file = write_csv(tmp_path / "r.csv", RISING, np.ones(10), np.ones(10), f"{name},fx_n,fy_n")
    with pytest.raises(InputError, match=r"known: s, ms"):
        read_recording(file, Columns(time=name), Units())


def test_an_unknown_word_where_units_stand_counts_only_if_the_scenario_states_none(tmp_path):
    file = write_csv(tmp_path / "r.csv", RISING, np.ones(10), np.ones(10), "t_s,fx [raw],fy_n")
    columns = Columns(fx="fx [raw]")
    with pytest.raises(InputError, match=r"'raw'.*if that is no unit, say units\.force"):
        read_recording(file, columns, Units())
    np.testing.assert_allclose(read_recording(file, columns, Units(force="N"))[1], 1.0)


@pytest.mark.parametrize(
    "name",
    [
        *("/arm/wrench/force/x", "/arm/wrench.force.x", "/ft/force/0", "F[0]", "F[x]", "F(t)"),
        *(
            "Fx (filtered)",
            "Fx (left, smooth)",
            "Fx_filtered",
            "force/left",
            "Fx [1]",
            "x",
            "F (2)",
        ),
    ],
)
def test_the_end_of_a_name_is_no_unit_unless_it_is_known_as_one(tmp_path, name):
    file = tmp_path / "r.csv"
    write_csv(file, RISING, np.full(10, 2.0), np.ones(10), f't_s,"{name}",fy_n')
    force = read_recording(str(file), Columns(fx=name), Units())[1]
    np.testing.assert_allclose(force, [[2.0, 1.0]] * 10)


@pytest.mark.parametrize(
    ("name", "factor"),
    [
        *(("F/N", 1.0), ("/ft/x/mN", 1e-3), ("Fx [newton]", 1.0), ("Fx (Newtons)", 1.0)),
        *(("Fx [kN] filtered", 1e3), ("Fx (filtered) [mN]", 1e-3), ("fx_kilonewton", 1e3)),
        *(("Fx [kp]", 9.80665), ("Fx [ lbf ]", 4.4482216152605)),
    ],
)
def test_units_of_force_are_known_in_other_spellings(tmp_path, name, factor):
    values = np.full(10, 1.0 / factor)
    file = write_csv(tmp_path / "r.csv", RISING, values, np.ones(10), f"t_s,{name},fy_n")
    force = read_recording(file, Columns(fx=name), Units())[1]
    np.testing.assert_allclose(force[:, 0], 1.0, rtol=1e-6)


@pytest.mark.parametrize(
    ("name", "factor"),
    [
        *(("t/ms", 1e-3), ("t [sec]", 1.0), ("time (Seconds)", 1.0), ("stamp_nsec", 1e-9)),
        *(("t [µs]", 1e-6), ("t [μs]", 1e-6), ("t_usec", 1e-6), ("t (milliseconds)", 1e-3)),
    ],
)
def test_units_of_time_are_known_in_other_spellings(tmp_path, name, factor):
    file = write_csv(
        tmp_path / "r.csv", RISING / factor, np.ones(10), np.ones(10), f"{name},fx_n,fy_n"
    )
    time = read_recording(file, Columns(time=name), Units())[0]
    np.testing.assert_allclose(time, RISING, rtol=1e-6)


def test_a_column_in_another_unit_is_not_proposed(tmp_path):
    file = write_csv(tmp_path / "r.csv", RISING, np.ones(10), np.ones(10), "t_s,fx_nm,fy_n")
    with pytest.raises(InputError, match=r"no column 'fx_n'; ") as refused:
        read_recording(file, Columns(), Units())
    assert "did you mean" not in str(refused.value)  # neither fx_nm nor fy_n


def test_missing_rows_are_refused_or_held(tmp_path):
    time = np.concatenate((np.arange(0, 101), np.arange(300, 401))) * 0.002
    fx = np.where(time < 0.3, 4.0, -4.0)
    file = write_csv(tmp_path / "r.csv", time, fx, 0.0 * fx)
    with pytest.raises(
        InputError, match=r"nothing for 0\.4 s from 0\.2 s on \(row 102, "
    ) as refused:
        RecordedHuman(file=file)
    assert "gaps: hold" in str(refused.value)
    read, force = read_recording(file, Columns(), Units(), "hold")
    for how in ("mean", "linear", "hold"):
        played = resample(read, force, 0.05, how)[:, 0]
        np.testing.assert_allclose(played[:11], 4.0)  # up to 0.55 s
        np.testing.assert_allclose(played[12:], -4.0)
    human = RecordedHuman(file=file, gaps="hold")
    assert human.gaps == "hold"


def test_uneven_rows_without_a_hole_are_read(tmp_path):
    time = np.cumsum(np.where(np.arange(50) == 20, 0.04, 0.002))
    read, _ = read_recording(write_csv(tmp_path / "r.csv", time, time, time), Columns(), Units())
    assert len(read) == 50


RISING = np.arange(10) * 0.002


def faulty(**changes):
    columns = {"time": RISING.copy(), "fx": np.ones(10), "fy": np.ones(10)}
    for name, (row, value) in changes.items():
        columns[name][row] = value
    return columns


@pytest.mark.parametrize(
    ("columns", "arguments", "message"),
    [
        (faulty(), {"columns": Columns(fx="force")}, r"no column 'force'; known: t_s, fx_n"),
        (faulty(fy=(4, np.nan)), {}, r"column 'fy_n' has no finite number in row 6 \(1 such"),
        (faulty(fx=(4, np.inf)), {}, r"column 'fx_n' has no finite number in row 6"),
        (faulty(time=(5, 0.007)), {}, r"'t_s' does not rise in row 7: 0\.007 s after 0\.008 s"),
        (faulty(fx=(2, 3000.0)), {}, r"column 'fx_n' reads 3000 N in row 4 .*another unit"),
        (faulty(time=(slice(None), RISING * 1e3)), {}, r"2 s apart with units\.time = 's'"),
        (faulty(), {"units": Units(time="ms")}, r"column 't_s' is in 's', the scenario says 'ms'"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(tmp_path, columns, arguments, message):
    file = write_csv(tmp_path / "bad.csv", columns["time"], columns["fx"], columns["fy"])
    with pytest.raises(InputError, match=message) as refused:
        RecordedHuman(file=file, **arguments)
    assert str(refused.value).startswith(f"file = {file!r}")
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("none.csv", None, "no such file"),
        ("table.xlsx", b"", r"ends in none of \.csv, \.parquet, \.npy, \.npz"),
        ("r.parquet", b"not parquet", "cannot be read as Parquet"),
        ("r.npy", b"not numpy", "cannot be read as NumPy: it is damaged"),
        ("r.npy", b"", "cannot be read as NumPy: it is damaged"),
        ("r.npz", b"PK\x03\x04 cut short", "cannot be read as NumPy: it is damaged"),
        ("r.csv", "t_s,fx_n,fy_n,Kräfte\n0,1,2,3\n".encode("latin-1"), "0xe4.*; save .* as UTF-8"),
        ("r.csv", b"t_s;fx_n;fy_n\n0;1;2\n0.1;1;2\n", "are separated by semicolons"),
        ("r.csv", b"t_s;fx_n;fy_n\n0,0;1,5;2\n0,1;1;2\n", "are separated by semicolons"),
        ("r.csv", b"t_s\tfx_n\tfy_n\n0\t1\t2\n", "are separated by tabs"),
        ("r.csv", b"t_s,fx_n,fy_n\n0,1,2\n0.1,1\n", "cannot be read as CSV"),
        ("r.csv", b"t_s,fx_n,fy_n\n0,1,2\n0.1,hard,2\n", "'fx_n' does not hold numbers"),
        ("r.csv", b"t_s,fx_n,fy_n\n0,1,2\n", "holds 1 rows; at least 2"),
        ("r.csv", b"t_s,fx_n,fy_n\n0,1,2\n0.1,,2\n", "no finite number in row 3"),
        ("r.csv", b"", "cannot be read as CSV"),
        (
            "r.csv",
            b"t_s,fx_n,fy_n,fx_n\n0,1,2,3\n0.1,1,2,3\n",
            "more than one column is called 'fx",
        ),
    ],
)
def test_files_that_cannot_be_read_are_named(tmp_path, name, content, message):
    file = tmp_path / name
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(InputError, match=message) as refused:
        RecordedHuman(file=str(file))
    assert "\n" not in str(refused.value)
    assert "pickle" not in str(refused.value)


def test_an_array_without_names_is_told_how_to_name_columns(tmp_path):
    np.save(tmp_path / "plain.npy", np.column_stack((RISING, RISING, RISING)))
    cure = r'say columns: \{time: "0", fx: "1", fy: "2"\}'
    with pytest.raises(InputError, match=cure):
        RecordedHuman(file=str(tmp_path / "plain.npy"))


@pytest.mark.parametrize(
    ("unit", "message"), [({"force": "lb"}, "^force = 'lb'; did you mean 'lbf'")]
)
def test_an_unknown_unit_is_refused(unit, message):
    with pytest.raises(InputError, match=message.replace(";", ".")):
        Units(**unit)


@given(
    st.integers(20, 400),
    st.sampled_from([0.001, 0.004, 0.03, 0.11]),
    st.sampled_from([0.05, 0.02, 0.1]),
)
def test_the_mean_keeps_the_impulse(samples, step, period):
    time = np.arange(samples) * step
    force = np.stack((np.sin(3.0 * time) + 1.0, time), axis=-1)
    forces = resample(time, force, period, "mean")
    until = len(forces) * period
    if until > time[-1]:
        return  # shorter than one period: there is no whole one to compare
    fine = np.linspace(0.0, until, 20001)
    expected = [np.trapezoid(np.interp(fine, time, part), fine) for part in force.T]
    np.testing.assert_allclose(forces.sum(axis=0) * period, expected, rtol=1e-4, atol=1e-4)


def test_resampling_takes_the_mean_the_line_or_the_last_sample():
    time, force = np.array([0.0, 0.1, 0.2]), np.array([[0.0, 1.0], [2.0, 1.0], [0.0, 1.0]])
    expected = {"mean": [0.5, 1.5, 1.5, 0.5], "linear": [0, 1, 2, 1], "hold": [0, 0, 2, 2]}
    for how, values in expected.items():
        np.testing.assert_allclose(resample(time, force, 0.05, how)[:, 0], values, atol=1e-12)
        np.testing.assert_allclose(resample(time, force, 0.05, how)[:, 1], 1.0)


def test_a_recording_loops_or_stops(tmp_path, situation, observe):
    time = np.arange(101) * 0.002  # 0.2 s: four control periods
    file = write_csv(tmp_path / "r.csv", time, time, -time)
    once = play(RecordedHuman(file=file, at_end="stop", scale=2.0), situation, observe, 10)
    np.testing.assert_allclose(once[:4, 0], 2.0 * np.array([0.025, 0.075, 0.125, 0.175]))
    np.testing.assert_array_equal(once[4:], 0.0)
    looped = play(RecordedHuman(file=file, at_end="loop"), situation, observe, 12)
    np.testing.assert_allclose(looped, np.tile(looped[:4], (3, 1)))
    later = play(RecordedHuman(file=file, start=0.15), situation, observe, 8)
    np.testing.assert_array_equal(later[:3], 0.0)
    np.testing.assert_allclose(later[3:7], looped[:4])


@pytest.mark.parametrize("number", range(6))
def test_recordings_drive_a_run_from_the_command_line(
    number, stand_in_recording, tmp_path, monkeypatch, capfd
):
    shared = SHARED / f"recording_{number}.csv"
    file = shared if shared.is_file() else stand_in_recording
    arguments = ["run", "puddle", "--plant", "unicycle", "--human", "recorded", "--no-figure"]
    settings = [f"human.parameters.file={file}", "duration=6", "expect={}"]
    for setting in settings:
        arguments += ["--set", setting]
    monkeypatch.setattr(sys, "argv", ["cowalk", *arguments, "--out", str(tmp_path / "run")])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 0, capfd.readouterr().err
    trace = Trace.read(tmp_path / "run" / "trace.parquet").columns()
    time, force = read_recording(str(file), Columns(), Units())
    expected = resample(time, force, 0.05, "mean")
    steps = min(len(expected), len(trace["t"]))
    intended = np.stack((trace["fx_intent"], trace["fy_intent"]), axis=-1)
    np.testing.assert_allclose(intended[:steps], expected[:steps])
    assert np.abs(intended).max() > 0.5


def test_a_bad_recording_is_one_line_on_the_command_line(tmp_path, monkeypatch, capfd):
    file = write_csv(tmp_path / "r.csv", RISING, np.ones(10), np.ones(10))
    arguments = [
        *("run", "puddle", "--human", "recorded", "--out", str(tmp_path / "run")),
        *("--set", f"human.parameters.file={file}"),
        *("--set", "human.parameters.columns.fy=side"),
    ]
    monkeypatch.setattr(sys, "argv", ["cowalk", *arguments])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 2
    line = capfd.readouterr().err
    assert line.count("\n") == 1
    assert "no column 'side'" in line
