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


@pytest.mark.skipif(SANITIZED, reason="a sanitizer keeps freed memory")
def test_no_leak_over_ten_thousand_calls():
    with foam.threads(1):
        calls(1000)
        before = resident()
        calls(9000)
        assert resident() - before < 4_000_000  # one mesh of each call would be 5 MB
