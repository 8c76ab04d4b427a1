"""Robots for the tests of programs that read URDF, and what a written file says, read with nothing of foam."""
import functools
import math
import os
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

SOURCE = Path(os.environ["FOAM_TEST_SOURCE"])
KINDS = ["sphere", "capsule", "cylinder", "box", "swept_box", "hull"]


def box(size, xyz="0 0 0", rpy="0 0 0"):
    return f'<collision><origin xyz="{xyz}" rpy="{rpy}"/><geometry><box size="{size}"/></geometry></collision>'


def rod(radius, length, xyz="0 0 0", rpy="0 0 0"):
    shape = f'<cylinder radius="{radius}" length="{length}"/>'
    return f'<collision><origin xyz="{xyz}" rpy="{rpy}"/><geometry>{shape}</geometry></collision>'


def link(name, *collisions):
    inertia = '<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/>'
    inertial = f'<inertial><origin xyz="0.01 0.02 0.03"/><mass value="1"/>{inertia}</inertial>'
    return f'<link name="{name}">{inertial}{"".join(collisions)}</link>'


def joint(name, parent, child, xyz, axis, rpy="0 0 0", more="", kind="revolute"):
    limit = '<limit lower="-0.7" upper="0.9" effort="10" velocity="2"/>'
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>{limit}{more}</joint>'
    )


def text_of(name, parts):
    """Return the URDF, an element a line: PyBullet breaks lines of more than 8191 bytes."""
    return "\n".join([f'<robot name="{name}">', *parts, "</robot>"])


def hand():
    """Return a hand of three fingers, whose outer joints follow the inner ones."""
    parts = [link("palm", box("0.1 0.08 0.03"), rod(0.03, 0.05, "0 0 -0.04"))]
    for i, angle in enumerate((0.0, 2.1, 4.2)):
        at = f"{0.04 * math.cos(angle):.6f} {0.04 * math.sin(angle):.6f} 0.015"
        follow = f'<mimic joint="inner_{i}" multiplier="0.8" offset="0.1"/>'
        parts += [link(f"proximal_{i}", rod(0.01, 0.05, "0 0 0.025")), link(f"distal_{i}", rod(0.008, 0.04, "0 0 0.02", "0.2 0 0"))]
        parts += [joint(f"inner_{i}", "palm", f"proximal_{i}", at, "0 1 0", f"0 0 {angle}")]
        parts += [joint(f"outer_{i}", f"proximal_{i}", f"distal_{i}", "0 0 0.05", "0 1 0", more=follow)]
    return text_of("hand", parts)


def walker():
    """Return a robot with four legs of three links each."""
    parts = [link("trunk", box("0.5 0.25 0.1"), box("0.1 0.1 0.1", "0.28 0 0.05"))]
    for x in (-1, 1):
        for y in (-1, 1):
            leg = f"{'fr'[x < 0]}{'lr'[y < 0]}"
            parts += [link(f"{leg}_hip", rod(0.04, 0.06, f"0 {0.02 * y} 0", "1.5707963267948966 0 0"))]
            parts += [link(f"{leg}_thigh", box("0.04 0.03 0.2", "0 0 -0.1"))]
            parts += [link(f"{leg}_shank", rod(0.015, 0.2, "0 0 -0.1", "0 0.05 0"), box("0.03 0.03 0.03", "0 0 -0.2"))]
            parts += [joint(f"{leg}_a", "trunk", f"{leg}_hip", f"{0.2 * x} {0.12 * y} 0", "1 0 0")]
            parts += [joint(f"{leg}_b", f"{leg}_hip", f"{leg}_thigh", f"0 {0.05 * y} 0", "0 1 0", "0 0.4 0")]
            parts += [joint(f"{leg}_c", f"{leg}_thigh", f"{leg}_shank", "0 0 -0.2", "0 -1 0", "0 -0.8 0")]
    return text_of("walker", parts)


def robots(folder):
    """Write the hand and the walker; return the files of the three robots."""
    (folder / "hand.urdf").write_text(hand())
    (folder / "walker.urdf").write_text(walker())
    return [SOURCE / "configs/robots/panda/panda.urdf", folder / "hand.urdf", folder / "walker.urdf"]


