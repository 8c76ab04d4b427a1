"""URDFs and SDFs of every kind of element in Drake."""
import numpy as np
import pydrake.geometry as drake
import pytest
import urdf_truth
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.systems.framework import DiagramBuilder

NUMBERS = {
    drake.Sphere: lambda shape: {"radius": [shape.radius()]},
    drake.Capsule: lambda shape: {"radius": [shape.radius()], "length": [shape.length()]},
    drake.Cylinder: lambda shape: {"radius": [shape.radius()], "length": [shape.length()]},
    drake.Box: lambda shape: {"size": shape.size()},
}


def load(file):
    builder = DiagramBuilder()
    plant, scene = AddMultibodyPlantSceneGraph(builder, time_step=0.0)
    Parser(plant).AddModels(str(file))
    plant.Finalize()
    diagram = builder.Build()
    return plant, scene.model_inspector(), diagram


@pytest.mark.parametrize("kind", urdf_truth.KINDS)
def test_places_each_element(models, kind):
    for file in models(kind):
        truth = urdf_truth.Truth(file)
        plant, inspector, diagram = load(file)
        context = plant.GetMyContextFromRoot(diagram.CreateDefaultContext())
        bodies = {name: plant.GetBodyByName(name) for name in truth.elements}
        geometries = {name: plant.GetCollisionGeometriesForBody(body) for name, body in bodies.items()}
        assert sum(map(len, geometries.values())) == truth.count()
        random = np.random.default_rng(7)
        for _ in range(20):
            values = truth.random_values(random)
            for name, value in truth.all_values(values).items():
                plant.GetJointByName(name).set_default_positions([value])
            context = plant.GetMyContextFromRoot(diagram.CreateDefaultContext())
            base = plant.EvalBodyPoseInWorld(context, plant.GetBodyByName(truth.root)).inverse()
            expected = truth.element_poses(values)
            for name, body in bodies.items():
                at = (base @ plant.EvalBodyPoseInWorld(context, body)).GetAsMatrix4()
                for i, geometry in enumerate(geometries[name]):
                    found = at @ inspector.GetPoseInFrame(geometry).GetAsMatrix4()
                    np.testing.assert_allclose(found, expected[name][i], atol=1e-9, err_msg=f"{file.name} {name} {i}")
                    word, sizes, _ = truth.elements[name][i]
                    shape = inspector.GetShape(geometry)
                    if word == "mesh":
                        assert isinstance(shape, (drake.Mesh, drake.Convex))
                    else:
                        for key, value in NUMBERS[type(shape)](shape).items():
                            np.testing.assert_allclose(value, sizes[key], rtol=1e-12)
