"""Sphere models in a mujoco.MjSpec: frames are compared, the geoms are proved as they stand in the spec."""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import Error, UsageError

if TYPE_CHECKING:
    from ._model import SphereModel

Matrix = NDArray[np.float64]
SAME = 1e-6  # m for a robot of a metre, and rad: poses in files have so many digits
ALIKE = 0.02  # of the size of a link: tessellated cylinders
CONTACT = ("contype", "conaffinity", "condim", "priority", "friction", "solmix", "solref", "solimp", "margin", "gap")


@dataclass
class Frame:
    """How a body stands against its link."""

    pose: Matrix  # 4 × 4, from the link's frame to the body's
    moves: bool  # the body moves otherwise than the link
    free: bool  # another zero of the link's own joint would explain the pose

    def same(self, size: float) -> bool:
        return not self.moves and bool(np.abs(self.pose - np.eye(4)).max() <= SAME * max(1.0, size))

    def text(self) -> str:
        turn = self.pose[:3, :3]
        sine = np.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
        angle = round(float(np.degrees(np.arctan2(sine, (np.trace(turn) - 1) / 2))), 4)
        return f"turned by {angle:.3g}° and moved by {round(1000 * float(np.linalg.norm(self.pose[:3, 3])), 4):.3g} mm"


def add_to_spec(mj: Any, model: SphereModel, text: str | None, spec: Any, bodies: Mapping[str, str], group: int, pairs: Any) -> int:
    """Add the elements of a model to bodies of an MjSpec; return their number. `text`: the robot as MJCF, if it is known."""
    own = mj.MjSpec.from_string(text) if text else _spec_of_spheres(mj, model)
    try:
        compiled = spec.copy().compile()
    except ValueError as error:
        raise UsageError(f"the MjSpec does not compile: {error}; remedy: a spec that does, so that frames can be compared") from None
    frames = _frames(mj, model, own.compile() if text else None, compiled, bodies)
    trial = spec.copy()
    _put(mj, model, own, trial, bodies, frames, group, pairs)
    trial.compile()
    _prove(mj, model, trial, bodies, frames)
    return _put(mj, model, own, spec, bodies, frames, group, pairs)


def _spec_of_spheres(mj: Any, model: SphereModel) -> Any:
    """Return a spec with a body for each link of a model of spheres without robot."""
    spec = mj.MjSpec()
    for link, rows in model.items():
        body = spec.worldbody.add_body(name=link)
        for x, y, z, r in np.asarray(rows).tolist():
            body.add_geom(type=mj.mjtGeom.mjGEOM_SPHERE, pos=[x, y, z], size=[r, 0, 0], mass=0)
    return spec


# --- frames


def _poses(mj: Any, compiled: Any, joints: Mapping[str, float], names: list[str]) -> Matrix:
    """Return the poses of bodies (n × 4 × 4) with joints at values; other joints stand where the model has them."""
    data = mj.MjData(compiled)
    for joint, value in joints.items():
        data.qpos[compiled.joint(joint).qposadr[0]] = value
    mj.mj_kinematics(compiled, data)
    result = np.tile(np.eye(4), (len(names), 1, 1))
    for i, name in enumerate(names):
        result[i, :3, :3] = data.body(name).xmat.reshape(3, 3)
        result[i, :3, 3] = data.body(name).xpos
    return result


def _inverse(pose: Matrix) -> Matrix:
    turned = np.swapaxes(pose[..., :3, :3], -1, -2)
    result = np.zeros_like(pose)
    result[..., :3, :3] = turned
    result[..., :3, 3] = -np.einsum("...ij,...j->...i", turned, pose[..., :3, 3])
    result[..., 3, 3] = 1
    return result


def _joints(mj: Any, compiled: Any) -> set[str]:
    simple = (int(mj.mjtJoint.mjJNT_HINGE), int(mj.mjtJoint.mjJNT_SLIDE))
    return {compiled.joint(i).name for i in range(compiled.njnt) if int(compiled.jnt_type[i]) in simple}


