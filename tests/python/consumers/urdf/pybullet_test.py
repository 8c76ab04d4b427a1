"""URDFs of every kind of element in PyBullet."""
import sys

import numpy as np
import pytest
import urdf_truth

if sys.version_info >= (3, 12):
    pytest.skip("PyBullet has packages up to Python 3.11", allow_module_level=True)
import pybullet

#: What PyBullet calls the elements of a URDF, and the numbers that it tells of each.
WORDS = {
    "sphere": (pybullet.GEOM_SPHERE, lambda sizes: (sizes["radius"][0],) * 3),
    "capsule": (pybullet.GEOM_CAPSULE, lambda sizes: (sizes["length"][0], sizes["radius"][0], 0)),
    "cylinder": (pybullet.GEOM_CYLINDER, lambda sizes: (sizes["length"][0], sizes["radius"][0], 0)),
    "box": (pybullet.GEOM_BOX, lambda sizes: sizes["size"]),
    "mesh": (pybullet.GEOM_MESH, None),
}
SINGLE = 3e-6  #: m; the file's numbers pass through single precision


@pytest.fixture(scope="module")
def client():
    number = pybullet.connect(pybullet.DIRECT)
    yield number
    pybullet.disconnect(number)


def matrix(position, quaternion):
    result = np.eye(4)
    result[:3, :3] = np.array(pybullet.getMatrixFromQuaternion(quaternion)).reshape(3, 3)
    result[:3, 3] = position
    return result


def names_of(body):
    """Return the links by PyBullet's numbers, and the joints that lead to them."""
    base = pybullet.getBodyInfo(body)[0].decode()
    infos = [pybullet.getJointInfo(body, j) for j in range(pybullet.getNumJoints(body))]
    links = {-1: base} | {info[0]: info[12].decode() for info in infos}
    return links, {info[1].decode(): info[0] for info in infos}


@pytest.mark.parametrize("kind", urdf_truth.KINDS)
def test_places_each_element(models, client, kind):
    for file in models(kind):
        truth = urdf_truth.Truth(file)
        # Else a cylinder is a prism of 32 sides, which leaves out what is between it and the cylinder.
        body = pybullet.loadURDF(str(file), useFixedBase=True, flags=pybullet.URDF_USE_IMPLICIT_CYLINDER)
        links, joints = names_of(body)
        shapes = {number: pybullet.getCollisionShapeData(body, number) for number in links}
        assert sum(map(len, shapes.values())) == truth.count()
        for number, name in links.items():
            for shape, (word, sizes, _) in zip(shapes[number], truth.elements.get(name, []), strict=True):
                assert shape[2] == WORDS[word][0], (file, name)
                if word != "mesh":
                    np.testing.assert_allclose(shape[3], WORDS[word][1](sizes), rtol=1e-6, atol=1e-9)
        places = {name: [matrix(*shape[5:7]) for shape in shapes[number]] for number, name in links.items()}
        for values, expected in urdf_truth.poses(file):
            for name, value in truth.all_values(values).items():
                pybullet.resetJointState(body, joints[name], value)
            at = {}  # and the places of elements: by the frame of the link's inertia
            for number, name in links.items():
                if number == -1:
                    at[name] = matrix(*pybullet.getBasePositionAndOrientation(body))
                else:
                    at[name] = matrix(*pybullet.getLinkState(body, number, computeForwardKinematics=True)[:2])
            found = [at[name] @ one for name in expected for one in places[name]]
            np.testing.assert_allclose(found, urdf_truth.in_a_row(expected), atol=SINGLE, err_msg=file.name)
        pybullet.removeBody(body)
