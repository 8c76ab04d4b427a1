"""Types of other packages, for annotations; those of packages that are not installed are Any to type checkers."""

# mypy: ignore-missing-imports, disable-error-code="import"
from mujoco import MjSpec as MjSpec
from trimesh import Trimesh as Trimesh