def _frames(mj: Any, model: SphereModel, own: Any, theirs: Any, bodies: Mapping[str, str]) -> dict[str, Frame]:
    """Return the frame of each body against its link. Raises UsageError where it cannot be known."""
    links = list(bodies)
    if own is None:
        warnings.warn("to_mujoco: without a robot nothing says whether bodies have the frames of links", stacklevel=4)
        return {link: Frame(np.eye(4), False, False) for link in links}
    shared = sorted(_joints(mj, own) & _joints(mj, theirs))
    random = np.random.default_rng(0)
    ours, found = [], []
    for number in range(4):  # all at zero first
        values = {joint: float(number and random.uniform(-1, 1)) for joint in shared}
        ours.append(_poses(mj, own, {joint: 0.0 for joint in _joints(mj, own)} | values, links))
        found.append(_poses(mj, theirs, values, [bodies[link] for link in links]))
    a, b = np.array(ours), np.array(found)  # pose × link × 4 × 4
    size = float(np.abs(a[..., :3, 3]).max())
    shapes = {link: _Shape(mj, model, link, own, theirs, bodies[link]) for link in links}
    frames = _of_best_anchor(a, b, links, shapes, size)
    for link, frame in frames.items():
        frame.free = _is_motion_of_joint(mj, own, link, frame.pose)
        _judge(link, bodies[link], frame, shapes[link], size, bool(shared) and len(links) > 1)
    return frames


def _of_best_anchor(a: Matrix, b: Matrix, links: list[str], shapes: Mapping[str, _Shape], size: float) -> dict[str, Frame]:
    """Take that link for one whose body has its frame which leaves the fewest others with another frame."""
    best: tuple[tuple[float, ...], dict[str, Frame]] | None = None
    for anchor in range(len(links)):
        base = b[:, anchor] @ _inverse(a[:, anchor])  # from the robot's frame to the spec's world
        x = _inverse(base[:, None] @ a) @ b
        moves = np.abs(x - x[:1]).max(axis=(0, 2, 3)) > SAME * max(1.0, size)
        frames = {link: Frame(x[0, i], bool(moves[i]), False) for i, link in enumerate(links)}
        odd = [link for link, frame in frames.items() if not frame.same(size)]
        rank = (float(moves.sum()), float(len(odd)), sum(shapes[link].difference(frames[link].pose) or 0.0 for link in links))
        if best is None or rank < best[0]:
            best = rank, frames
    assert best is not None
    return best[1]


def _is_motion_of_joint(mj: Any, own: Any, link: str, pose: Matrix) -> bool:
    body = own.body(link)
    if body.jntnum[0] != 1:
        return False
    axis, turn = own.jnt_axis[body.jntadr[0]], pose[:3, :3]
    along = pose[:3, 3] - axis * (axis @ pose[:3, 3])
    if own.jnt_type[body.jntadr[0]] == int(mj.mjtJoint.mjJNT_SLIDE):
        return bool(np.abs(along).max() < SAME and np.abs(turn - np.eye(3)).max() < SAME)
    return bool(np.abs(pose[:3, 3]).max() < SAME and np.abs(turn @ axis - axis).max() < SAME)


def _judge(link: str, body: str, frame: Frame, shape: _Shape, size: float, related: bool) -> None:
    """Raise UsageError for a body whose frame against its link is not known."""
    where = f"to_mujoco: body '{body}' and link '{link}'"
    remedy = "remedy: give the body the frame of the link, or bodies={…} if it is another link's"
    if frame.moves:
        raise UsageError(
            f"{where} do not move alike: at zero the body is {frame.text()} against the link, in other poses otherwise; {remedy}"
        )
    difference = shape.difference(frame.pose)
    alike = difference is not None and difference <= ALIKE * shape.size
    if frame.same(size):
        frame.pose = np.eye(4)
        if difference is not None and not alike and not related:
            raise UsageError(
                f"{where}: their collision geometry differs by {1000 * difference:.3g} mm, and no joints say whether the body is "
                f"turned against the link; {remedy}"
            )
        return
    mismatch = difference is not None and not alike
    if mismatch or (frame.free and difference is None):
        why = "it has no geoms that confirm it"
        if difference is not None:
            why = f"its geoms differ from the link's by {1000 * difference:.3g} mm"
        raise UsageError(f"{where}: the body is {frame.text()} against the link, and {why}; {remedy}")


# --- shapes: how far the geometry of a link and of a body reach in many directions


def _directions(count: int = 256) -> Matrix:
    i = np.arange(count) + 0.5
    z, angle = 1 - 2 * i / count, np.pi * (1 + 5**0.5) * i
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=1)


