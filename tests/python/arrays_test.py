"""Any array: spheres that cover it, or an exception with a reason. Never a crash."""
import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings, strategies as st
from hypothesis.extra import numpy as arrays

import foam
from shapes import box, uncovered

FEW = settings(max_examples=150, deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck))

anything = st.one_of(
    st.none(), st.integers(), st.text(max_size=3), st.lists(st.integers(), max_size=4), st.floats(),
    arrays.arrays(dtype=arrays.scalar_dtypes(), shape=arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=5)),
    arrays.arrays(dtype=st.sampled_from([np.float32, np.float64, np.float16, np.int8, np.uint64]),
                  shape=st.tuples(st.integers(0, 8), st.integers(2, 4))))


def tried(vertices, faces):
    """The cover; None if foam refuses the mesh with a reason."""
    try:
        cover = foam.spherize((vertices, faces), 3, effort="fast")
    except foam.Error as error:
        assert len(str(error)) > 10
        return None
    assert cover.certified and np.isfinite(cover.spheres).all()
    return cover


@FEW
@given(anything, anything)
def test_any_two_things(vertices, faces):
    tried(vertices, faces)


@FEW
@given(arrays.arrays(dtype=np.float64, shape=st.tuples(st.integers(1, 9), st.just(3)),
                     elements=st.floats(allow_nan=True, allow_infinity=True)), st.data())
def test_any_numbers(vertices, data):
    faces = data.draw(arrays.arrays(dtype=np.int64, shape=st.tuples(st.integers(1, 6), st.just(3)),
                                    elements=st.integers(-1, len(vertices))))
    cover = tried(vertices, faces)
    if cover is not None:
        used = vertices[np.unique(faces)]
        assert len(uncovered(used, cover.spheres)) == 0


@FEW
@given(arrays.arrays(dtype=np.float64, shape=st.tuples(st.integers(3, 12), st.just(3)), elements=st.floats(-10, 10)),
       st.data())
def test_any_sound_mesh_is_covered(vertices, data):
    faces = data.draw(arrays.arrays(dtype=np.int64, shape=st.tuples(st.integers(1, 12), st.just(3)),
                                    elements=st.integers(0, len(vertices) - 1)))
    assume(np.ptp(vertices[np.unique(faces)], axis=0).max() > 1e-6)
    cover = foam.spherize((vertices, faces), 4, effort="fast")
    assert cover.certified
    assert len(uncovered(vertices[np.unique(faces)], cover.spheres)) == 0


@pytest.mark.parametrize("dtype", ["int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64", ">i4"])
def test_faces_of_any_width(dtype):
    vertices, faces = box()
    assert foam.spherize((vertices, faces.astype(dtype)), 3) == foam.spherize((vertices, faces), 3)


@pytest.mark.parametrize("change", [
    lambda a: np.asfortranarray(a), lambda a: np.repeat(a, 2, axis=0)[::2], lambda a: a[::-1][::-1],
    lambda a: np.ascontiguousarray(a[:, ::-1])[:, ::-1], lambda a: a.astype(">f8"), lambda a: a.tolist(),
    lambda a: np.lib.stride_tricks.as_strided(np.pad(a, ((0, 0), (0, 5))), a.shape, (64, 8)),
    lambda a: np.frombuffer(a.tobytes()).reshape(a.shape), lambda a: a.astype(np.longdouble)])
def test_vertices_of_any_layout(change):
    vertices, faces = box()
    assert foam.spherize((change(vertices), faces), 3) == foam.spherize((vertices, faces), 3)


def test_float32_vertices_count_as_they_are():
    vertices, faces = box()
    single = vertices.astype(np.float32)
    assert foam.spherize((single, faces), 3) == foam.spherize((single.astype(float), faces), 3)


def test_arrays_are_copied_on_the_way_in():
    vertices, faces = box()
    mesh = foam.Mesh(vertices, faces)
    vertices[:] = 7
    faces[:] = 0
    assert mesh == foam.Mesh(*box())
    with pytest.raises(ValueError):
        mesh.vertices[0] = 1


@pytest.mark.parametrize("vertices, faces, words", [
    (np.zeros((4, 2)), [[0, 1, 2]], "shape (n, 3)"),
    (np.zeros(12), [[0, 1, 2]], "shape (n, 3)"),
    (np.zeros((4, 3)), [[0, 1, 2, 3]], "split quads"),
    (np.zeros((4, 3)), [[0, 1, 4]], "subtract 1"),
    (np.zeros((4, 3)), [[0, 1, -1]], "-1"),
    (np.zeros((4, 3)), [[0.0, 1.0, 2.0]], "astype(int)"),
    (np.zeros((4, 3)), np.array([[0, 1, 2**63]], np.uint64), "out of range"),
    (np.zeros((4, 3), complex), [[0, 1, 2]], "astype(float)"),
    (np.full((4, 3), "a"), [[0, 1, 2]], "astype(float)"),
    ([[0, 0, 0], [1]], [[0, 1, 2]], "equal length"),
    (np.ma.masked_equal(np.zeros((4, 3)), 0), [[0, 1, 2]], "masked"),
    ([[np.nan, 0, 0], [0, 0, 1], [0, 1, 0]], [[0, 1, 2]], "vertices[0] is not finite"),
    (np.broadcast_to(np.zeros(3), (10**12, 3)), [[0, 1, 2]], "simplify"),
    (np.zeros((4, 3)), np.broadcast_to(np.zeros(3, int), (10**12, 3)), "simplify"),
])
def test_refusals_have_a_reason(vertices, faces, words):
    with pytest.raises(foam.InputError) as caught:
        foam.Mesh(vertices, faces)
    assert words in str(caught.value)


@pytest.mark.parametrize("arguments", [
    (np.zeros((4, 3), np.float32), np.zeros((1, 3), np.int64)), (np.zeros((4, 3)), np.zeros((1, 3), np.int32)),
    (np.zeros((4, 6))[:, ::2], np.zeros((1, 3), np.int64)), (np.zeros(3), np.zeros((1, 3), np.int64)),
    (np.zeros((3, 3)), b"123")])
def test_the_private_module_checks_its_arrays_too(arguments):
    with pytest.raises(foam.Error, match="_core takes contiguous rows"):
        foam._core.Mesh(*arguments)
