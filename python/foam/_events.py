"""Events of runs and searches, for progress callbacks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, Optional

from ._words import EventKind, Severity


class Event(NamedTuple):
    """An event of a run or of a search, for progress callbacks."""

    kind: EventKind
    link: str  #: empty: the whole run
    stage: str
    done: float  #: share of the whole run, 0 to 1
    seconds: float  #: since the start
    seconds_left: Optional[float]  #: if it is known
    message: str
    severity: Severity  #: of a finding
    cached: bool  #: task_finished: taken from the cache

    def __str__(self) -> str:
        words = [f"{100 * self.done:3.0f} %", self.kind.replace("_", " "), self.stage, self.link, self.message]
        return " ".join(word for word in words if word)


Progress = Callable[[Event], object]


def teller(progress: Progress | None) -> Callable[..., object] | None:
    """Return what hands the values of events to a callback; None where there is none."""
    if progress is None:
        return None
    callback = progress  # checkers forget in functions what is None outside

    def tell(*values: Any) -> object:
        return callback(Event(*values))

    return tell
