"""Compare what foam reads from an MJCF with what MuJoCo compiles: bodies, joints, geoms with contact, world poses."""
import struct
from pathlib import Path

import mujoco
import numpy as np

import foam

GEOM = mujoco.mjtGeom
KINDS = {
    int(GEOM.mjGEOM_SPHERE): "sphere", int(GEOM.mjGEOM_CAPSULE): "capsule", int(GEOM.mjGEOM_CYLINDER): "cylinder",
    int(GEOM.mjGEOM_BOX): "box", int(GEOM.mjGEOM_ELLIPSOID): "ellipsoid",
}  # fmt: skip
GROUND = (int(GEOM.mjGEOM_PLANE), int(GEOM.mjGEOM_HFIELD))
NUMBERS = {
    "sphere": lambda s: {"radius": s[0]}, "capsule": lambda s: {"radius": s[0], "length": 2 * s[1]},
    "cylinder": lambda s: {"radius": s[0], "length": 2 * s[1]}, "box": lambda s: {"size": 2 * s},
    "ellipsoid": lambda s: {"radii": s},
}  # fmt: skip
#: How much of an orientation a kind has: nothing, an axis, or all.
TURNED = {"sphere": 0, "capsule": 1, "cylinder": 1, "box": 3, "ellipsoid": 3}


def collides(model):
    """Return the geoms that touch something, without planes and height fields, by body."""
    paired = set(model.pair_geom1) | set(model.pair_geom2)
    geoms = {}
    for g in range(model.ngeom):
        ground = int(model.geom_type[g]) in GROUND
        if not ground and (model.geom_contype[g] or model.geom_conaffinity[g] or g in paired):
            geoms.setdefault(int(model.geom_bodyid[g]), []).append(g)
    return geoms


def name_of(name, word, number):
    return name or f"{word}_{number}"


def matrix(quat):
    result = np.empty(9)
    mujoco.mju_quat2Mat(result, np.asarray(quat, float))
    return result.reshape(3, 3)


def about(axis, angle):
    quat = np.empty(4)
    mujoco.mju_axisAngle2Quat(quat, np.asarray(axis, float), angle)
    return matrix(quat)


def link_poses(robot, values):
    """Return the pose of each link of foam's robot in its root."""
    poses = {robot.root: (np.zeros(3), np.eye(3))}
    for joint in robot.joints:  # foam lists a joint behind those above it
        at, turned = poses[joint.parent]
        at, turned = at + turned @ np.array(joint.xyz), turned @ np.array(joint.rotation)
        value = values.get(joint.name, 0.0)
        if joint.kind in ("revolute", "continuous"):
            turned = turned @ about(joint.axis, value)
        elif joint.kind == "prismatic":
            at = at + turned @ (np.array(joint.axis) * value)
        poses[joint.child] = (at, turned)
    return poses


def random_values(robot, model, random):
    """Return qpos, and the same by joint, uniform within the limits. Joints that float stay where they start."""
    kinds = {joint.name: joint for joint in robot.joints}
    qpos, values = model.qpos0.copy(), {}
    for j in range(model.njnt):
        name = name_of(model.joint(j).name, "joint", j)
        if kinds[name].kind == "floating":
            continue
        low, high = (kinds[name].lower, kinds[name].upper) if kinds[name].kind != "continuous" else (-np.pi, np.pi)
        if model.jnt_limited[j]:
            np.testing.assert_allclose((low, high), model.jnt_range[j], rtol=1e-14, atol=1e-15)
        values[name] = qpos[model.jnt_qposadr[j]] = random.uniform(low, high)
    return qpos, values


def authored_pose(model, g):
    """Return the pose of a mesh in its body as the file states it: MuJoCo moves meshes into their axes of inertia."""
    mesh = model.geom_dataid[g]
    turned = matrix(model.geom_quat[g]) @ matrix(model.mesh_quat[mesh]).T
    return model.geom_pos[g] - turned @ model.mesh_pos[mesh], turned


