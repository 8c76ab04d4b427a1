"""What the original geometry of a robot touches, by Pinocchio and coal."""
import itertools

import coal
import numpy as np
import pinocchio


def solid(kind, *numbers):
    """Return coal's body of an obstacle and its place: `box` (centre, rotation, half sizes), `capsule` (ends, radius) or `sphere`."""
    place = np.eye(4)
    if kind == "box":
        place[:3, 3], place[:3, :3], half = numbers[0], numbers[1], np.array(numbers[2])
        return coal.Box(*(2 * half)), place
    if kind == "capsule":
        low, high = map(np.array, numbers[:2])
        along = high - low
        place[:3, 3] = (low + high) / 2
        place[:3, :3] = pinocchio.Quaternion.FromTwoVectors(np.array([0.0, 0, 1]), along / np.linalg.norm(along)).matrix()
        return coal.Capsule(numbers[2], np.linalg.norm(along)), place
    place[:3, 3] = numbers[0]
    return coal.Sphere(numbers[1]), place


class Original:
    def __init__(self, file):
        self.model = pinocchio.buildModelFromUrdf(str(file))
        self.shapes = pinocchio.buildGeomFromUrdf(self.model, str(file), pinocchio.GeometryType.COLLISION, package_dirs=[str(file.parent)])
        self.links = [self.model.frames[shape.parentFrame].name for shape in self.shapes.geometryObjects]

    def configurations(self, names, poses, others):
        """Return the configurations in which the joints of these names have the values of a row, and `others` theirs."""
        at = {name: self.model.joints[self.model.getJointId(name)].idx_q for name in [*names, *others]}
        rows = np.tile(pinocchio.neutral(self.model), (len(poses), 1))
        rows[:, [at[name] for name in names]] = poses
        for name, value in others.items():
            rows[:, at[name]] = value
        return rows

    def frames(self, rows, links):
        """Return the poses of links, by configuration."""
        data, numbers = self.model.createData(), [self.model.getFrameId(link) for link in links]
        result = np.empty((len(rows), len(links), 4, 4))
        for row, q in zip(result, rows):
            pinocchio.framesForwardKinematics(self.model, data, q)
            for k, number in enumerate(numbers):
                row[k] = data.oMf[number].homogeneous
        return result

    def touches(self, rows, scene):
        """Return whether any link touches an obstacle, by configuration."""
        shapes = self.shapes.copy()
        shapes.removeAllCollisionPairs()
        for number, obstacle in enumerate(scene):
            body, place = solid(*obstacle)
            index = shapes.addGeometryObject(pinocchio.GeometryObject(f"obstacle{number}", 0, pinocchio.SE3(place), body))
            for link in range(len(self.links)):
                shapes.addCollisionPair(pinocchio.CollisionPair(link, index))
        return self.collide(shapes, rows).any(axis=1)

    def pairs_that_touch(self, rows):
        """Return the pairs of links, and a column of each: whether they touch, by configuration. Neighbours are left out."""
        shapes, parents = self.shapes.copy(), self.model.parents
        joints = [shape.parentJoint for shape in shapes.geometryObjects]
        shapes.removeAllCollisionPairs()
        for a, b in itertools.combinations(range(len(joints)), 2):
            if joints[a] != joints[b] and parents[joints[a]] != joints[b] and parents[joints[b]] != joints[a]:
                shapes.addCollisionPair(pinocchio.CollisionPair(a, b))
        return [(self.links[pair.first], self.links[pair.second]) for pair in shapes.collisionPairs], self.collide(shapes, rows)

    def collide(self, shapes, rows):
        data, placed = self.model.createData(), pinocchio.GeometryData(shapes)
        found = np.zeros((len(rows), len(shapes.collisionPairs)), bool)
        for row, q in zip(found, rows):
            pinocchio.computeCollisions(self.model, data, shapes, placed, q, False)
            row[:] = [result.isCollision() for result in placed.collisionResults]
        return found
