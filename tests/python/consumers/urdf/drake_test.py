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


def parsed(file):
    """Return builder, plant and scene, to which more can be added."""
    builder = DiagramBuilder()
    plant, scene = AddMultibodyPlantSceneGraph(builder, time_step=0.0)
    Parser(plant).AddModels(str(file))
    return builder, plant, scene


def load(file):
    builder, plant, scene = parsed(file)
    plant.Finalize()
    diagram = builder.Build()
    return plant, scene.model_inspector(), diagram


def place(plant, context, values):
    """Move the joints to their values by name."""
    q = plant.GetPositions(context)
    for name, value in values.items():
        q[plant.GetJointByName(name).position_start()] = value
    plant.SetPositions(context, q)


@pytest.mark.parametrize("kind", urdf_truth.KINDS)
def test_places_each_element(models, kind):
    for file in models(kind):
        truth = urdf_truth.Truth(file)
        plant, inspector, diagram = load(file)
        context = plant.GetMyContextFromRoot(diagram.CreateDefaultContext())
        bodies = {name: plant.GetBodyByName(name) for name in truth.elements}
        geometries = {name: plant.GetCollisionGeometriesForBody(body) for name, body in bodies.items()}
        assert sum(map(len, geometries.values())) == truth.count()
        for name, elements in truth.elements.items():
            for (word, sizes, _), geometry in zip(elements, geometries[name], strict=True):
                shape = inspector.GetShape(geometry)
                if word == "mesh":
                    assert isinstance(shape, (drake.Mesh, drake.Convex))
                else:
                    for key, value in NUMBERS[type(shape)](shape).items():
                        np.testing.assert_allclose(value, sizes[key], rtol=1e-12)
        places = {name: [inspector.GetPoseInFrame(one).GetAsMatrix4() for one in geometries[name]] for name in bodies}
        for values, expected in urdf_truth.poses(file):
            place(plant, context, truth.all_values(values))
            base = plant.EvalBodyPoseInWorld(context, plant.GetBodyByName(truth.root)).inverse()
            at = {name: base @ plant.EvalBodyPoseInWorld(context, body) for name, body in bodies.items()}
            found = [at[name].GetAsMatrix4() @ one for name in expected for one in places[name]]
            np.testing.assert_allclose(found, urdf_truth.in_a_row(expected), atol=1e-9, err_msg=file.name)
