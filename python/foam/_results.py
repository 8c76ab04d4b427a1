"""What evaluate, certify and self_collision return."""

from __future__ import annotations

import html
import math
from typing import TYPE_CHECKING, Any, Iterator, Mapping, TypedDict

import numpy as np
from numpy.typing import NDArray

from ._words import Reason


class Figures:
    """The figures of a link or of the whole robot, under the names of `foam evaluate --json`.

    Lengths in metres, areas in m², volumes in m³; ratios have no unit. Figures that are infinite are inf. The glossary
    of the documentation defines them.
    """

    spheres: int  #: the number of elements
    certified: bool
    gap_m: float
    covered: float
    covered_standard_error: float  #: of foam.evaluate()
    excess: float
    excess_standard_error: float
    excess_volume_m3: float
    excess_volume_standard_error_m3: float
    missing: float
    missing_standard_error: float
    missing_volume_m3: float
    missing_volume_standard_error_m3: float
    protrusion_max_m: float
    protrusion_mean_m: float
    exposed_area_m2: float
    volume_m3: float
    area_m2: float
    volume_ratio: float  #: of foam.evaluate()

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = dict(values)

    if not TYPE_CHECKING:  # so that checkers know the figures above, and no others

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_") or name not in self._values:
                raise AttributeError(f"there is no figure '{name}'; there are: {', '.join(self._values)}")
            value = self._values[name]
            return math.inf if value is None else value

    def __dir__(self) -> list[str]:
        return sorted(self._values)

    def to_dict(self) -> dict[str, Any]:
        """Return the figures as numbers for JSON; those that are infinite are None."""
        return dict(self._values)

    def __reduce__(self) -> tuple[Any, ...]:
        return Figures, (self._values,)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Figures):
            return NotImplemented
        return self._values == other._values

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<foam.Figures: {self.spheres} elements, excess {self.excess:.3g}, gap {self.gap_m:.3g} m>"


class _Result:
    """A result that is a dictionary for JSON underneath."""

    def __init__(self, values: dict[str, Any]) -> None:
        self._values = values

    def to_dict(self) -> dict[str, Any]:
        """Return what the command line prints with --json."""
        return self._values

    @property
    def notes(self) -> list[str]:
        """What was left out or is remarkable."""
        return list(self._values["notes"])


class _Judged(_Result):
    """A result with a verdict."""

    @property
    def statement(self) -> str:
        """The verdict in words, as the command line says it and files have it in their headers."""
        return str(self._values["proof"]["statement"])

    @property
    def missing(self) -> float:
        """Share of the volume of the links that lies outside all elements; 0 where all are covered as solids;
        not a number where it was not measured."""
        missing = self._values["proof"]["missing"]
        return float("nan") if missing is None else float(missing)


class Evaluation(_Judged):
    """The figures of a sphere model."""

    @property
    def total(self) -> Figures:
        """The figures of the whole robot."""
        return Figures(self._values["total"])

    @property
    def with_spheres(self) -> Figures:
        """The figures of the links that have spheres."""
        return Figures(self._values["with_spheres"])

    @property
    def links(self) -> dict[str, Figures]:
        """The figures by link, in the order of the URDF."""
        return {link["link"]: Figures({k: v for k, v in link.items() if k != "link"}) for link in self._values["links"]}

    @property
    def certified(self) -> bool:
        """Whether every link is proved to lie inside its spheres."""
        return all(link["certified"] for link in self._values["links"])

    def __repr__(self) -> str:
        return f"<foam.Evaluation: {len(self._values['links'])} links, {self.total!r}>"


