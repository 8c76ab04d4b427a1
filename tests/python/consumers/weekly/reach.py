"""How far elements reach along many directions, in the frame of the root: equal numbers, equal elements at equal places."""
import xml.etree.ElementTree as ET

import numpy as np

SINGLE = 5e-6  #: m; what an engine in single precision may be off: 3e-6 in its place, and the rest by its turn
DIRECTIONS = np.random.default_rng(1).normal(size=(200, 3))
DIRECTIONS /= np.linalg.norm(DIRECTIONS, axis=1)[:, None]


def reach(word, numbers, place):
    """Return how far an element at a 4x4 pose reaches; numbers: radius, length, size, or the points of a mesh."""
    local = DIRECTIONS @ place[:3, :3]
    across, along = np.linalg.norm(local[:, :2], axis=1), abs(local[:, 2])
    length, radius = (float(np.sum(numbers.get(name, 0))) for name in ("length", "radius"))
    own = {
        "sphere": lambda: radius,
        "capsule": lambda: radius + along * length / 2,
        "cylinder": lambda: radius * across + along * length / 2,
        "box": lambda: abs(local) @ numbers["size"] / 2,
        "mesh": lambda: (local @ numbers["points"].T).max(axis=1),
    }[word]()
    return own + DIRECTIONS @ place[:3, 3]


def vertices(file):
    lines = (line.split() for line in file.read_text().splitlines())
    return np.array([line[1:4] for line in lines if line[:1] == ["v"]], float)


class Reaches:
    """What a URDF of foam says, by link, at values of joints."""

    def __init__(self, file, truth):
        self.truth, self.numbers = truth, {}
        for link in ET.parse(file).getroot().iter("link"):
            for shape, (word, sizes, _) in zip(link.iterfind("collision/geometry/*"), truth.elements.get(link.get("name"), [])):
                points = {"points": vertices(file.parent / shape.get("filename"))} if word == "mesh" else {}
                self.numbers.setdefault(link.get("name"), []).append((word, {**sizes, **points}))

    def check(self, values, found):
        """Raise AssertionError unless the reaches by link are the same, in any order."""
        poses = self.truth.element_poses(values)
        assert {link: len(of) for link, of in found.items()} == {link: len(of) for link, of in poses.items()}
        for link, places in poses.items():
            ours = np.array([reach(*element, place) for element, place in zip(self.numbers[link], places)])
            gaps = abs(ours[:, None] - np.array(found[link])[None]).max(axis=2)
            assert len(set(gaps.argmin(axis=1))) == len(ours), link
            assert gaps.min(axis=1).max() < SINGLE, f"{link}: elements reach {gaps.min(axis=1).max():.3g} m less or more"
