"""Meshes for the tests: (vertices, faces)."""
import numpy as np


def box(x=0.06, y=0.04, z=0.2):
    """A box about the origin, metres."""
    vertices = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)], float) * 2 - 1
    faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
             [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]
    return vertices * [x / 2, y / 2, z / 2], np.array(faces)


def cylinder(radius=0.05, height=0.2, sides=64):
    """A cylinder about the z axis."""
    angles = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    ring = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    vertices = np.concatenate([np.column_stack([ring, np.full(sides, z)]) for z in (-height / 2, height / 2)]
                              + [[[0, 0, -height / 2], [0, 0, height / 2]]])
    i, j = np.arange(sides), (np.arange(sides) + 1) % sides
    low, high = np.full(sides, 2 * sides), np.full(sides, 2 * sides + 1)
    faces = [np.stack([i, j, j + sides], 1), np.stack([i, j + sides, i + sides], 1),
             np.stack([low, j, i], 1), np.stack([high, i + sides, j + sides], 1)]
    return vertices, np.concatenate(faces)


def wavy(triangles):
    """A closed, wavy, long ball of about so many triangles."""
    n = int((triangles / 2) ** 0.5) + 1
    polar = np.linspace(0, np.pi, n + 1)[1:-1, None]
    around = np.linspace(0, 2 * np.pi, n, endpoint=False)[None, :]
    radius = 1 + 0.3 * np.sin(3 * around)
    ring = np.stack([np.sin(polar) * np.cos(around) * radius, np.sin(polar) * np.sin(around),
                     2 * np.cos(polar) + 0 * around], axis=-1)
    vertices = np.concatenate([ring.reshape(-1, 3), [[0, 0, 2], [0, 0, -2]]])
    i, j = np.meshgrid(np.arange(n - 2), np.arange(n), indexing="ij")
    a, b = (i * n + j).ravel(), (i * n + (j + 1) % n).ravel()
    last = (n - 2) * n
    j = np.arange(n)
    top, bottom = np.full(n, last + n), np.full(n, last + n + 1)
    faces = [np.stack([a, a + n, b], 1), np.stack([b, a + n, b + n], 1),
             np.stack([top, j, (j + 1) % n], 1), np.stack([bottom, last + (j + 1) % n, last + j], 1)]
    return vertices, np.concatenate(faces)


def uncovered(vertices, spheres):
    """The vertices that no sphere contains."""
    distances = np.linalg.norm(vertices[:, None] - spheres[None, :, :3], axis=2)
    return vertices[(distances > spheres[None, :, 3] * (1 + 1e-12)).all(axis=1)]
