# The C++ module; private. The public functions are those of foam.
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._elements import Element, ShapedElement
from ._words import Kind

KINDS: dict[Kind, tuple[str, ...]]

class Rows:
    def __buffer__(self, flags: int) -> memoryview: ...

class Mesh:
    def __init__(self, vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> None: ...
    def vertices(self) -> Rows: ...
    def faces(self) -> Rows: ...
    def volume(self) -> float: ...
    def area(self) -> float: ...
    def is_watertight(self) -> bool: ...
    def balls(self) -> Rows | None: ...

class Registry:
    def __init__(self, folders: Sequence[str | os.PathLike[str]]) -> None: ...

def load_mesh(file: str, registry: Registry, unit: str | None, scale: float) -> Mesh: ...
def cover(
    mesh: Mesh,
    counts: Sequence[int],
    alone: bool,
    kinds: Sequence[str],
    effort: str,
    objective: str,
    seed: int,
    max_vertices: int,
    axis_aligned: bool,
    time_limit: float | None,
    covers: str,
    progress: Callable[..., object] | None,
) -> list[tuple[Rows, list[ShapedElement], bool, float]]: ...
def mesh_of_balls(rows: NDArray[np.float64]) -> Mesh: ...
def proved_least(mesh: Mesh, kind: str, tolerance: float) -> tuple[Element, float, float]: ...
def mesh_of_elements(elements: Sequence[Element]) -> Mesh: ...
def spheres_inside(mesh: Mesh, spheres: int, time_limit: float | None) -> Rows: ...
def volumes_of_elements(mesh: Mesh, elements: Sequence[Element]) -> tuple[float, float]: ...
def volumes_of_spheres(mesh: Mesh, spheres: NDArray[np.float64], volume: float) -> tuple[float, float]: ...
def version() -> str: ...
def thread_count() -> int: ...
def limit_threads(count: int) -> None: ...

class Robot:
    def __init__(
        self,
        file: str,
        registry: Registry,
        unit: str | None,
        scale: float,
        geometry: str,
        links: Sequence[str],
        package_path: Sequence[str],
        name: str,
    ) -> None: ...
    def name(self) -> str: ...
    def root(self) -> str: ...
    def notes(self) -> list[str]: ...
    def links(self, with_geometry: bool) -> list[str]: ...
    def joints(self) -> list[tuple[Any, ...]]: ...
    def mesh(self, link: str) -> Mesh: ...
    def parts(self, link: str) -> list[dict[str, Any]]: ...
    def chosen_links(
        self, keep: Sequence[str], skip: Sequence[str], weights: Sequence[tuple[str, float]]
    ) -> list[tuple[str, bool, float | None]]: ...
    def joint_values(self, values: Mapping[str, float]) -> list[float]: ...

class SphereFile:
    def __init__(
        self,
        links: Sequence[tuple[str, NDArray[np.float64]]],
        name: str,
        elements: Sequence[tuple[str, Sequence[Element]]] = ...,
    ) -> None: ...
    def links(self) -> list[tuple[str, Rows]]: ...
    def elements(self) -> list[tuple[str, list[ShapedElement]]]: ...
    def format(self) -> str: ...
    def notes(self) -> list[str]: ...

class Model:
    def spheres(self) -> SphereFile: ...

class Facts:
    def __init__(
        self,
        base_link: str,
        tool_frames: Sequence[str],
        lock_joints: Mapping[str, float],
        default_pose: Mapping[str, float],
    ) -> None: ...

class Recipes:
    def __init__(
        self,
        registry: Registry,
        file: str | None,
        text: str,
        name: str,
        settings: Sequence[tuple[str, str]],
        variants: Sequence[str],
    ) -> None: ...
    def names(self) -> list[str]: ...
    def run(
        self,
        index: int,
        out: str | None,
        fresh: bool,
        time_limit: float | None,
        program: str,
        cache: str | None,
        progress: Callable[..., object] | None,
        robot: Robot | None,
    ) -> tuple[str, Model]: ...

def read_spheres(file: str, registry: Registry, reader: str, rename: Sequence[tuple[str, str]]) -> SphereFile: ...
def evaluate(robot: Robot, spheres: SphereFile, rename: Sequence[tuple[str, str]], seed: int) -> str: ...
def certify(robot: Robot, spheres: SphereFile, rename: Sequence[tuple[str, str]], outer: bool) -> str: ...
def self_collision(
    robot: Robot,
    spheres: SphereFile | None,
    per_link: int,
    words: str,
    reference: Mapping[str, float],
    samples: int,
    confidence: float,
    seed: int,
    proof_boxes: int,
) -> tuple[str, str, str]: ...
def check(
    registry: Registry, file: str | None, text: str, settings: Sequence[tuple[str, str]], variants: Sequence[str]
) -> str: ...
def stages(registry: Registry) -> str: ...
def plugins(registry: Registry) -> str: ...
def plugin_folders() -> list[os.PathLike[str]]: ...
def written(
    registry: Registry,
    spheres: SphereFile,
    robot: Robot | None,
    of_run: Model | None,
    file: str,
    format: str,
    into: tuple[str, str] | None,
    parameters: Mapping[str, Any],
    facts: Facts,
) -> tuple[list[tuple[os.PathLike[str], bytes]], list[str]]: ...
def quick_recipe(
    input: str,
    method: str,
    kinds: Sequence[str] | None,
    count: int | None,
    excess: float | None,
    max_protrusion: float | None,
    cost: float | None,
    costs: Mapping[str, float],
    objective: str,
    unit: str | None,
    scale: float,
    geometry: str,
    registry: Registry,
) -> tuple[str, str, list[str], str]: ...
def collect_batch(folder: str, table: str) -> None: ...
def read_batch_table(table: str) -> bytes: ...
def levels_by(
    mesh: Mesh,
    processed: Mesh | None,
    registry: Registry,
    stage: str,
    parameters: Mapping[str, Any],
    counts: Sequence[int],
    seed: int,
) -> list[tuple[Rows, bool, float, float, float]]: ...
def filtered(mesh: Mesh, registry: Registry, stage: str, parameters: Mapping[str, Any]) -> Mesh: ...
def loaded(file: str, registry: Registry, stage: str, parameters: Mapping[str, Any]) -> Mesh: ...
def covering(
    mesh: Mesh, processed: Mesh | None, registry: Registry, stage: str, parameters: Mapping[str, Any], count: int
) -> int: ...
def resolve(reference: str, base: str) -> tuple[os.PathLike[str], list[os.PathLike[str]]]: ...
def plain_pixels(spheres: SphereFile, robot: Robot | None, width: int, height: int) -> bytes: ...
def picture(
    registry: Registry, spheres: SphereFile, robot: Robot | None, title: str, width: int, height: int
) -> bytes: ...
def side_by_side(
    registry: Registry,
    panels: Sequence[tuple[str, Robot, SphereFile | None]],
    pose: Mapping[str, float],
    title: str,
    width: int,
    height: int,
    renderer: str,
    parameters: Mapping[str, Any],
) -> bytes: ...
def declare_spherizer(
    name: str,
    summary: str,
    function: Callable[..., Any],
    original_only: bool,
    revision: int,
    parameters: Mapping[str, Any],
) -> None: ...
def own_stages() -> list[str]: ...