class _Shape:
    """The geometry of a link, in its frame, and that of its body, in the body's."""

    def __init__(self, mj: Any, model: SphereModel, link: str, own: Any, compiled: Any, body: str) -> None:
        self.size = 0.0
        self._of_link = [self._geoms(mj, own, link)]  # the elements may be in the spec already
        self._of_body = self._geoms(mj, compiled, body)
        try:
            assert model.robot is not None
            vertices = np.array(model.robot.collision_mesh(link).vertices)
        except Error:  # a link without geometry
            return
        self.size = float(np.ptp(vertices, axis=0).max())
        self._of_link.append(lambda d: (vertices @ d.T).max(axis=0))

    @staticmethod
    def _geoms(mj: Any, compiled: Any, body: str) -> Any:
        """Return how far the geoms of a body reach along directions; those with contact if there are some."""
        first, count = int(compiled.body(body).geomadr[0]), int(compiled.body(body).geomnum[0])
        geoms = list(range(first, first + count))
        geoms = [g for g in geoms if compiled.geom_contype[g] or compiled.geom_conaffinity[g]] or geoms
        flat = (int(mj.mjtGeom.mjGEOM_PLANE), int(mj.mjtGeom.mjGEOM_HFIELD))
        if not geoms or any(int(compiled.geom_type[g]) in flat for g in geoms):
            return None
        return lambda d: np.max([_reach_of_geom(mj, compiled, g, d) for g in geoms], axis=0)

    def difference(self, pose: Matrix) -> float | None:
        """Return the largest difference of both in any direction, m, if the body stands so; None if one is not known."""
        if self._of_body is None:
            return None
        directions = _directions()  # of the link's frame
        of_body = self._of_body(directions @ pose[:3, :3]) + directions @ pose[:3, 3]
        return min((float(np.abs(reach(directions) - of_body).max()) for reach in self._of_link if reach), default=None)


def _reach_of_geom(mj: Any, compiled: Any, geom: int, directions: Matrix) -> Matrix:
    """Return the largest coordinate of a geom along directions of its body's frame."""
    turn = np.zeros(9)
    mj.mju_quat2Mat(turn, compiled.geom_quat[geom])
    d = directions @ turn.reshape(3, 3)
    size, kind, shape = compiled.geom_size[geom], mj.mjtGeom(int(compiled.geom_type[geom])), mj.mjtGeom
    if kind == shape.mjGEOM_SPHERE:
        own = np.full(len(d), size[0])
    elif kind == shape.mjGEOM_CAPSULE:
        own = size[0] + size[1] * np.abs(d[:, 2])
    elif kind == shape.mjGEOM_CYLINDER:
        own = size[0] * np.hypot(d[:, 0], d[:, 1]) + size[1] * np.abs(d[:, 2])
    elif kind == shape.mjGEOM_BOX:
        own = np.abs(d) @ size
    elif kind == shape.mjGEOM_ELLIPSOID:
        own = np.linalg.norm(d * size, axis=1)
    else:
        mesh = compiled.geom_dataid[geom]
        first = compiled.mesh_vertadr[mesh]
        own = np.asarray(d @ compiled.mesh_vert[first : first + compiled.mesh_vertnum[mesh]].T).max(axis=1)
    return np.asarray(directions @ compiled.geom_pos[geom] + own)


# --- geoms


def _put(
    mj: Any, model: SphereModel, own: Any, spec: Any, bodies: Mapping[str, str], frames: Mapping[str, Frame], group: int, pairs: Any
) -> int:  # fmt: skip
    """Add the geoms, switch the old ones off, add the pairs."""
    known = {body.name: body for body in spec.bodies}
    taken = {geom.name for geom in spec.geoms} | {mesh.name for mesh in spec.meshes}
    vertices = {mesh.name: mesh.uservert for mesh in own.meshes}
    count = 0

    def fresh(name: str) -> str:
        number = count
        while f"{name}_{number}" in taken:
            number += 1
        taken.add(f"{name}_{number}")
        return f"{name}_{number}"

    off = set()
    for link, body in bodies.items():
        old = [geom for geom in known[body].geoms if geom.contype or geom.conaffinity]
        contact = {key: getattr(old[0], key) for key in CONTACT} if old else {"contype": 1, "conaffinity": 1}
        contact = {key: np.array(value) if isinstance(value, np.ndarray) else value for key, value in contact.items()}
        for geom in old:
            off.add(geom.name)
            geom.contype = geom.conaffinity = 0
        for geom in own.body(link).geoms:
            if not (geom.contype or geom.conaffinity):
                continue
            kind = geom.type.name.removeprefix("mjGEOM_").lower()
            values: dict[str, Any] = {"type": geom.type, "group": group, "mass": 0, "name": fresh(f"{link}_{kind}")}
            if kind == "mesh":
                mesh = spec.add_mesh(name=fresh("foam_hull"), uservert=np.array(vertices[geom.meshname]).ravel())
                values["meshname"] = mesh.name
            values |= dict(zip(("pos", "quat", "size"), _placed(mj, geom, frames[link].pose), strict=True))
            known[body].add_geom(**values, **contact)
            count += 1
    still = [pair for pair in spec.pairs if {pair.geomname1, pair.geomname2} & off - {""}]
    named = [pair.name or f"{pair.geomname1} and {pair.geomname2}" for pair in still]
    if named:
        warnings.warn(f"to_mujoco: <pair> elements still name geoms that are switched off: {', '.join(named)}", stacklevel=4)
    excluded = {frozenset((one.bodyname1, one.bodyname2)) for one in spec.excludes}
    for first, second, *_ in pairs or ():
        if first in bodies and second in bodies and frozenset((bodies[first], bodies[second])) not in excluded:
            spec.add_exclude(bodyname1=bodies[first], bodyname2=bodies[second])
    return count


