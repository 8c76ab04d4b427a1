"""The words that arguments take and results have, for type checkers."""

from typing import Literal

#: What form an element has; `foam.KINDS` has the numbers of each.
Kind = Literal["sphere", "capsule", "cylinder", "box", "swept_box", "hull", "ellipsoid"]
#: How long a search takes.
Effort = Literal["fast", "normal", "best"]
#: What a search minimises.
Objective = Literal["excess", "protrusion", "mean_protrusion", "radius"]
#: What of a region is covered.
Covers = Literal["solid", "surface"]
#: What a proof is of: the spheres cover the geometry, or lie inside it.
Proof = Literal["outer", "inner"]
#: What of a robot is covered.
Geometry = Literal["collision", "visual", "both", "collision-or-visual"]
#: What is known of a pair of links that needs no collision check.
Reason = Literal["Adjacent", "Always", "Default", "Never"]
#: The kinds of joints.
JointKind = Literal["fixed", "revolute", "continuous", "prismatic", "planar", "floating"]
#: What an event of a run says.
EventKind = Literal[
    "run_started", "input_loaded", "task_started", "task_finished", "progress", "finding", "run_finished"
]
#: How much a finding matters.
Severity = Literal["debug", "info", "warning", "error"]
