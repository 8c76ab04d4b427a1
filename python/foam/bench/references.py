"""Published numbers of other programs, drawn beside ours."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

import pandas  # type: ignore

from ..errors import InputError
from .findings import Findings, in_quotes, suggestion
from .growth import growth_text, labelled
from .plots import Series
from .tree import Value
from .values import expect_list, expect_map, read_texts, read_value, refuse_unknown_keys, text

_EXAMPLE = "references: [{label: …, file: FILE.csv, x: COLUMN, y: COLUMN}]"


@dataclass(frozen=True)
class Reference:
    """Columns of a CSV file: published numbers of another program, drawn beside ours."""

    label: str
    files: list[str]  #: candidates; a relative one starts beside the experiment, then in FOAM_SHARED
    x: str
    y: str
    folder: Path
    where: dict[str, str] = field(default_factory=dict)  #: rows to take: column and its text; none: all

    def find(self) -> Path | None:
        """Return the first candidate that exists."""
        folders = [self.folder.absolute()] + ([Path(shared)] if (shared := os.environ.get("FOAM_SHARED")) else [])
        places = [folder / file for file in self.files for folder in folders]
        return next((place for place in places if place.is_file()), None)

    def points(self, file: Path) -> list[tuple[float, float]]:
        """Return the points in the order of x. Raises InputError for a column that is missing, and for a cell that is no
        number."""
        try:
            table = pandas.read_csv(file, dtype=str, keep_default_na=False)
        except (OSError, ValueError) as error:
            raise InputError(f"{file}: it cannot be read as CSV ({error})") from None
        for column in (self.x, self.y, *self.where):
            if column not in table:
                raise InputError(
                    f"{file}: there is no column {in_quotes(column)}{suggestion(column, list(table.columns))}"
                )
        for column, wanted in self.where.items():
            table = table[table[column] == wanted]
        for column in (self.x, self.y):
            numbers = pandas.to_numeric(table[column], errors="coerce")
            if numbers.isna().any():
                cell = table[column][numbers.isna()].iloc[0]
                raise InputError(f"{file}: column {in_quotes(column)} holds {in_quotes(cell)}, no number")
            table = table.assign(**{column: numbers})
        return sorted(zip(table[self.x].astype(float), table[self.y].astype(float)))

    def drawn(self) -> tuple[str, list[Series]]:
        """Return a sentence about the numbers, and their line in a plot; no line if the file is not here."""
        found = self.find()
        if found is None:
            return f"Left out, its file is not here: {self.label} ({', '.join(self.files)}).", []
        points = self.points(found)
        note = f"{self.label}: {len(points)} published times, growth {growth_text(points)}."
        return note, [Series(labelled(self.label, points), points, True)]


def read_reference_list(value: Value | None, findings: Findings, folder: Path) -> list[Reference]:
    """Return the list `references`; none where there is no value."""
    if value is None or not expect_list(value, "references", _EXAMPLE, findings):
        return []
    return [_reference(item, findings, folder) for item in value.items if expect_map(item, "references", _EXAMPLE, findings)]


def _reference(item: Value, findings: Findings, folder: Path) -> Reference:
    refuse_unknown_keys(item, "a reference", ["label", "file", "where", "x", "y"], findings)
    words = {}
    for key in ("label", "x", "y", "file"):
        value = item.find(key)
        if value is None:
            findings.error(item.where, "missing-key", f"a reference needs '{key}'; remedy: write {_EXAMPLE}")
        elif key != "file":
            words[key] = read_value(value, text(key), "a reference", findings)
    file, where = item.find("file"), item.find("where")
    files = [] if file is None else read_texts(file, "file", findings)
    rows = {}
    if where is not None and expect_map(where, "where", "where: {column: text}", findings):
        rows = {key.text: value.text for key, value in where.pairs()}  # as written, whatever its kind
    return Reference(words.get("label") or "", files, words.get("x") or "", words.get("y") or "", folder, rows)
