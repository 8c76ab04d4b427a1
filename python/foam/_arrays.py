"""Arrays on their way in: any array-like to contiguous rows of float64 or int64, or an error with the remedy."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import InputError

#: No mesh of more triangles or vertices is copied; the loaders have the same limit.
MOST = 20_000_000


def _array(value: Any, what: str) -> NDArray[Any]:
    if isinstance(value, np.ma.MaskedArray) and np.any(np.ma.getmaskarray(value)):  # type: ignore[no-untyped-call]
        raise InputError(f"{what}: the array has masked values; remedy: leave these rows out")
    try:
        array = np.asarray(value)
    except (ValueError, TypeError) as error:
        raise InputError(f"{what}: it is no array of numbers ({error}); remedy: rows of equal length") from None
    return array


def rows(value: Any, what: str, columns: int = 3) -> NDArray[np.float64]:
    """Return numbers as float64, shape (n, columns), C-contiguous. Raises InputError for anything else."""
    array = _array(value, what)
    _check_shape(array, what, columns)
    if array.size and array.dtype.kind not in "fiu":
        raise InputError(f"{what}: numbers are expected, got dtype {array.dtype}; remedy: {what}.astype(float)")
    return np.ascontiguousarray(array, dtype=np.float64)


def index_rows(value: Any, what: str) -> NDArray[np.int64]:
    """Return indices as int64, shape (n, 3), C-contiguous. Raises InputError for anything else."""
    array = _array(value, what)
    if array.ndim == 2 and array.shape[1] == 4:
        raise InputError(f"{what}: triangles are expected, got four indices a row; remedy: split quads into triangles")
    _check_shape(array, what, 3)
    if array.size and array.dtype.kind not in "iu":
        raise InputError(f"{what}: whole numbers are expected, got dtype {array.dtype}; remedy: {what}.astype(int)")
    if array.dtype == np.uint64 and array.size and int(array.max()) > np.iinfo(np.int64).max:
        raise InputError(f"{what}: an index of {array.max()} is out of range")
    return np.ascontiguousarray(array, dtype=np.int64)


def for_each(value: Any, what: str, count: int, of: str) -> NDArray[np.float64]:
    """Return one number for each of `count`, from as many or from one. Raises InputError for anything else."""
    array = _array(value, what)
    if array.dtype.kind not in "fiu" and array.size:
        raise InputError(f"{what}: numbers are expected, got dtype {array.dtype}")
    if array.shape not in ((), (count,)):
        raise InputError(f"{what}: one number, or shape ({count},) for {count} {of} is expected, got {array.shape}")
    return np.broadcast_to(array.astype(np.float64), (count,))


def _check_shape(array: NDArray[Any], what: str, columns: int) -> None:
    if array.ndim != 2 or array.shape[1] != columns:
        raise InputError(f"{what}: shape (n, {columns}) is expected, got {array.shape}; remedy: one row for each of them")
    if array.shape[0] > MOST:
        raise InputError(f"{what}: {array.shape[0]} rows are more than {MOST}; remedy: simplify the mesh first")