class Comparison(Mapping[str, Evaluation]):
    """The figures of several models of one robot, by the names of the models."""

    def __init__(self, evaluations: Mapping[str, Evaluation]) -> None:
        self._evaluations = dict(evaluations)

    def __getitem__(self, name: str) -> Evaluation:
        return self._evaluations[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._evaluations)

    def __len__(self) -> int:
        return len(self._evaluations)

    def to_dict(self) -> dict[str, Any]:
        """Return what `foam compare --json` prints."""
        values = [one.to_dict() for one in self.values()]
        own = [{key: value for key, value in one.items() if key not in ("original", "seed")} for one in values]
        return {"original": values[0]["original"], "models": own}

    def _table(self) -> list[list[str]]:
        rows = [["", "elements", "covered", "gap", "excess", "missing", "certified"]]
        for name, one in self.items():
            total = one.total
            numbers = [f"{100 * total.covered:.1f} %", f"{1000 * total.gap_m:.1f} mm"]
            numbers += [f"{total.excess:.2f}", f"{total.missing:.2f}"]
            rows.append([name, str(total.spheres), *numbers, "yes" if one.certified else "no"])
        return rows

    def _repr_html_(self) -> str:
        rows = ["".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in self._table()]
        return f"<table>{''.join(f'<tr>{row}</tr>' for row in rows)}</table>"

    def __repr__(self) -> str:
        table = self._table()
        widths = [max(map(len, column)) for column in zip(*table)]
        return "\n".join("  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths)) for row in table)


class Certificate(_Judged):
    """The proof that spheres cover a geometry (or lie inside it), or where it fails."""

    @property
    def holds(self) -> bool:
        """Whether the proof holds for every link."""
        return bool(self._values["certified"])

    def __bool__(self) -> bool:
        return self.holds

    @property
    def links(self) -> dict[str, bool]:
        """Whether the proof holds, by link."""
        return {link["link"]: link["certified"] for link in self._values["links"]}

    @property
    def witnesses(self) -> dict[str, NDArray[np.float64]]:
        """Where it fails, by link: a point of the geometry outside the spheres (inner: the centre of a sphere that
        protrudes); (3,), metres, in the link's frame."""
        key = "witness_m" if self._values["guarantee"] == "outer" else "center_m"
        return {link["link"]: np.array(link[key], float) for link in self._values["links"] if not link["certified"]}

    def __repr__(self) -> str:
        surfaces = len(self._values["proof"]["as_surface"])
        holds = f"holds, {surfaces} as surfaces" if surfaces else "holds"
        return f"<foam.Certificate: {holds if self.holds else 'fails for ' + ', '.join(self.witnesses)}>"


class _Pair(TypedDict):
    link1: str
    link2: str
    ignored: bool


class Pair(_Pair, total=False):
    """A pair of links: whether it needs a collision check, and why not."""

    reason: Reason
    proved: bool
    samples: int
    contacts: int


class SelfCollision(_Result):
    """The pairs of links that never need a collision check, and why."""

    def __init__(self, values: dict[str, Any], srdf: str, curobo: str) -> None:
        super().__init__(values)
        self._srdf, self._curobo = srdf, curobo

    @property
    def pairs(self) -> list[Pair]:
        """All pairs of links with spheres: link1, link2, ignored, reason, proved, samples, contacts."""
        return list(self._values["pairs"])

    def ignored(self) -> list[tuple[str, str, Reason]]:
        """Return the pairs that need no check: (link, link, "Adjacent", "Always", "Default" or "Never")."""
        return [(p["link1"], p["link2"], p["reason"]) for p in self._values["pairs"] if p["ignored"]]

    def checked(self) -> list[tuple[str, str]]:
        """Return the pairs that need a check."""
        return [(p["link1"], p["link2"]) for p in self._values["pairs"] if not p["ignored"]]

    def to_srdf(self) -> str:
        """Return an SRDF with <disable_collisions>, for MoveIt."""
        return self._srdf

    def to_curobo(self) -> str:
        """Return `self_collision_ignore` (YAML) of cuRobo's robot files."""
        return self._curobo

    def to_xrdf(self) -> dict[str, dict[str, list[str]]]:
        """Return the section `self_collision` of an XRDF: {"ignore": {link: [links]}}."""
        ignore: dict[str, list[str]] = {}
        for first, second, _ in self.ignored():
            ignore.setdefault(first, []).append(second)
        return {"ignore": ignore}

    def __reduce__(self) -> tuple[Any, ...]:
        return SelfCollision, (self._values, self._srdf, self._curobo)

    def __repr__(self) -> str:
        return f"<foam.SelfCollision: {len(self.ignored())} of {len(self.pairs)} pairs need no check>"
