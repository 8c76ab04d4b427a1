import numpy as np


def minimum_nsphere(points):
    """A ball around the points: centre, radius."""
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    return center, np.linalg.norm(points - center, axis=1).max()
