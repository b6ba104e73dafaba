"""Single force samples kept beside a run, on the command line."""

import json

import pyarrow.parquet as pq


def test_samples_are_written_when_asked_for_and_none_are_left_over(cowalk, scenario_file):
    file = scenario_file()
    code, out, _ = cowalk("run", file, "--samples", "--no-figure", "--json")
    assert code == 0
    folder = json.loads(out)["folder"]
    table = pq.read_table(f"{folder}/samples.parquet")
    assert table.num_rows == 3 * 240
    units = {field.name: field.metadata[b"unit"].decode() for field in table.schema}
    assert units["measured_force_x"] == "N"
    assert units["interaction_torque_z"] == "N m"
    cowalk("run", file, "--no-figure")
    assert not (file.parent / folder / "samples.parquet").exists()
