"""URDFs of every kind of element in Pinocchio, with coal."""
import numpy as np
import pinocchio
import pytest
import urdf_truth

#: What coal makes of each element of a URDF, and its numbers.
NUMBERS = {
    "Sphere": lambda shape: {"radius": [shape.radius]},
    "Capsule": lambda shape: {"radius": [shape.radius], "length": [2 * shape.halfLength]},
    "Cylinder": lambda shape: {"radius": [shape.radius], "length": [2 * shape.halfLength]},
    "Box": lambda shape: {"size": 2 * shape.halfSide},
}


def load(file):
    model = pinocchio.buildModelFromUrdf(str(file))
    return model, pinocchio.buildGeomFromUrdf(model, str(file), pinocchio.GeometryType.COLLISION, package_dirs=[str(file.parent)])


def configuration(model, values):
    q = pinocchio.neutral(model)
    for name, value in values.items():
        joint = model.joints[model.getJointId(name)]
        q[joint.idx_q : joint.idx_q + joint.nq] = [value] if joint.nq == 1 else [np.cos(value), np.sin(value)]
    return q


@pytest.mark.parametrize("kind", urdf_truth.KINDS)
def test_places_each_element(models, kind):
    for file in models(kind):
        truth = urdf_truth.Truth(file)
        model, geometry = load(file)
        data, placed = model.createData(), pinocchio.GeometryData(geometry)
        assert geometry.ngeoms == truth.count()
        names = [shape.name.rsplit("_", 1) for shape in geometry.geometryObjects]
        for shape, (name, number) in zip(geometry.geometryObjects, names, strict=True):
            word, sizes, _ = truth.elements[name][int(number)]
            found = type(shape.geometry).__name__
            if word == "mesh":
                assert found.startswith(("BVHModel", "Convex"))
            else:
                for key, value in NUMBERS[found](shape.geometry).items():
                    np.testing.assert_allclose(value, sizes[key], rtol=1e-15)
        for values, expected in urdf_truth.poses(file):
            pinocchio.updateGeometryPlacements(
                model, data, geometry, placed, configuration(model, truth.all_values(values))
            )
            places = [at.homogeneous for at in placed.oMg]
            wanted = [expected[name][int(number)] for name, number in names]
            np.testing.assert_allclose(places, wanted, atol=1e-9, err_msg=file.name)