def written(robot, kind, folder, *options):
    """Return the URDF that foam writes: one element a link, or two where links are simple."""
    folder.mkdir(parents=True, exist_ok=True)
    links = len(ET.parse(robot).getroot().findall("link"))
    file = folder / f"{robot.stem}_{kind}.urdf"
    each = 1 if robot.stem == "panda" or kind == "hull" else 2  # one element is the hull itself
    foam("approximate", robot, "--with", kind, "-n", each * links, "--effort", "fast", "-o", file, *options)
    return file


def foam(*words):
    """Run foam."""
    done = started(*words)
    assert done.returncode == 0, done.stderr


def refused(*words):
    """Run foam, which refuses; return what it says."""
    done = started(*words)
    assert done.returncode != 0
    return done.stderr


def started(*words):
    words = [os.environ["FOAM_TEST_BINARY"], *map(str, words)]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def numbers(element, name, default=""):
    return np.array([float(word) for word in element.get(name, default).split()])


def about(axis, angle):
    """Return the rotation by Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


@functools.cache
def pose(element):
    """Return the matrix of an <origin>; the identity for none."""
    result = np.eye(4)
    if element is not None:
        roll, pitch, yaw = numbers(element, "rpy", "0 0 0")
        result[:3, :3] = about((0, 0, 1), yaw) @ about((0, 1, 0), pitch) @ about((1, 0, 0), roll)
        result[:3, 3] = numbers(element, "xyz", "0 0 0")
    return result


class Truth:
    """What a URDF says: its joints, and the collision elements of each link."""

    def __init__(self, file):
        root = ET.parse(file).getroot()
        self.joints = root.findall("joint")
        children = {joint.find("child").get("link") for joint in self.joints}
        self.root = next(link.get("name") for link in root.findall("link") if link.get("name") not in children)
        self.elements = {}  # by link: word, numbers by name, pose
        for link_element in root.findall("link"):
            for collision in link_element.findall("collision"):
                shape = collision.find("geometry")[0]
                found = shape.tag, {name: numbers(shape, name) for name in shape.keys() if name != "filename"}
                self.elements.setdefault(link_element.get("name"), []).append((*found, pose(collision.find("origin"))))

    def count(self):
        return sum(map(len, self.elements.values()))

    def free_joints(self):
        """Return the joints that move and follow no other, with their limits."""
        limits = {}
        for element in self.joints:
            if element.get("type") != "fixed" and element.find("mimic") is None:
                limit = element.find("limit")
                limits[element.get("name")] = (float(limit.get("lower")), float(limit.get("upper")))
        return limits

    def random_values(self, random):
        return {name: random.uniform(low, high) for name, (low, high) in self.free_joints().items()}

    def all_values(self, values):
        """Return the values with those of joints that follow."""
        result = dict(values)
        for element in self.joints:
            if (mimic := element.find("mimic")) is not None:
                turned = float(mimic.get("multiplier", 1)) * values[mimic.get("joint")]
                result[element.get("name")] = turned + float(mimic.get("offset", 0))
        return result

    def link_poses(self, values):
        values = self.all_values(values)
        poses = {self.root: np.eye(4)}
        left = list(self.joints)
        while left:
            for element in list(left):
                parent = element.find("parent").get("link")
                if parent in poses:
                    moved = np.eye(4)
                    value, axis = values.get(element.get("name"), 0.0), element.find("axis")
                    if element.get("type") in ("revolute", "continuous"):
                        moved[:3, :3] = about(numbers(axis, "xyz"), value)
                    elif element.get("type") == "prismatic":
                        moved[:3, 3] = numbers(axis, "xyz") * value
                    poses[element.find("child").get("link")] = poses[parent] @ pose(element.find("origin")) @ moved
                    left.remove(element)
        return poses

    def element_poses(self, values):
        """Return the poses of the elements of each link in the frame of the root."""
        links = self.link_poses(values)
        return {name: [links[name] @ at for _, _, at in elements] for name, elements in self.elements.items()}


def in_a_row(by_link):
    """Return what is told by link without the links."""
    return [one for found in by_link.values() for one in found]


@functools.cache
def poses(file):
    """Return ten random poses: the values of joints that follow no other, and the poses of the elements of each link."""
    truth, random = Truth(file), np.random.default_rng(7)
    return [(values, truth.element_poses(values)) for values in (truth.random_values(random) for _ in range(10))]
