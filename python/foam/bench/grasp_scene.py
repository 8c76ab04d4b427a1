"""A robot, a plane and an object to grasp, in MuJoCo's format (MJCF)."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._robot import Joint, Robot

_DENSITY = 1000  # kg/m³, of the links
_MOVING = {"revolute": "hinge", "continuous": "hinge", "prismatic": "slide"}


@dataclass(frozen=True)
class _Servo:
    """Position control of a joint."""

    stiffness: float  #: N/m; N m/rad
    damping: float  #: N s/m; N m s/rad
    limit: float  #: N; N m


_ARM, _FINGER = _Servo(10000, 200, 500), _Servo(5000, 100, 20)


@dataclass
class GraspObject:
    """A box that stands on the plane z = 0 of the robot's root, its edges along the axes."""

    size: Sequence[float] = (0.03, 0.03, 0.1)  #: m
    position: Sequence[float] = (0.5, 0, 0)  #: m; of the middle of its bottom face
    mass: float = 0.1  #: kg

    @property
    def center(self) -> list[float]:
        """The centre at the beginning, m."""
        return [*self.position[:2], self.position[2] + self.size[2] / 2]


@dataclass
class Setup:
    """What a scene needs beside the robot."""

    object: GraspObject
    excluded: Sequence[tuple[str, str]]  #: pairs of links that are not checked against each other
    object_ignores: Sequence[str]  #: links that do not collide with the object
    fingers: Sequence[str]  #: the joints above them press with the force of a gripper
    timestep: float  #: s


def moving(robot: Robot) -> list[Joint]:
    """Return the joints that move, in the order of a scene's controls and of its positions: from the root on."""
    below: dict[str, list[Joint]] = {}
    order = {link: index for index, link in enumerate(robot.links)}
    for joint in sorted(robot.joints, key=lambda joint: order[joint.child]):
        below.setdefault(joint.parent, []).append(joint)
    found, left = [], list(reversed(below.get(robot.root, [])))
    while left:
        joint = left.pop()
        found += [joint] if joint.kind in _MOVING else []
        left += reversed(below.get(joint.child, []))
    return found


def grasp_scene(robot: Robot, spheres: Mapping[str, NDArray[Any]], setup: Setup) -> str:
    """Return the MJCF. The object's body is called "object", links have their names.

    `spheres`: rows of x, y, z, r by link; empty: links collide as the convex hulls of their parts, as MuJoCo takes meshes.
    Masses and inertias are those of the solids in either case.
    """
    return _Writer(robot, spheres, setup).text()


def _numbers(values: ArrayLike) -> str:
    """Numbers with all their digits; without negative zeros."""
    return " ".join(repr(float(value) + 0.0) for value in np.ravel(values))


def _placed(position: ArrayLike, rotation: ArrayLike) -> dict[str, str]:
    """A place by the frame's x and y axes: MJCF's way to say a rotation by its matrix."""
    return {"pos": _numbers(position), "xyaxes": _numbers(np.asarray(rotation)[:, :2].T)}


class _Writer:
    def __init__(self, robot: Robot, spheres: Mapping[str, NDArray[Any]], setup: Setup) -> None:
        self.robot, self.spheres, self.setup = robot, spheres, setup
        self.joints = robot.joints
        self.root = ET.Element("mujoco")
        self.assets, self.world = ET.Element("asset"), ET.Element("worldbody")
        self.actuators = ET.Element("actuator")

    def text(self) -> str:
        """Return the whole scene."""
        setup, add = self.setup, ET.SubElement
        add(self.root, "compiler", angle="radian")
        add(self.root, "option", timestep=repr(setup.timestep), cone="elliptic", impratio="10")
        add(self.root, "size", nconmax="100", njmax="300")
        add(add(self.root, "default"), "geom", condim="4", friction="1 0.02 0.001")
        add(self.world, "geom", type="plane", size="5 5 0.1")
        self._body(self.robot.root, None, self.world)
        box = add(self.world, "body", name="object", pos=_numbers(setup.object.center))
        add(box, "freejoint")
        add(box, "geom", type="box", size=_numbers(np.divide(setup.object.size, 2)), mass=repr(setup.object.mass))
        contact = ET.Element("contact")
        for first, second in [*setup.excluded, *((link, "object") for link in setup.object_ignores)]:
            add(contact, "exclude", body1=first, body2=second)
        self.root.extend([self.assets, self.world, contact, self.actuators])
        return ET.tostring(self.root, "unicode")

    def _body(self, link: str, joint: Joint | None, parent: ET.Element) -> None:
        place = _placed(joint.xyz, joint.rotation) if joint else _placed([0, 0, 0], np.eye(3))
        body = ET.SubElement(parent, "body", {"name": link, **place})
        solid = link in self._with_geometry()
        ET.SubElement(body, "inertial", self._inertia(link) if solid else _WEIGHTLESS)
        if joint and joint.kind in _MOVING:
            self._joint(body, joint, _FINGER if link in self.setup.fingers else _ARM)
        if solid:
            self._geometry(body, link)
        order = {name: index for index, name in enumerate(self.robot.links)}
        for below in sorted((j for j in self.joints if j.parent == link), key=lambda j: order[j.child]):
            self._body(below.child, below, body)

    def _with_geometry(self) -> list[str]:
        return self.robot.links_with_geometry

    def _joint(self, body: ET.Element, joint: Joint, servo: _Servo) -> None:
        ET.SubElement(body, "joint", name=joint.name, type=_MOVING[joint.kind], axis=_numbers(joint.axis),
                      damping=repr(servo.damping), armature="0.1")  # fmt: skip
        ET.SubElement(self.actuators, "position", joint=joint.name, kp=repr(servo.stiffness), forcelimited="true",
                      forcerange=f"-{servo.limit!r} {servo.limit!r}")  # fmt: skip

    def _inertia(self, link: str) -> dict[str, str]:
        """The inertia of a box of the bounds' size, with the mass of the solid."""
        mesh = self.robot.collision_mesh(link)
        mass = max(_DENSITY * mesh.volume, 0.01)
        low, high = mesh.bounds
        squares = (high - low) ** 2
        inertia = np.maximum(mass / 12 * (squares.sum() - squares), 1e-6)
        return {"pos": _numbers((low + high) / 2), "mass": repr(mass), "diaginertia": _numbers(inertia)}

    def _geometry(self, body: ET.Element, link: str) -> None:
        for x, y, z, r in self.spheres.get(link, ()):
            ET.SubElement(body, "geom", type="sphere", size=_numbers(r), pos=_numbers([x, y, z]))
        if link not in self.spheres:
            for part in self.robot._core.parts(link):
                ET.SubElement(body, "geom", self._part(part))

    def _part(self, part: Mapping[str, Any]) -> dict[str, str]:
        if part["kind"] == "mesh":
            name = f"m{len(self.assets)}"
            ET.SubElement(self.assets, "mesh", name=name, vertex=_numbers(np.asarray(part["mesh"].vertices())))
            return {"type": "mesh", "mesh": name}
        if part["kind"] == "box":
            sizes = [edge / 2 for edge in part["size"]]
        else:
            sizes = [part["radius"], *([part["length"] / 2] if "length" in part else [])]
        return {"type": part["kind"], "size": _numbers(sizes), **_placed(part["position"], part["rotation"])}


_WEIGHTLESS = {"pos": "0 0 0", "mass": "0.01", "diaginertia": "1e-5 1e-5 1e-5"}
