"""Write the C++ struct that VAMP's headers expect of a robot, from the sphere URDF and SRDF of foam's write.vamp.

cricket, which makes VAMP's own, is not on PyPI. This does what its output does: forward kinematics with all constants
folded, a bounding sphere of each link before its spheres, and the pairs of links that the SRDF leaves.
"""
import itertools
import xml.etree.ElementTree as ET

import numpy as np
import urdf_truth

HEAD = """#pragma once
#include <vamp/vector.hh>
#include <vamp/vector/math.hh>
#include <vamp/collision/environment.hh>
#include <vamp/collision/validity.hh>

struct {name} {{
    static constexpr std::size_t dimension = {joints}, n_spheres = {spheres}, resolution = 32;
    using Configuration = vamp::FloatVector<dimension>;
    template <std::size_t rake> using ConfigurationBlock = vamp::FloatVector<rake, dimension>;
    template <std::size_t rake> struct Spheres {{ vamp::FloatVector<rake, n_spheres> x, y, z, r; }};
"""
CENTRES = """
    template <std::size_t rake>
    static void sphere_fk(const ConfigurationBlock<rake> &q, Spheres<rake> &out) noexcept {
        using V = vamp::FloatVector<rake, 1>;
"""
CHECK = """
    template <std::size_t rake>
    static bool fkcc(const vamp::collision::Environment<vamp::FloatVector<rake>> &e, const ConfigurationBlock<rake> &q) noexcept {
        using V = vamp::FloatVector<rake, 1>;
"""
IN_SCENE, TOUCH = "vamp::sphere_environment_in_collision", "vamp::sphere_sphere_self_collision<V>"


class Sums:
    """C++ statements of sums and products. A term is a number or the name of a variable; numbers are folded."""

    def __init__(self):
        self.lines = []

    def name(self, text):
        self.lines.append(f"        const V v{len(self.lines)} = {text};")
        return f"v{len(self.lines) - 1}"

    def total(self, products):
        """Return the sum of products of two terms each."""
        constant, words = 0.0, []
        for a, b in products:
            if isinstance(a, str) and isinstance(b, str):
                words.append(f"{a} * {b}")
                continue
            number, other = (b, a) if isinstance(a, str) else (a, b)
            if isinstance(other, float):
                constant += number * other
            elif abs(number) > 1e-11:  # half turns of a URDF have cosines of 1e-12, which cricket keeps
                words.append(other if number == 1 else f"({number!r}f) * {other}")
        if not words:
            return constant
        text = " + ".join(([f"({constant!r}f)"] if constant else []) + words)
        return text if text.isidentifier() else self.name(text)

    def product(self, a, b):
        """Return the product of two 4x4 matrices, of which the last row is 0 0 0 1."""
        rows = [[self.total((a[i][k], b[k][j]) for k in range(4)) for j in range(4)] for i in range(3)]
        return [*rows, [0.0, 0.0, 0.0, 1.0]]

    def placed(self, pose, centre):
        return [self.total(zip(pose[i], [*map(float, centre), 1.0])) for i in range(3)]


def rounded(matrix):
    """Return a matrix of floats, with 0, 1 and -1 where rounding of a quarter turn left something else."""
    near = np.round(matrix)
    return np.where(abs(matrix - near) < 1e-11, near, matrix).tolist()


def turned(sums, axis, number):
    """Return the rotation about an axis by a joint's value: Rodrigues' formula in terms."""
    sine, cosine = sums.name(f"q[{number}].sin()"), sums.name(f"q[{number}].cos()")
    one = np.eye(3)
    along = np.outer(axis, axis)
    across = np.cross(axis, np.eye(3)).T
    matrix = [[0.0] * 4 for _ in range(3)] + [[0.0, 0.0, 0.0, 1.0]]
    for i, j in itertools.product(range(3), repeat=2):
        terms = [(float(one[i, j] - along[i, j]), cosine), (float(across[i, j]), sine), (float(along[i, j]), 1.0)]
        matrix[i][j] = sums.total(terms)
    return matrix


