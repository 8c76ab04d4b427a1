"""Stands for the package trimesh: the attributes that scripts for the Python foam use."""
import numpy as np


class Trimesh:
    def __init__(self, vertices=None, faces=None, process=True):
        self.vertices = np.array(vertices, dtype=np.float64)
        self.faces = np.array(faces, dtype=np.int64)

    @property
    def bounds(self):
        return np.array([self.vertices.min(axis=0), self.vertices.max(axis=0)])

    @property
    def volume(self):
        return np.linalg.det(self.vertices[self.faces]).sum() / 6

    def copy(self):
        return Trimesh(self.vertices, self.faces)

    def apply_transform(self, matrix):
        self.vertices = self.vertices @ matrix[:3, :3].T + matrix[:3, 3]
        return self


class Scene:
    def __init__(self, geometry):
        self.geometry = {str(i): one for i, one in enumerate(geometry)}

    def dump(self, concatenate=False):
        meshes = list(self.geometry.values())
        starts = np.cumsum([0] + [len(one.vertices) for one in meshes])
        return Trimesh(np.concatenate([one.vertices for one in meshes]),
                       np.concatenate([one.faces + start for one, start in zip(meshes, starts)]))
