"""The same seed gives the same bits, in whatever process, order, thread or company."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("same_bits.py")


def digests(*ways, flags=(), seed="0"):
    done = subprocess.run(
        [sys.executable, *flags, SCRIPT, *ways],
        env=os.environ | {"PYTHONHASHSEED": seed},
        capture_output=True,
        check=True,
        text=True,
    )
    return json.loads(done.stdout.splitlines()[-1])


@pytest.fixture(scope="module")
def found():
    here = digests("once", "reversed", "threads", "filmed", "kept")
    there = digests("once", "fork", "spawn", flags=("-O",), seed="4711")
    return here | {f"optimised, {name}": each for name, each in there.items()}


def test_the_same_seed_gives_the_same_bits(found):
    reference = found.pop("once")
    assert len(set(reference.values())) == len(reference) == 10  # no two cases are alike
    pairs = [
        (way, number, digest == reference[number])
        for way, each in found.items()
        for number, digest in each.items()
    ]
    assert len(pairs) == 60
    assert [(way, number) for way, number, same in pairs if not same] == []
