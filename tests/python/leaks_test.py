"""Ten thousand calls, good and bad, need no more memory at the end than after the first thousand."""
import gc
import os

import numpy as np
import pytest

import foam
from shapes import box

SANITIZED = bool(os.environ.get("FOAM_TEST_SANITIZER"))


def resident():
    """Bytes of this process in memory."""
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def calls(count):
    vertices, faces = box()
    mesh = foam.Mesh(vertices, faces)
    for i in range(count):
        cover = foam.spherize((vertices, faces) if i % 2 else mesh, 1, effort="fast")
        assert cover.centers.shape == (1, 3)
        for bad in ((vertices, faces + 1), (vertices * np.nan, faces)):
            try:
                foam.Mesh(*bad)
            except foam.InputError:
                pass
            else:
                raise AssertionError("no error")


def uses(count):
    """What a cover and its certificate are asked for; those of one in fifty are made anew."""
    vertices, faces = box()
    cover = foam.cover((vertices, faces), 2, ["capsule"], effort="fast")
    for i in range(count):
        if i % 50 == 0:
            cover = foam.cover((vertices, faces), 2, ["capsule"], effort="fast", progress=None if i % 500 else str)
            assert cover.certificate.holds and foam.load((vertices, faces)).links == ["mesh"]
        assert len(cover.elements) == len(cover) and cover[0]["kind"] and cover.to_dict() and repr(cover)
        for bad in (lambda: cover.spheres, lambda: np.asarray(cover), lambda: foam.load(3)):
            try:
                bad()
            except foam.Error:
                pass
            else:
                raise AssertionError("no error")


@pytest.mark.skipif(SANITIZED, reason="a sanitizer keeps freed memory")
@pytest.mark.parametrize("work", [calls, uses])
def test_no_leak_over_ten_thousand_calls(work):
    with foam.threads(1):
        work(1000)
        before = resident()
        work(9000)
        assert resident() - before < 4_000_000  # one mesh of each call would be 5 MB
