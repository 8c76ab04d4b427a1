"""Numbers of arguments, checked."""

from __future__ import annotations

import operator
from typing import Any

from .errors import UsageError

_MOST_SPHERES = 1_000_000


def count_of(elements: Any, what: str = "spheres") -> int:
    """Return a number of elements. Raises UsageError if it is out of bounds."""
    count = operator.index(elements)
    if not 1 <= count <= _MOST_SPHERES:
        raise UsageError(f"{what}: 1 to {_MOST_SPHERES} are possible, got {count}")
    return count


def seed_of(seed: Any) -> int:
    """Return a seed. Raises UsageError if it is out of bounds."""
    number = operator.index(seed)
    if not 0 <= number < 2**64:
        raise UsageError(f"seed: 0 to 2**64 - 1 is possible, got {number}")
    return number


def limit_of(seconds: Any) -> float | None:
    """Return a time limit, s. Raises UsageError if it is not above 0."""
    if seconds is None:
        return None
    limit = float(seconds)
    if not limit > 0:
        raise UsageError(f"time_limit: seconds above 0 are expected, got {seconds}")
    return limit
