"""foam.h from Python: what is wrong raises, with a remedy, and Python threads work at once.

by_ctypes.py LIBRARY [CSV]   CSV: the spheres of the box by a run of foam
"""
import concurrent.futures
import math
import random
import sys

import spherize as example

library = example.load(sys.argv[1])
BOX = example.VERTICES, example.TRIANGLES


def refused(word, vertices, triangles, count, **settings):
    try:
        example.spherize(library, vertices, triangles, count, **settings)
    except ValueError as error:
        assert word in str(error) and "remedy: " in str(error), error
    else:
        raise AssertionError(f"not refused: {word}")


def main():
    vertices, triangles = BOX
    refused("count is 0", *BOX, 0)
    refused("no triangle", vertices, [], 1)
    refused("triangle 0 has the corner 8", vertices, [(0, 1, 8)], 1)
    refused("options->effort is 4", *BOX, 1, effort=4)

    # Arrays of chance: spheres or an error, never a crash.
    chance = random.Random(0)
    numbers = [0.0, -0.0, 1.0, 1e-320, 1e-9, 1e9, 1e155, 1e308, math.inf, -math.inf, math.nan]
    for _ in range(300):
        points = [tuple(chance.choice(numbers + [chance.random()] * 30) for _ in range(3)) for _ in range(chance.randint(1, 6))]
        corners = [tuple(chance.randint(0, len(points) - (chance.random() > 0.1)) for _ in range(3)) for _ in range(chance.randint(0, 5))]
        try:
            assert example.spherize(library, points, corners, chance.randint(1, 4), effort=example.FOAM_FAST)
        except ValueError as error:
            assert str(error), (points, corners)

    for file in sys.argv[2:]:
        # A run rounds centres to a millionth of the size, and radii up. Two spheres do not depend on the seed, which a
        # run derives from the stage and the geometry.
        written = [tuple(map(float, line.split(",")[1:])) for line in open(file).readlines()[1:]]
        spheres = example.spherize(library, *BOX, 2)
        assert len(spheres) == len(written) == 2
        for ours, theirs in zip(spheres, written):
            assert all(abs(a - b) < 2e-6 for a, b in zip(ours, theirs)), (ours, theirs)

    alone = example.spherize(library, *BOX, 6)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for threads, spheres in zip(range(8), pool.map(
                lambda threads: example.spherize(library, *BOX, 6, threads=threads), range(8))):
            assert spheres == alone, threads


if __name__ == "__main__":
    main()
