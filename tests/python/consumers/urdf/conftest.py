"""The models that the tests of all programs read."""
import pytest
import urdf_truth


@pytest.fixture(scope="session")
def models(tmp_path_factory):
    """Return a function of kind and options of foam: the three robots' models, each written once."""
    folder = tmp_path_factory.mktemp("models")
    robots = urdf_truth.robots(folder)
    known = {}

    def written(kind, *options):
        if (kind, options) not in known:
            place = folder / f"{kind}{len(known)}"
            known[kind, options] = [urdf_truth.written(robot, kind, place, *options) for robot in robots]
        return known[kind, options]

    return written
