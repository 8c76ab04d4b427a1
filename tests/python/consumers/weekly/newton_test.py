"""URDF, MJCF and USD of every kind of element in Newton."""
import itertools

import newton
import numpy as np
import pytest
import stage
import urdf_truth
import warp
from reach import Reaches, reach
from vamp_struct import disabled

TYPE = newton.GeoType
#: What Newton makes of an element, and its numbers: half lengths are in the scale of a shape.
WORDS = {
    TYPE.SPHERE: ("sphere", lambda scale, _: {"radius": scale[0]}),
    TYPE.CAPSULE: ("capsule", lambda scale, _: {"radius": scale[0], "length": 2 * scale[1]}),
    TYPE.CYLINDER: ("cylinder", lambda scale, _: {"radius": scale[0], "length": 2 * scale[1]}),
    TYPE.BOX: ("box", lambda scale, _: {"size": 2 * scale}),
    TYPE.MESH: ("mesh", lambda scale, mesh: {"points": mesh.vertices.astype(float) * scale}),
    TYPE.CONVEX_MESH: ("mesh", lambda scale, mesh: {"points": mesh.vertices.astype(float) * scale}),
}
#: Newton takes hulls in URDF and MJCF for meshes that may be concave.
HULLS = {"urdf": TYPE.MESH, "xml": TYPE.MESH, "usda": TYPE.CONVEX_MESH}
warp.config.quiet = True


def matrix(transform):
    x, y, z, w = transform[3:].astype(float)
    result = np.eye(4)
    result[:3, 3] = transform[:3]
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    result[:3, :3] += 2 * w * cross + 2 * cross @ cross
    return result


class Loaded:
    def __init__(self, file):
        builder = newton.ModelBuilder()
        {"urdf": builder.add_urdf, "xml": builder.add_mjcf, "usda": builder.add_usd}[file.suffix[1:]](str(file))
        self.model = model = builder.finalize(device="cpu")
        self.state, self.q = model.state(), model.joint_q.numpy()
        starts = model.joint_q_start.numpy()
        self.joints = {label.split("/")[-1]: starts[j] for j, label in enumerate(model.joint_label)}
        self.bodies = [label.split("/")[-1] for label in model.body_label]
        collides = model.shape_flags.numpy() & int(newton.ShapeFlags.COLLIDE_SHAPES)
        self.shapes = np.flatnonzero(collides)
        self.types = {TYPE(model.shape_type.numpy()[s]) for s in self.shapes}
        scales, places, self.of = model.shape_scale.numpy(), model.shape_transform.numpy(), model.shape_body.numpy()
        self.elements = [
            (WORDS[kind][0], WORDS[kind][1](scales[s].astype(float), model.shape_source[s]), matrix(places[s]))
            for s in self.shapes
            for kind in [TYPE(model.shape_type.numpy()[s])]
        ]

    def reaches(self, values):
        """Return the reach of each shape, by body, at values of joints."""
        for name, value in values.items():
            self.q[self.joints[name]] = value
        self.model.joint_q.assign(self.q)
        newton.eval_fk(self.model, self.model.joint_q, self.model.joint_qd, self.state)
        poses, found = self.state.body_q.numpy(), {}
        for shape, (word, numbers, place) in zip(self.shapes, self.elements):
            body = self.of[shape]
            found.setdefault(self.bodies[body], []).append(reach(word, numbers, matrix(poses[body]) @ place))
        return found

    def pairs(self):
        """Return the pairs of bodies whose shapes Newton checks."""
        off = {tuple(sorted(pair)) for pair in self.model.shape_collision_filter_pairs}
        left = itertools.combinations(self.shapes, 2)
        between = {frozenset((self.bodies[self.of[a]], self.bodies[self.of[b]])) for a, b in left if (a, b) not in off}
        return {pair for pair in between if len(pair) == 2}


def files(models, kind, ending):
    """Return robots, and their models as URDF and in another format."""
    return models(kind, ending, "as_parts" if ending == "urdf" else "element")


@pytest.mark.parametrize("ending", HULLS)
@pytest.mark.parametrize("kind", urdf_truth.KINDS)
def test_places_each_element(models, kind, ending):
    for robot, urdf, file in files(models, kind, ending):
        truth, found = urdf_truth.Truth(urdf), Loaded(file)
        assert len(found.shapes) == truth.count()
        if kind in ("hull", "swept_box"):  # a swept box of almost no radius is a box
            assert found.types - {TYPE.BOX if kind == "swept_box" else None} <= {HULLS[ending]}, robot
        expected, random = Reaches(urdf, truth), np.random.default_rng(7)
        for _ in range(10):
            values = truth.random_values(random)
            expected.check(values, found.reaches(truth.all_values(values)))


@pytest.mark.parametrize("ending", ("xml", "usda"))
def test_keeps_the_pairs(models, foam, ending):
    for robot, urdf, file in files(models, "sphere", ending):
        srdf = urdf.with_suffix(".srdf")
        foam("convert", urdf, robot, "-o", srdf)
        links = urdf_truth.Truth(urdf).elements
        left = {frozenset(pair) for pair in itertools.combinations(links, 2)} - disabled(srdf)
        assert Loaded(file).pairs() == left, robot


def test_reads_capsules(models):
    for _, urdf, _ in models("capsule"):
        truth = urdf_truth.Truth(urdf)
        values = truth.random_values(np.random.default_rng(7))
        Reaches(urdf, truth).check(values, Loaded(urdf).reaches(truth.all_values(values)))
