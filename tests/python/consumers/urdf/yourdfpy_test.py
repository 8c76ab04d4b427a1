"""URDFs of every kind of element in yourdfpy, with trimesh."""
import numpy as np
import pytest
import urdf_truth
import yourdfpy


@pytest.mark.parametrize("kind", urdf_truth.KINDS)
def test_places_each_element(models, kind):
    # yourdfpy has no word for <capsule>, and refuses it.
    options = ["--set", "outputs.write.urdf.capsules=as_parts"] if kind == "capsule" else []
    for file in models(kind, *options):
        truth = urdf_truth.Truth(file)
        found = yourdfpy.URDF.load(
            str(file), build_scene_graph=True, build_collision_scene_graph=True, load_meshes=False, load_collision_meshes=True,
            force_collision_mesh=False,  # else it makes one mesh of all elements of a link
        )  # fmt: skip
        graph = found.collision_scene.graph
        assert len(graph.nodes_geometry) == truth.count()
        random = np.random.default_rng(7)
        for _ in range(20):
            values = truth.random_values(random)
            found.update_cfg(values)
            expected = truth.element_poses(values)
            for name, elements in expected.items():
                nodes = [node for node in graph.transforms.children.get(name, []) if node in graph.nodes_geometry]
                assert len(nodes) == len(elements)
                places = np.array([graph.get(node, found.base_link)[0] for node in nodes])
                for element in elements:
                    assert np.abs(places - element).max(axis=(1, 2)).min() < 1e-9, (file, name)