def _placed(mj: Any, geom: Any, pose: Matrix) -> tuple[Any, Any, Any]:
    """Return position, quaternion and size of a geom of the link in the body's frame; a little larger where it is moved."""
    pos, quat, size = np.array(geom.pos), np.array(geom.quat), np.array(geom.size)
    if np.array_equal(pose, np.eye(4)):
        return pos, quat, size
    into = _inverse(pose)
    turn, placed = np.zeros(4), np.zeros(4)
    mj.mju_mat2Quat(turn, into[:3, :3].ravel())
    mj.mju_mulQuat(placed, turn, quat)
    if geom.type != mj.mjtGeom.mjGEOM_MESH:  # a hull's corners lie further outside than poses are rounded
        size = np.where(size > 0, size + 1e-9 * max(1.0, float(np.abs(pos).max())), size)
    return into[:3, :3] @ pos + into[:3, 3], placed, size


# --- proof


def _prove(mj: Any, model: SphereModel, spec: Any, bodies: Mapping[str, str], frames: Mapping[str, Frame]) -> None:
    """Prove the geoms of the spec, in the frames of the links: all that is proved of the model must hold of them."""
    if model.robot is None:
        return
    robot = model.robot._core
    spheres: list[tuple[str, Matrix]] = []
    others: list[tuple[str, list[Any]]] = []
    vertices = {mesh.name: mesh.uservert for mesh in spec.meshes}
    for link, body in bodies.items():
        rows: list[list[float]] = []
        rest: list[Any] = []
        for geom in spec.body(body).geoms:
            if geom.contype or geom.conaffinity:
                element = _element(mj, geom, frames[link].pose, vertices)
                if element["kind"] == "sphere":
                    rows.append([*element["position"], element["radius"]])
                else:
                    rest.append(element)
        spheres.append((link, np.array(rows, float).reshape(-1, 4)))
        if rest:
            others.append((link, rest))
    read = _core.SphereFile(spheres, "MjSpec", others)

    def proved(file: _core.SphereFile) -> set[str]:
        return {one["link"] for one in json.loads(_core.certify(robot, file, [], True))["links"] if one["certified"]}

    lost = sorted((proved(model._sphere_file()) & set(bodies)) - proved(read))
    if lost:
        raise Error(f"to_mujoco: the geoms of the MjSpec are not proved to cover {', '.join(lost)}, the model is; nothing was changed")


def _element(mj: Any, geom: Any, pose: Matrix, vertices: Mapping[str, Any]) -> dict[str, Any]:
    """Return a geom of a body as an element of its link."""
    turn = np.zeros(9)
    mj.mju_quat2Mat(turn, np.array(geom.quat))
    rotation = pose[:3, :3] @ turn.reshape(3, 3)
    position = pose[:3, :3] @ geom.pos + pose[:3, 3]
    shape, size = mj.mjtGeom, geom.size
    placed = {"position": position.tolist(), "rotation": rotation.tolist()}
    if geom.type == shape.mjGEOM_SPHERE:
        return {"kind": "sphere", "position": position.tolist(), "radius": float(size[0])}
    if geom.type == shape.mjGEOM_BOX:
        return {"kind": "box", **placed, "size": (2 * size).tolist()}
    if geom.type == shape.mjGEOM_ELLIPSOID:
        return {"kind": "ellipsoid", **placed, "radii": size.tolist()}
    if geom.type == shape.mjGEOM_MESH:
        corners = np.array(vertices[geom.meshname], float).reshape(-1, 3) @ rotation.T + position
        return {"kind": "hull", "vertices": corners.tolist()}
    kind = {shape.mjGEOM_CAPSULE: "capsule", shape.mjGEOM_CYLINDER: "cylinder"}[geom.type]
    return {"kind": kind, **placed, "radius": float(size[0]), "length": 2 * float(size[1])}
