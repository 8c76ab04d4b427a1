"""What is wrong with an experiment: all of it at once, each with its place."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple


class Place(NamedTuple):
    """Where something stands in a file; from 1 on."""

    line: int
    column: int


START = Place(1, 1)


class Finding(NamedTuple):
    """An error and its place."""

    file: str
    where: Place | None  #: None: the file as a whole
    code: str
    message: str

    def __str__(self) -> str:
        at = f"{self.file}:{self.where.line}:{self.where.column}" if self.where else self.file
        return f"{at}: error[{self.code}]: {self.message}"


class Findings:
    """The findings of one file."""

    def __init__(self, file: str) -> None:
        self.file = file
        self._found: list[Finding] = []

    def error(self, where: Place | None, code: str, message: str) -> None:
        """Add an error."""
        finding = Finding(self.file, where, code, message)
        if finding not in self._found:
            self._found.append(finding)

    def __bool__(self) -> bool:
        return bool(self._found)

    def in_order(self) -> list[Finding]:
        """Return the findings in the order of their places; those of one place as they were found."""
        return sorted(self._found, key=lambda finding: finding.where or Place(0, 0))

    def locate(self, where: Place) -> str:
        """Return "file:line:column"."""
        return f"{self.file}:{where.line}:{where.column}"


def in_quotes(text: str, most: int = 60) -> str:
    """Return a text in quotes, cut if it is long, on one line."""
    shown = "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in text[:most])
    return f"'{shown}{'…' if len(text) > most else ''}'"


def _distance(a: str, b: str) -> int:
    """How many letters must be changed, added, removed, or swapped with the next one."""
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, first in enumerate(a, 1):
        older, before, row = before, row, [i]
        for j, second in enumerate(b, 1):
            least = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (first != second))
            if i > 1 and j > 1 and first == b[j - 2] and a[i - 2] == second:
                least = min(least, older[j - 2] + 1)
            row.append(least)
    return row[-1]


def nearest(word: str, known: Iterable[str]) -> str:
    """Return the known word that is likely to be meant; empty if none is."""
    best, limit = "", min(max(len(word) // 3, 1), 3) + 1
    for candidate in known if len(word) < 200 else ():
        distance = _distance(word, candidate)
        if distance < limit:
            best, limit = candidate, distance
    return best


def suggestion(word: str, known: list[str]) -> str:
    """Return the end of a message: the word that is likely to be meant, or all known ones."""
    near = nearest(word, known)
    if near:
        return f"; did you mean {in_quotes(near)}?"
    return f"; known: {', '.join(known)}" if 0 < len(known) <= 40 else ""