def vertices_of_file(path):
    """Return the vertices of an STL, OBJ or MSH file in single precision, as MuJoCo keeps them; None of another."""
    data, ending = path.read_bytes(), path.suffix.lower()
    if ending == ".stl" and len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        facets = np.frombuffer(data, np.uint8, offset=84).reshape(-1, 50)[:, 12:48]
        return np.frombuffer(facets.tobytes(), "<f4").reshape(-1, 3).astype(float)
    if ending == ".obj":
        lines = (line.split() for line in data.decode(errors="replace").splitlines())
        return np.array([line[1:4] for line in lines if line[:1] == ["v"]], np.float32).astype(float)
    if ending == ".msh":
        return np.frombuffer(data, "<f4", 3 * struct.unpack_from("<i", data)[0], 16).reshape(-1, 3).astype(float)
    return None


def file_of(model, mesh, folder):
    """Return the file of a mesh; None for one without, or that is not there."""
    at = model.mesh_pathadr[mesh]
    path = folder / model.paths[at : model.paths.index(b"\0", at)].decode() if at >= 0 else None
    return path if path and path.is_file() else None


def check_mesh(model, g, vertices, tolerance, folder):
    """Check the hull of a mesh along many directions. The file has it exactly; what MuJoCo compiled is rounded."""
    mesh = model.geom_dataid[g]
    file = file_of(model, mesh, folder)
    raw = vertices_of_file(file) if file else None
    if raw is not None:
        at, turned = authored_pose(model, g)
        theirs = (raw * model.mesh_scale[mesh]) @ turned.T + at
    else:
        first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        compiled = model.mesh_vert[first : first + count].astype(float)
        theirs = compiled @ matrix(model.geom_quat[g]).T + model.geom_pos[g]
        tolerance += 1e-6 * np.abs(compiled).max()
    directions = np.random.default_rng(1).normal(size=(200, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    gaps = np.abs((vertices @ directions.T).max(axis=0) - (theirs @ directions.T).max(axis=0))
    assert gaps.max() <= tolerance, f"hull of geom {g} differs by {gaps.max()}, more than {tolerance}"


def check_primitive(model, g, part, tolerance):
    kind = KINDS.get(int(model.geom_type[g]))
    assert part["kind"] == kind, f"geom {g}: {part['kind']}, not {kind}"
    for key, value in NUMBERS[kind](model.geom_size[g]).items():
        np.testing.assert_allclose(part[key], value, rtol=1e-9, atol=tolerance, err_msg=f"geom {g} {key}")
    np.testing.assert_allclose(part["position"], model.geom_pos[g], rtol=0, atol=tolerance, err_msg=f"geom {g}")
    turned = matrix(model.geom_quat[g])
    if TURNED[kind]:
        ours = np.array(part["rotation"]).reshape(3, 3)
        columns = [2] if TURNED[kind] == 1 else [0, 1, 2]
        for column in columns:
            np.testing.assert_allclose(
                ours[:, column], turned[:, column], rtol=0, atol=1e-9, err_msg=f"geom {g} axis {column}"
            )


def compare(robot, model, folder, poses=20, seed=0):
    """Raise AssertionError where foam and MuJoCo differ. Return the number of geoms with contact."""
    geoms = collides(model)
    links = {name_of(model.body(b).name, "body", b): b for b in range(model.nbody)}
    ours = {link: robot._core.parts(link) for link in robot.links_with_geometry}
    theirs = {link: len(geoms.get(b, [])) for link, b in links.items() if geoms.get(b)}
    counted = {link: len(parts) for link, parts in ours.items()}
    assert counted == theirs, f"geoms with contact: {set(counted.items()) ^ set(theirs.items())}"
    size = max(1e-9, model.stat.extent, np.abs(model.geom_pos).max(initial=0))
    for link, parts in ours.items():
        for g, part in zip(geoms[links[link]], parts):
            if part["kind"] == "mesh":
                check_mesh(model, g, foam.Mesh._of(part["mesh"]).vertices, 1e-9 * size, Path(folder))
            else:
                check_primitive(model, g, part, 1e-9 * size)
    data, random = mujoco.MjData(model), np.random.default_rng(seed)
    for _ in range(poses):
        qpos, values = random_values(robot, model, random)
        data.qpos = qpos
        mujoco.mj_kinematics(model, data)
        found = link_poses(robot, values)
        reach = max(size, np.abs(data.xpos).max())
        for link, b in links.items():
            at, turned = found[link]
            np.testing.assert_allclose(at, data.xpos[b], rtol=0, atol=1e-9 * reach, err_msg=f"body {link}")
            np.testing.assert_allclose(turned, data.xmat[b].reshape(3, 3), rtol=0, atol=1e-9, err_msg=f"body {link}")
    return sum(theirs.values())
