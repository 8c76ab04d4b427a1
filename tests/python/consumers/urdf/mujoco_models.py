"""What a version of MuJoCo makes of MJCFs.

mujoco_models.py [MJCF URDF]…   prints the version, and checks each MJCF against the URDF of the same elements
"""

import sys
import warnings
from pathlib import Path

import mujoco
import numpy as np
import urdf_truth


def matrix(numbers):
    result = np.eye(4)
    result[:3, :3] = np.reshape(numbers[1], (3, 3))
    result[:3, 3] = numbers[0]
    return result


def turned(quaternion):
    result = np.empty(9)
    mujoco.mju_quat2Mat(result, quaternion)
    return result


def check(file, urdf):
    """Raise AssertionError where a model differs from a URDF of the same elements, or moves beyond bounds."""
    truth = urdf_truth.Truth(urdf)
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    solid = [g for g in range(model.ngeom) if model.geom_contype[g] or model.geom_conaffinity[g]]
    geoms = {}
    for g in solid:
        geoms.setdefault(model.body(model.geom_bodyid[g]).name, []).append(g)
    assert len(solid) == truth.count(), file.name
    order = [g for name in truth.elements for g in geoms[name]]
    meshes = model.geom_dataid[order]
    tolerances = np.where(meshes < 0, 1e-9, 3e-6)[:, None, None]
    inside = [  # MuJoCo moves meshes into their axes of inertia
        np.eye(4) if mesh < 0 else np.linalg.inv(matrix((model.mesh_pos[mesh], turned(model.mesh_quat[mesh]))))
        for mesh in meshes
    ]
    at = {name: model.joint(name).qposadr[0] for name in truth.all_values(dict.fromkeys(truth.free_joints(), 0.0))}
    for values, expected in urdf_truth.poses(urdf):
        for name, value in truth.all_values(values).items():
            data.qpos[at[name]] = value
        mujoco.mj_kinematics(model, data)
        found = [matrix((data.geom_xpos[g], data.geom_xmat[g])) for g in order] @ np.array(inside)
        assert np.isclose(found, urdf_truth.in_a_row(expected), rtol=1e-7, atol=tolerances).all(), file.name
    mujoco.mj_resetData(model, data)
    for _ in range(200):
        mujoco.mj_step(model, data)
    assert np.isfinite(data.qpos).all() and not any(warning.number for warning in data.warning), file.name


if __name__ == "__main__":
    warnings.simplefilter("error")
    print(mujoco.__version__)
    for each in range(1, len(sys.argv), 2):
        check(Path(sys.argv[each]), Path(sys.argv[each + 1]))
