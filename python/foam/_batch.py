"""Results of data sets: foam.read_batch()."""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path
from typing import Any, Iterator, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import InputError


class BatchEntry(NamedTuple):
    """The result of one mesh of a data set."""

    id: str
    spheres: NDArray[np.float64]  #: (n, 4): x, y, z, r in metres; n is 0 for a mesh that failed
    certified: bool
    excess: float  #: inf for a mesh without a volume
    error: Optional[str]  #: the reason why it failed
    values: dict[str, Any]  #: all keys of its line


def read_batch(path: str | os.PathLike[str]) -> list[BatchEntry]:
    """Return the results of `foam batch`, sorted by id: those of its folder (finished or not), or of a table .jsonl or .jsonl.zst.

    Raises InputError if it cannot be read.
    """
    file = Path(path)
    if file.is_dir():
        with tempfile.TemporaryDirectory(prefix="foam-batch-") as folder:
            table = Path(folder) / "table.jsonl"
            _core.collect_batch(str(file), str(table))
            return list(_entries(table))
    if not file.is_file():
        raise InputError(f"{file}: there is no such file or folder")
    if not file.name.endswith((".jsonl", ".jsonl.zst")):
        raise InputError(
            f"{file}: a folder of foam batch, a .jsonl or a .jsonl.zst is expected; remedy: foam batch collect -o X.jsonl"
        )
    return list(_entries(file))


def _entries(table: Path) -> Iterator[BatchEntry]:
    lines = _core.read_batch_table(str(table)).split(b"\n")  # text has more line ends than JSON lines
    for number, line in enumerate(lines[:-1] if not lines[-1] else lines, 1):
        try:
            values = json.loads(line)
            error = values.get("error")
            excess = values.get("excess")
            yield BatchEntry(
                values["id"],
                np.array(values.get("spheres", []), dtype=np.float64).reshape(-1, 4),
                bool(values.get("certified", False)),
                float("inf") if excess is None else excess,
                None if error is None else f"{error['code']}: {error['reason']}",
                values,
            )
        except (ValueError, KeyError, TypeError) as error:
            raise InputError(f"{table}:{number}: it is no line of foam batch collect ({error})") from None
