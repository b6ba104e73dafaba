"""How the lines of a CSV file are to be read: remarks, a header or none, then rows."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

from .readings import is_number, moment_of

_SEPARATORS = {";": "semicolons", "\t": "tabs"}
_REMARK = "#"


@dataclass(frozen=True)
class Layout:
    """Names of a CSV file's columns, and where its rows begin.

    Attributes
    ----------
    names : list of str
        By number from "0" if there is no header.
    named : bool
        Whether there is a header.
    skipped : int
        Lines before the first row.
    """

    names: list[str]
    named: bool
    skipped: int

    def line(self, path: Path, index: int) -> int:
        """Return the line, from 1, of a row counted from 0: empty ones hold no row."""
        with path.open("rb") as file:
            for number, line in enumerate(file, start=1):
                if number > self.skipped and line.strip(b"\r\n"):
                    if index == 0:
                        return number
                    index -= 1
        raise IndexError(f"{path} has no row {index}")


def csv_layout(path: Path) -> Layout:
    """Return how a CSV file is laid out.

    Lines that begin with ``#`` come before everything else; the last of them is the header if
    nothing else is, as NumPy writes it. A first line of nothing but numbers, dates and times
    is a row: the file has no header.

    Raises
    ------
    ValueError
        If it has no lines, the first ones are not UTF-8, or separated by other than commas.
    """
    remark = ""
    with path.open("rb") as file:
        for number, line in enumerate(file, start=1):
            text = _decoded(line).strip("\r\n")
            if text.startswith(_REMARK):
                remark = text.lstrip(_REMARK)
            elif text.strip():
                return _of_line(text, remark, number)
    raise ValueError("it is empty")


def _decoded(line: bytes) -> str:
    try:
        return line.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        byte = line[error.start]
        raise ValueError(
            f"its header is not UTF-8 (byte {byte:#04x}); save the file as UTF-8"
        ) from error


def _of_line(text: str, remark: str, number: int) -> Layout:
    other = next((name for sign, name in _SEPARATORS.items() if sign in text), None)
    decimals = other and not any(letter.isalpha() for letter in text)
    if other and (decimals or "," not in text):
        raise ValueError(
            f"its columns are separated by {other}; save it with commas between columns, and "
            "points in numbers"
        )
    cells = _cells(text)
    if not all(is_number(cell) or moment_of(cell) for cell in cells):
        return Layout(cells, True, number)
    names = _cells(remark)
    if len(names) == len(cells):
        return Layout(names, True, number - 1)
    return Layout([str(position) for position in range(len(cells))], False, number - 1)


def _cells(text: str) -> list[str]:
    return [cell.strip() for cell in next(csv.reader([text]), [])]
