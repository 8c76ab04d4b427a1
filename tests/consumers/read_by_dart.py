"""DART reads the URDF: bodies, spheres, and where they are at three joint positions."""
import pathlib
import re

import dartpy
import numpy


def loader_for(robot):
    """DART needs the folders of packages, and refuses a robot whose visual mesh is not there."""
    loader = dartpy.utils.DartLoader()
    for package in set(re.findall('package://([^/"]+)', pathlib.Path(robot).read_text())):
        for folder in pathlib.Path(robot).parents:
            if (folder / package).is_dir() or folder.name == package:
                loader.addPackageDirectory(package, str(folder if folder.name == package else folder / package))
                break
    return loader


def check(folder, truth):
    skeleton = loader_for(truth["file"]).parseSkeleton(str(folder / "model.urdf"))
    assert skeleton, "DART refuses the robot"
    bodies = [link for link in truth["links"] if link != "world"]  # which is no body of DART's
    assert skeleton.getNumBodyNodes() == len(bodies), (skeleton.getNumBodyNodes(), len(bodies))
    assert "world" not in truth["spheres"]
    found = {}
    for link in bodies:
        nodes = [n for n in skeleton.getBodyNode(link).getShapeNodes() if n.getCollisionAspect()]
        for node in nodes:
            assert isinstance(node.getShape(), dartpy.dynamics.SphereShape), f"{link}: {node.getShape()}"
        spheres = [[*node.getRelativeTransform().translation(), node.getShape().getRadius()] for node in nodes]
        assert spheres == truth["spheres"].get(link, []), f"{link}: {spheres}"
        found[link] = nodes
    for position in truth["positions"]:
        for joint, value in position["joints"].items():
            skeleton.getJoint(joint).setPosition(0, value)
        for link, centers in position["centers"].items():
            for node, center in zip(found[link], centers):
                away = numpy.abs(node.getWorldTransform().translation() - numpy.array(center)).max()
                assert away < 1e-12, f"{link}: {away} m away"
    spheres = sum(map(len, truth["spheres"].values()))
    return f"DART has {skeleton.getNumBodyNodes()} bodies and {spheres} spheres"
