"""URDFs of every kind of element in yourdfpy, with trimesh."""
import numpy as np
import pytest
import urdf_truth
import yourdfpy


@pytest.mark.parametrize("kind", urdf_truth.KINDS)
def test_places_each_element(models, kind):
    for file in models(kind):
        truth = urdf_truth.Truth(file)
        found = yourdfpy.URDF.load(
            str(file), build_scene_graph=True, build_collision_scene_graph=True, load_meshes=False, load_collision_meshes=True,
            force_collision_mesh=False,  # else it makes one mesh of all elements of a link
        )  # fmt: skip
        graph = found.collision_scene.graph
        assert len(graph.nodes_geometry) == truth.count()
        for values, expected in urdf_truth.poses(file):
            found.update_cfg(values)
            for name, elements in expected.items():
                nodes = [node for node in graph.transforms.children.get(name, []) if node in graph.nodes_geometry]
                assert len(nodes) == len(elements)
                places = np.array([graph.get(node, found.base_link)[0] for node in nodes])
                gaps = np.abs(places - np.array(elements)[:, None]).max(axis=(2, 3)).min(axis=1)
                assert (gaps < 1e-9).all(), (file, name)
