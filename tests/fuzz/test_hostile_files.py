"""Files from strangers end no process, hang none, and have no other file read.

``python tests/fuzz/hostile_files.py FOLDER NUMBER 1`` repeats a case.
"""

import subprocess
import sys
from pathlib import Path

import pytest

ATTACKS = Path(__file__).with_name("hostile_files.py")
FEW, MANY = 60, 600
FINE = ("refused", "filmed", "read ", "walked ")


def came_of(folder, first, count):
    """Yield number and outcome of cases; who ends the process is left out of the next one."""
    end = first + count
    while first < end:
        command = [sys.executable, ATTACKS, folder / str(first), str(first), str(end - first)]
        ended = subprocess.run(command, capture_output=True, text=True, errors="replace")
        number = first
        for line in ended.stdout.splitlines():
            word, _, outcome = line.partition(" ")
            number = int(word)
            yield (
                number,
                outcome or f"ended the process ({ended.returncode}): {ended.stderr[-500:]}",
            )
        if ended.returncode == 0:
            return
        if not ended.stdout:
            raise AssertionError(ended.stderr)
        first = number + 1


def judge(tmp_path, first, count):
    found = dict(came_of(tmp_path, first, count))
    wrong = {
        f"python tests/fuzz/hostile_files.py FOLDER {number} 1": outcome
        for number, outcome in found.items()
        if not outcome.startswith(FINE)
    }
    assert not wrong, wrong
    assert len(found) == count
    # Attacks that are all refused for the same reason would show nothing.
    for kind in FINE:
        assert sum(outcome.startswith(kind) for outcome in found.values()) >= count // 40, kind


def test_a_few_hostile_files(tmp_path):
    judge(tmp_path, 0, FEW)


@pytest.mark.fuzz
def test_many_hostile_files(tmp_path):
    judge(tmp_path, FEW, MANY)