def bounding(centres, radii):
    """Return a sphere around spheres, near the smallest: its centre walks towards the farthest (Badoiu, Clarkson 2003)."""
    centre = centres.mean(axis=0)
    for step in range(2, 2000):
        reach = np.linalg.norm(centres - centre, axis=1) + radii
        far = reach.argmax()
        away = centres[far] - centre
        if (length := np.linalg.norm(away)) > 0:
            centre = centre + away / length * reach[far] / step
    return centre, (np.linalg.norm(centres - centre, axis=1) + radii).max()


def disabled(srdf):
    return {frozenset((one.get("link1"), one.get("link2"))) for one in ET.parse(srdf).getroot().iter("disable_collisions")}


class Robot:
    """A sphere URDF and its SRDF: `text` is the struct; `links` are those with spheres, `pairs` those of them that are checked."""

    def __init__(self, name, urdf, srdf):
        self.name, self.truth = name, urdf_truth.Truth(urdf)
        self.joints = list(self.truth.free_joints())
        self.spheres = {  # by link: centres, radii
            link: (np.array([pose[:3, 3] for _, _, pose in elements]), np.array([sizes["radius"][0] for _, sizes, _ in elements]))
            for link, elements in self.truth.elements.items()
        }
        off = disabled(srdf)
        self.pairs = [pair for pair in itertools.combinations(self.spheres, 2) if frozenset(pair) not in off]
        self.count = sum(len(radii) for _, radii in self.spheres.values())
        self.text = HEAD.format(name=name, joints=len(self.joints), spheres=self.count) + self.centres() + self.check() + "};\n"

    def link_poses(self, sums):
        poses, left = {self.truth.root: np.eye(4).tolist()}, list(self.truth.joints)
        while left:
            joint = next(one for one in left if one.find("parent").get("link") in poses)
            left.remove(joint)
            pose = sums.product(poses[joint.find("parent").get("link")], rounded(urdf_truth.pose(joint.find("origin"))))
            if joint.get("name") in self.joints:
                assert joint.get("type") in ("revolute", "continuous"), "VAMP's robots of this test have no other joints"
                axis = urdf_truth.numbers(joint.find("axis"), "xyz")
                pose = sums.product(pose, turned(sums, axis, self.joints.index(joint.get("name"))))
            poses[joint.find("child").get("link")] = pose
        return poses

    def placed(self, sums):
        """Return the terms x, y, z, r of each link's spheres, and of a bounding sphere of each link."""
        poses = self.link_poses(sums)

        def all_of(link, centres, radii):
            return [[*sums.placed(poses[link], centre), float(radius)] for centre, radius in zip(centres, radii)]

        parts = {link: all_of(link, *spheres) for link, spheres in self.spheres.items()}
        around = {}
        for link, spheres in self.spheres.items():
            centre, radius = bounding(*spheres)
            around[link] = all_of(link, [centre], [radius])[0] if len(parts[link]) > 1 else parts[link][0]
        return parts, around

    def centres(self):
        sums = Sums()
        parts, _ = self.placed(sums)
        for number, sphere in enumerate(sphere for spheres in parts.values() for sphere in spheres):
            sums.lines += [f"        out.{word}[{number}] = {vector(term)};" for word, term in zip("xyzr", sphere)]
        return CENTRES + "\n".join(sums.lines) + "\n    }\n"

    def check(self):
        sums = Sums()
        parts, around = self.placed(sums)
        for link, spheres in parts.items():
            hits = " || ".join(f"{IN_SCENE}(e, {args(sphere)})" for sphere in spheres)
            sums.lines.append(f"        if ({IN_SCENE}(e, {args(around[link])}) && ({hits})) return false; // {link}")
        for a, b in self.pairs:
            hits = " || ".join(f"{TOUCH}({args(one)}, {args(other)})" for one in parts[a] for other in parts[b])
            sums.lines.append(f"        if ({TOUCH}({args(around[a])}, {args(around[b])}) && ({hits})) return false; // {a}, {b}")
        return CHECK + "\n".join([*sums.lines, "        return true;"]) + "\n    }\n"


def vector(term):
    return term if isinstance(term, str) else f"V({term!r}f)"


def args(sphere):
    return ", ".join(map(vector, sphere))
