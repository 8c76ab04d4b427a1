"""One mesh in any number of triangles."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._mesh import Mesh
from ..utility import filtered

#: Corners of a triangle that its sides go from and to; the corner across.
_FROM, _TO, _ACROSS = np.array([0, 1, 2]), np.array([1, 2, 0]), np.array([2, 0, 1])


_COARSE, _FINE = 0.4, 0.9  #: of the squared length of the longest edge


def sized(mesh: Mesh, triangles: int) -> Mesh:
    """Return the mesh in about that number of triangles: simplify.quadric takes it down, refined() takes it up."""
    if len(mesh.faces) <= triangles:
        return refined(mesh, triangles)
    return filtered(mesh, "simplify.quadric", target_triangles=triangles, volume_tolerance=1.0)


def refined(mesh: Mesh, triangles: int) -> Mesh:
    """Return the mesh in at least that number of triangles: the longest edges are split, the surface stays.

    Edges that are the longest of all their triangles are split at once; without borders and branches at most one triangle
    too many comes of it. Pieces of a triangle stand one behind the other, and vertices in the order of their first use:
    neighbours are near in memory, as in meshes of modellers. Otherwise times would tell of the cache.
    """
    vertices, faces = np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int64)
    origins = np.arange(len(faces))
    if len(faces) >= triangles:
        return mesh
    while len(faces) < triangles:
        # Coarsely as long as that is made good later: each turn looks at all edges.
        shortest = _COARSE if 2 * len(faces) < triangles else _FINE
        vertices, faces, origins = _split_once(vertices, faces, origins, triangles - len(faces), shortest)
    faces = faces[np.argsort(origins, kind="stable")]
    used, first, numbers = np.unique(faces, return_index=True, return_inverse=True)
    order = np.argsort(first, kind="stable")
    places = np.empty(len(used), dtype=np.int64)
    places[order] = np.arange(len(used))
    return Mesh(vertices[used[order]], places[numbers].reshape(-1, 3))


def _split_once(
    vertices: NDArray[Any], faces: NDArray[Any], origins: NDArray[Any], most: int, shortest: float
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Split edges that are the longest of all their triangles, for about `most` new triangles: from the longest of all down
    to `shortest` times its squared length."""
    sides = np.sort(np.stack([faces[:, _FROM], faces[:, _TO]], axis=2).reshape(-1, 2), axis=1)
    _, first, edges = np.unique(sides[:, 0] * len(vertices) + sides[:, 1], return_index=True, return_inverse=True)
    lengths = ((vertices[sides[first, 0]] - vertices[sides[first, 1]]) ** 2).sum(axis=1)
    of_face = edges.reshape(-1, 3)
    longest = of_face[:, 0]
    for side in (1, 2):
        other = of_face[:, side]
        longer = (lengths[other] > lengths[longest]) | ((lengths[other] == lengths[longest]) & (other > longest))
        longest = np.where(longer, other, longest)
    users, as_longest = np.bincount(edges), np.bincount(longest, minlength=len(first))
    ready = np.flatnonzero((users == as_longest) & (lengths >= shortest * lengths.max()))
    ready = ready[np.argsort(-lengths[ready], kind="stable")]
    needed = int(np.searchsorted(np.cumsum(users[ready]), most)) + 1
    return _split_edges(vertices, faces, origins, of_face, ready[:needed], sides[first[ready[:needed]]])


def _split_edges(
    vertices: NDArray[Any], faces: NDArray[Any], origins: NDArray[Any], of_face: NDArray[Any], split: NDArray[Any],
    ends: NDArray[Any],
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:  # fmt: skip
    """Split edges of which no triangle has two. `ends`: the two vertices of each."""
    middles = np.full(int(of_face.max()) + 1, -1)
    middles[split] = np.arange(len(split)) + len(vertices)
    cut, side = np.nonzero(middles[of_face] >= 0)
    a, b, c = (faces[cut, corner[side]] for corner in (_FROM, _TO, _ACROSS))
    middle = middles[of_face[cut, side]]
    faces = faces.copy()
    faces[cut] = np.stack([a, middle, c], axis=1)
    return (np.concatenate([vertices, (vertices[ends[:, 0]] + vertices[ends[:, 1]]) / 2]),
            np.concatenate([faces, np.stack([middle, b, c], axis=1)]),
            np.concatenate([origins, origins[cut]]))  # fmt: skip
