"""The wheel holds all that a run needs, and works outside the checkout."""

import json
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent


def call(*command, cwd=None):
    done = subprocess.run([*map(str, command)], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Install the wheel into an empty environment that has the dependencies and nothing else."""
    folder = tmp_path_factory.mktemp("wheel")
    call(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "-w", folder, ROOT)
    (wheel,) = folder.glob("cowalk-*.whl")
    environment = folder / "environment"
    venv.create(environment, with_pip=False, symlinks=True)
    dependencies = folder / "dependencies"
    dependencies.mkdir()
    for entry in Path(sysconfig.get_path("purelib")).iterdir():
        # Left out: this checkout's own installation, and hooks that would bring it in.
        if "cowalk" not in entry.name and entry.suffix != ".pth":
            (dependencies / entry.name).symlink_to(entry)
    python = environment / "bin" / "python"
    call(sys.executable, "-m", "pip", "--python", python, "install", "--no-deps", "-q", wheel)
    packages = next((environment / "lib").glob("python*/site-packages"))
    (packages / "dependencies.pth").write_text(f"{dependencies}\n")
    return environment


def test_a_scenario_runs_from_the_wheel(installed, tmp_path):
    python = installed / "bin" / "python"
    where = call(python, "-c", "import cowalk.scenarios as s; print(s.__file__)", cwd=tmp_path)
    assert where.startswith(str(installed))
    printed = call(
        installed / "bin" / "cowalk", "run", "puddle", "--json", "--set", "duration=3.0",
        "--set", "expect={}", cwd=tmp_path,
    )  # fmt: skip
    assert json.loads(printed)["simulated_time_s"] == pytest.approx(3.0)
    files = {file.name for file in (tmp_path / "runs" / "puddle").iterdir()}
    assert files == {"trace.parquet", "summary.json", "scenario.yaml", "figure.png"}


def test_the_wheel_brings_the_library_and_its_types(installed, tmp_path):
    listed = json.loads(call(installed / "bin" / "cowalk", "list", "--json", cwd=tmp_path))
    assert {"puddle", "paper-open-loop"} <= {entry["name"] for entry in listed["scenarios"]}
    packages = next((installed / "lib").glob("python*/site-packages"))
    for part in ("sim", "estimation", "agents", "scenarios"):
        assert (packages / "cowalk" / part / "py.typed").exists()
    assert not (packages / "sim").exists()


def test_the_wheel_brings_what_new_parts_start_from(installed, tmp_path):
    call(installed / "bin" / "cowalk", "new", "smoother", "my_smoother", cwd=tmp_path)
    checked = call(installed / "bin" / "cowalk", "check", "my_smoother:MySmoother", cwd=tmp_path)
    assert checked == "my_smoother:MySmoother: no fault (smoother)\n"
