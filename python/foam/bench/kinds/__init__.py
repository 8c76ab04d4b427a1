"""The kinds of experiments. A new kind is a class derived from Experiment, and a name here."""

from __future__ import annotations

from ..experiment import Experiment
from .collision_queries import CollisionQueries
from .element_checks import ElementChecks
from .fidelity import Fidelity
from .program_against_size import ProgramAgainstSize
from .quality_against_spheres import QualityAgainstSpheres
from .throughput import Throughput
from .time_against_triangles import TimeAgainstTriangles

_ALL: list[type[Experiment]] = [
    TimeAgainstTriangles,
    ProgramAgainstSize,
    QualityAgainstSpheres,
    CollisionQueries,
    ElementChecks,
    Fidelity,
    Throughput,
]

KINDS = {kind.kind: kind for kind in _ALL}
