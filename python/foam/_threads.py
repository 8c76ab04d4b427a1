"""The number of threads."""

from __future__ import annotations

import operator
from types import TracebackType

from . import _core
from .errors import UsageError

_set: int | None = None


def set_threads(count: int | None) -> None:
    """Limit foam to `count` threads in this process; None: one per core. Results do not depend on it."""
    global _set
    number = 0 if count is None else operator.index(count)
    if count is not None and not 1 <= number <= 1024:
        raise UsageError(f"threads: 1 to 1024 are possible, got {number}")
    _core.limit_threads(number)
    _set = count


class threads:
    """Limit foam to `count` threads inside a `with` block: `with foam.threads(1): …`. It holds for the process."""

    def __init__(self, count: int | None) -> None:
        self._count = count
        self._before: int | None = None

    def __enter__(self) -> threads:
        self._before = _set
        set_threads(self._count)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        set_threads(self._before)


def thread_count() -> int:
    """Return the number of threads that foam uses."""
    return min(_set or 1024, _core.thread_count())
