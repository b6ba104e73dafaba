"""What the page on learning shows can be done, and is as it says."""

import re
from pathlib import Path

from cowalk.scenarios.single_seat.environment import SingleSeatEnv

PAGE = Path(__file__).parents[3] / "docs" / "learning.md"


def test_its_examples_run(capsys):
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    exec(compile("\n".join(blocks), PAGE, "exec"), {})
    first, second = capsys.readouterr().out.splitlines()
    assert first.startswith("return ")
    named = re.search(r"print\(info\[\"reward_terms\"\]\)  # (.*)", PAGE.read_text())[1]
    assert ", ".join(re.findall(r"'(\w+)'", second)) == named


def test_its_table_says_where_each_entry_stands(seat_of):
    rows = re.findall(r"^\| `(\w+)` \| ([\dto ]+) \|", PAGE.read_text(), re.MULTILINE)
    layout = seat_of("puddle").layout
    assert list(layout) == [name for name, _ in rows]
    for name, place in rows:
        first, last = layout[name].start, layout[name].stop - 1
        assert place == (f"{first} to {last}" if last > first else str(first))


def test_its_table_names_every_argument():
    rows = re.findall(
        r"^\| `(\w+)` \| ", PAGE.read_text().partition("## What you")[0], re.MULTILINE
    )
    names = list(SingleSeatEnv.__init__.__annotations__)
    assert ["scenario", *rows, "return"] == names
