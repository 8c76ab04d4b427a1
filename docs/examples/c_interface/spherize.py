"""foam.h by ctypes: the same box as in main.c."""
import ctypes
import ctypes.util
import sys


class Options(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("effort", ctypes.c_int), ("objective", ctypes.c_int),
                ("seed", ctypes.c_uint64), ("time_limit", ctypes.c_double), ("threads", ctypes.c_uint32),
                ("reserved", ctypes.c_uint32), ("poll", ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)),
                ("user", ctypes.c_void_p)]


class Report(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("spheres", ctypes.c_size_t), ("volume", ctypes.c_double),
                ("certified", ctypes.c_int), ("finished_early", ctypes.c_int), ("error", ctypes.c_char * 512)]


FOAM_FAST = 1


def load(path):
    library = ctypes.CDLL(path)
    library.foam_spherize.argtypes = [
        ctypes.POINTER(ctypes.c_double), ctypes.c_size_t, ctypes.POINTER(ctypes.c_uint32), ctypes.c_size_t,
        ctypes.c_size_t, ctypes.POINTER(Options), ctypes.POINTER(ctypes.c_double), ctypes.POINTER(Report)]
    library.foam_version.restype = ctypes.c_char_p
    return library


def spherize(library, vertices, triangles, count, **settings):
    """The spheres as a list of (x, y, z, radius); raises ValueError with foam's text."""
    options, report = Options(ctypes.sizeof(Options), **settings), Report(ctypes.sizeof(Report))
    points = [number for vertex in vertices for number in vertex]
    corners = [index for triangle in triangles for index in triangle]
    spheres = (ctypes.c_double * (4 * count))()
    if library.foam_spherize((ctypes.c_double * len(points))(*points), len(vertices),
                             (ctypes.c_uint32 * len(corners))(*corners), len(triangles),
                             count, options, spheres, report):
        raise ValueError(report.error.decode())
    return [tuple(spheres[4 * i:4 * i + 4]) for i in range(report.spheres)]


VERTICES = [(0.03 if i & 1 else -0.03, 0.02 if i & 2 else -0.02, 0.1 if i & 4 else -0.1) for i in range(8)]
TRIANGLES = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
             (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]

if __name__ == "__main__":
    foam = load(sys.argv[1] if len(sys.argv) > 1 else ctypes.util.find_library("foam-c") or "libfoam-c.so")
    for sphere in spherize(foam, VERTICES, TRIANGLES, 8, effort=FOAM_FAST):
        print("%.17g %.17g %.17g %.17g" % sphere)
