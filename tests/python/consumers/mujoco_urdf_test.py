"""MJCF from a URDF by the real MuJoCo: what its own import of the URDF keeps, and what is to be seen beside it."""
import os
import re
import struct
import warnings
import xml.etree.ElementTree as ET
from pathlib import Path

import mjcf_truth
import mujoco
import numpy as np
import pytest

import foam

SHARED = Path(os.environ.get("FOAM_SHARED", Path(__file__).parents[4] / "shared")).resolve()
ROBOTS = [
    "panda/moveit_resources_panda_description/urdf/panda.urdf", "ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
    "iiwa/model.urdf", "jaco/kinova_description/urdf/j2s7s300.urdf", "fetch/fetch_description/robots/fetch.urdf",
    "baxter/example-robot-data/robots/baxter_description/urdf/baxter.urdf", "stretch/RE1V0/stretch_description_RE1V0_tool_stretch_gripper.urdf",
]  # fmt: skip
CORNERS = np.array([(0, 0, 0), (0.3, 0, 0), (0, 0.2, 0), (0, 0, 0.1)])
SHEET = np.array([(0, 0, 0), (0.3, 0, 0), (0, 0.2, 0), (0.3, 0.2, 0)])
FACES = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
ARM = """<?xml version="1.0"?>
<robot name="arm">
  <material name="red"><color rgba="0.9 0.1 0.2 0.5"/></material>
  <link name="base">
    <inertial><mass value="5"/><inertia ixx="0.1" iyy="0.2" izz="0.15" ixy="0.01" ixz="0" iyz="-0.02"/></inertial>
    <visual><origin xyz="0 0 0.1" rpy="0.1 0.2 0.3"/><geometry><box size="0.1 0.2 0.3"/></geometry><material name="red"/></visual>
    <visual><geometry><mesh filename="meshes/part.stl" scale="1 -2 1"/></geometry></visual>
    <visual><origin xyz="0 0 1" rpy="0.1 0 0.3"/><geometry><mesh filename="meshes/part.obj"/></geometry></visual>
    <visual><geometry><mesh filename="meshes/words.stl"/></geometry></visual>
    <visual><geometry><mesh filename="meshes/other.ply" scale="2 2 2"/></geometry><material name="red"/></visual>
    <visual><geometry><mesh filename="meshes/sheet.stl"/></geometry></visual>
    <collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>
  </link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.3" rpy="0.3 0 0.1"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="2" effort="40" velocity="2"/><dynamics damping="0.7" friction="0.3"/></joint>
  <link name="upper">
    <inertial><origin xyz="0.01 0 0.1" rpy="0.4 0.5 0.6"/><mass value="2"/><inertia ixx="0.02" iyy="0.03" izz="0.04" ixy="0.001" ixz="0" iyz="0.002"/></inertial>
    <visual><geometry><cylinder radius="0.04" length="0.3"/></geometry></visual>
    <collision><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.05" length="0.3"/></geometry></collision>
  </link>
  <joint name="spin" type="continuous"><parent link="upper"/><child link="wheel"/><origin xyz="0 0.1 0.3"/><axis xyz="0 0 1"/>
    <limit effort="9" velocity="3"/><dynamics damping="0.05"/></joint>
  <link name="wheel">
    <inertial><mass value="0.4"/><inertia ixx="0.001" iyy="0.001" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><sphere radius="0.05"/></geometry></visual>
  </link>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="finger"/><origin xyz="0 -0.1 0.3"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.04" effort="20" velocity="1"/></joint>
  <link name="finger">
    <inertial><mass value="0.2"/><inertia ixx="0.01" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius="0.02"/></geometry></collision>
  </link>
  <joint name="follow" type="prismatic"><parent link="upper"/><child link="thumb"/><origin xyz="0 -0.2 0.3"/><axis xyz="-1 0 0"/>
    <limit lower="-0.01" upper="0.05" effort="0" velocity="1"/><mimic joint="slide" multiplier="0.5" offset="0.01"/></joint>
  <link name="thumb">
    <inertial><mass value="0.2"/><inertia ixx="0.0001" iyy="0.0001" izz="0.0001" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius="0.02"/></geometry></collision>
  </link>
</robot>"""


def write_meshes(folder):
    """Write the same tetrahedron as binary and ASCII STL, OBJ and PLY, and a flat sheet."""
    folder.mkdir()
    binary = lambda facets: bytes(80) + struct.pack("<I", len(facets)) + b"".join(  # noqa: E731
        struct.pack("<12fH", 0, 0, 0, *facet.ravel(), 0) for facet in facets
    )  # fmt: skip
    (folder / "part.stl").write_bytes(binary(CORNERS[FACES]))
    (folder / "sheet.stl").write_bytes(binary(SHEET[np.array([(0, 1, 2), (1, 3, 2)])]))
    corner = lambda i: "vertex {} {} {}".format(*CORNERS[i])  # noqa: E731
    facets = (f"facet normal 0 0 0\nouter loop\n{corner(a)}\n{corner(b)}\n{corner(c)}\nendloop\nendfacet\n" for a, b, c in FACES)
    (folder / "words.stl").write_text("solid words\n" + "".join(facets) + "endsolid words\n")
    rows = [" ".join(map(str, corner)) for corner in CORNERS]
    (folder / "part.obj").write_text("".join(f"v {row}\n" for row in rows) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES))
    properties = "property float x\nproperty float y\nproperty float z\nelement face 4\nproperty list uchar int vertex_indices\n"
    head = f"ply\nformat ascii 1.0\nelement vertex 4\n{properties}end_header\n"
    (folder / "other.ply").write_text(head + "\n".join(rows) + "\n" + "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES))


@pytest.fixture(autouse=True)
def elsewhere(monkeypatch, tmp_path_factory):
    monkeypatch.chdir(tmp_path_factory.mktemp("here"))  # where MuJoCo writes down its warnings


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    folder = tmp_path_factory.mktemp("robot")
    write_meshes(folder / "meshes")
    (folder / "arm.urdf").write_text(ARM)
    return folder / "arm.urdf"


def written(urdf, file, **settings):
    """Write the robot with one sphere a link. Return the warnings."""
    file.parent.mkdir(exist_ok=True)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        robot = foam.load(urdf)
        robot.spherize(len(robot.links_with_geometry), effort="fast").save(file, set=settings)
    return [str(one.message) for one in said]


def loaded(file, capfd):
    """Return the model, of which MuJoCo says nothing."""
    log = Path("MUJOCO_LOG.TXT")
    log.unlink(missing_ok=True)
    capfd.readouterr()
    model = mujoco.MjModel.from_xml_path(str(file))
    said = capfd.readouterr()
    assert "WARNING" not in said.out + said.err and not log.exists()
    return model


def has_mass(link):
    """Return whether the URDF states a mass of a link and an inertia that is positive, which MuJoCo wants."""
    mass, inertia = link.find("inertial/mass"), link.find("inertial/inertia")
    if mass is None or inertia is None or not float(mass.get("value")) > 0:
        return False
    xx, yy, zz, xy, xz, yz = (float(inertia.get(name)) for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
    moments = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return moments[0] > 1e-14 and moments[0] > 1e-12 * moments[2]


def imported(urdf, folder):
    """Return MuJoCo's own import of a URDF, without geometry, and the links whose mass it takes from there."""
    root = ET.fromstring(re.sub(r"<!--.*?-->", "", urdf.read_text(), flags=re.S))
    stated = []
    for link in root.findall("link"):
        for geometry in link.findall("visual") + link.findall("collision"):
            link.remove(geometry)
        if has_mass(link):
            stated.append(link.get("name"))
        else:  # MuJoCo refuses to move it
            for inertial in link.findall("inertial"):
                link.remove(inertial)
            link.append(ET.fromstring('<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'))
    extension = ET.SubElement(root, "mujoco")
    ET.SubElement(extension, "compiler", fusestatic="false", balanceinertia="true")
    file = folder / "imported.urdf"
    file.write_text(ET.tostring(root, encoding="unicode"))
    return mujoco.MjModel.from_xml_path(str(file)), stated


def names(model, kind):
    return [model.__getattribute__(kind)(i).name for i in range(model.__getattribute__({"body": "nbody", "joint": "njnt"}[kind]))]


def inertia_of(model, body):
    """Return the inertia of a body about its centre in its own frame."""
    turned = mjcf_truth.matrix(model.body_iquat[body])
    return turned @ np.diag(model.body_inertia[body]) @ turned.T


def compare_joints(ours, theirs):
    assert names(ours, "joint") == names(theirs, "joint")
    for name in ("jnt_type", "jnt_range", "jnt_limited", "jnt_actfrcrange", "jnt_actfrclimited", "dof_damping", "dof_frictionloss", "dof_armature"):
        np.testing.assert_allclose(getattr(ours, name), getattr(theirs, name), rtol=1e-15, err_msg=name)
    coupled = lambda model: {  # noqa: E731
        (model.joint(model.eq_obj1id[e]).name, model.joint(model.eq_obj2id[e]).name, *model.eq_data[e][:5]) for e in range(model.neq)
    }  # fmt: skip
    assert coupled(ours) == coupled(theirs)


def compare_masses(ours, theirs, stated):
    for link in stated:
        one, other = ours.body(link).id, theirs.body(link).id
        if ours.body_dofnum[one] == 0 and theirs.body_mass[other] < 1e-12:
            continue
        np.testing.assert_allclose(ours.body_mass[one], theirs.body_mass[other], rtol=1e-15, err_msg=link)
        np.testing.assert_allclose(ours.body_ipos[one], theirs.body_ipos[other], atol=1e-12, err_msg=link)
        a, b = inertia_of(ours, one), inertia_of(theirs, other)
        np.testing.assert_allclose(a, b, atol=1e-9 * np.abs(b).max() + 3e-14, err_msg=link)


def compare_poses(ours, theirs):
    random = np.random.default_rng(3)
    one, other = mujoco.MjData(ours), mujoco.MjData(theirs)
    for _ in range(20):
        one.qpos = other.qpos = random.uniform(-1, 1, ours.nq)
        mujoco.mj_kinematics(ours, one)
        mujoco.mj_kinematics(theirs, other)
        np.testing.assert_allclose(one.xpos, other.xpos, rtol=0, atol=1e-9)
        np.testing.assert_allclose(one.xmat, other.xmat, rtol=0, atol=1e-9)


def compare(ours, theirs, stated):
    assert names(ours, "body") == names(theirs, "body")
    compare_joints(ours, theirs)
    compare_masses(ours, theirs, stated)
    compare_poses(ours, theirs)


def geoms(model, body, contact):
    return [g for g in range(model.ngeom) if model.geom_bodyid[g] == model.body(body).id and bool(model.geom_contype[g]) == contact]


def check_geoms(model):
    """Check that something of each body with geoms is seen at first look, and that what is only seen weighs nothing."""
    for b in range(model.nbody):
        own = [g for g in range(model.ngeom) if model.geom_bodyid[g] == b]
        looks = [g for g in own if not model.geom_contype[g] and not model.geom_conaffinity[g]]
        assert all(model.geom_group[g] == 2 for g in looks)
        assert all(model.geom_group[g] == (3 if looks else 0) for g in set(own) - set(looks))


def test_what_mujoco_keeps_of_a_urdf(arm, tmp_path, capfd):
    said = written(arm, tmp_path / "out" / "arm.xml")
    ours = loaded(tmp_path / "out" / "arm.xml", capfd)
    theirs, stated = imported(arm, tmp_path)
    compare(ours, theirs, stated)
    check_geoms(ours)
    assert ours.joint("follow").range.tolist() == [-0.01, 0.05]
    refused = [one for one in said if "MuJoCo" in one]
    assert len(refused) == 1 and re.search(r"states for finger \(.*arm.urdf:\d+\): a principal moment.*balanceinertia", refused[0])


def test_visuals_are_seen_where_they_are(arm, tmp_path, capfd):
    written(arm, tmp_path / "out" / "arm.xml")
    model = loaded(tmp_path / "out" / "arm.xml", capfd)
    box, *meshes = geoms(model, "base", False)
    np.testing.assert_allclose(model.geom_size[box], [0.05, 0.1, 0.15])
    np.testing.assert_allclose(model.geom_rgba[box], [0.9, 0.1, 0.2, 0.5], rtol=1e-6)
    assert len(meshes) == 5
    turned = mjcf_truth.about((0, 0, 1), 0.3) @ mjcf_truth.about((1, 0, 0), 0.1)
    wanted = [CORNERS * (1, -2, 1), CORNERS @ turned.T + (0, 0, 1), CORNERS, 2 * CORNERS, SHEET]
    for geom, corners in zip(meshes, wanted, strict=True):
        mesh = model.geom_dataid[geom]
        first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        placed = model.mesh_vert[first : first + count] @ mjcf_truth.matrix(model.geom_quat[geom]).T + model.geom_pos[geom]
        order = lambda points: points[np.lexsort(np.round(points, 5).T)]  # noqa: E731
        np.testing.assert_allclose(order(np.unique(placed.round(6), axis=0)), order(corners), atol=1e-5)
    np.testing.assert_allclose(model.geom_rgba[meshes[3]], [0.9, 0.1, 0.2, 0.5], rtol=1e-6)
    made = sorted(path.name for path in (tmp_path / "out" / "arm_visuals").iterdir())
    assert made == ["other.obj", "words.obj"]


def test_a_file_without_visuals_stands_alone(arm, tmp_path):
    written(arm, tmp_path / "out" / "arm.xml", visuals=False)
    model = mujoco.MjModel.from_xml_string((tmp_path / "out" / "arm.xml").read_text())
    assert model.ngeom == 4 and not model.geom_group.any() and not (tmp_path / "out" / "arm_visuals").exists()
    with warnings.catch_warnings(action="ignore"):
        text = foam.load(arm).spherize(4, effort="fast").to_mujoco()
    assert mujoco.MjModel.from_xml_string(text).ngeom == 4


def test_visuals_that_cannot_be_shown_are_named(tmp_path, capfd):
    (tmp_path / "ball.urdf").write_text(
        '<robot name="ball"><link name="ball"><collision><geometry><sphere radius="1"/></geometry></collision>'
        '<visual><geometry><mesh filename="lost.stl"/></geometry></visual></link></robot>'
    )
    said = written(tmp_path / "ball.urdf", tmp_path / "out" / "ball.xml")
    model = loaded(tmp_path / "out" / "ball.xml", capfd)
    assert any("visual geometry is left out of ball: their meshes are not found; remedy:" in one for one in said)
    check_geoms(model)
    assert model.geom_group.tolist() == [0]


def random_inertia(random, surplus):
    """Return an inertia in turned axes whose two lesser moments exceed the largest by a part of it."""
    a, b = random.uniform(0.1, 1, 2) * 10.0 ** random.integers(-6, 3)
    turned = np.empty(9)
    mujoco.mju_quat2Mat(turned, random.normal(size=4) / 3)
    turned = np.linalg.qr(turned.reshape(3, 3))[0]
    return turned @ np.diag([a, b, (a + b) * (1 - surplus)]) @ turned.T


def plates(inertias):
    """Return a URDF of bodies with these inertias that hang on one base."""
    text = '<robot name="plates"><link name="base"><collision><geometry><sphere radius="1"/></geometry></collision></link>'
    for i, m in enumerate(inertias):
        moments = f'ixx="{m[0, 0]!r}" iyy="{m[1, 1]!r}" izz="{m[2, 2]!r}" ixy="{m[0, 1]!r}" ixz="{m[0, 2]!r}" iyz="{m[1, 2]!r}"'
        text += f"""<link name="p{i}"><inertial><mass value="1"/><inertia {moments}/></inertial></link>
            <joint name="j{i}" type="continuous"><parent link="base"/><child link="p{i}"/></joint>"""
    return re.sub(r"np\.float64\(([^)]*)\)", r"\1", text) + "</robot>"


@pytest.mark.parametrize("surplus", [0, 1e-16, -1e-15, -1e-13, -1e-10, 1e-15])
def test_plates_are_bodies_whatever_rounding_says(surplus, tmp_path, capfd):
    random = np.random.default_rng(1)
    wanted = [random_inertia(random, surplus) for _ in range(60)]
    (tmp_path / "plates.urdf").write_text(plates(wanted))
    said = written(tmp_path / "plates.urdf", tmp_path / "plates.xml")
    model = loaded(tmp_path / "plates.xml", capfd)
    assert not any("inertia that" in one for one in said)
    for i, inertia in enumerate(wanted):
        np.testing.assert_allclose(inertia_of(model, model.body(f"p{i}").id), inertia, atol=1e-9 * np.abs(inertia).max())


def test_what_no_body_has_is_balanced_as_mujoco_does(tmp_path, capfd):
    random = np.random.default_rng(2)
    (tmp_path / "plates.urdf").write_text(plates([random_inertia(random, -wrong) for wrong in (1e-6, 0.01, 0.5, 3)]))
    said = written(tmp_path / "plates.urdf", tmp_path / "plates.xml")
    ours = loaded(tmp_path / "plates.xml", capfd)
    compare(ours, *imported(tmp_path / "plates.urdf", tmp_path))
    assert sum("balanceinertia" in one and all(f"p{i} (" in one for i in range(4)) for one in said) == 1


def test_links_that_move_without_mass_are_named(tmp_path, capfd):
    link = '<link name="{}"/>'.format
    joint = '<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{0}"/></joint>'.format
    mass = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    (tmp_path / "bare.urdf").write_text(
        '<robot name="bare"><link name="base"><collision><geometry><sphere radius="1"/></geometry></collision></link>'
        + link("a") + link("b") + f'<link name="c">{mass}</link>' + link("d")
        + joint("a", "continuous", "base") + joint("b", "continuous", "a") + joint("c", "fixed", "b") + joint("d", "fixed", "c") + "</robot>"
    )  # fmt: skip
    said = written(tmp_path / "bare.urdf", tmp_path / "bare.xml")
    model = loaded(tmp_path / "bare.xml", capfd)
    assert model.body("a").mass[0] == 1e-6 and model.body("b").mass[0] == 0, "c weighs for b"
    assert any(re.search(r"a millionth of a kilogram: a; remedy", one) for one in said)


def test_actuators(arm, tmp_path, capfd):
    made = {}
    for kind in ("none", "position", "velocity", "motor"):
        written(arm, tmp_path / f"{kind}.xml", actuators=kind)
        made[kind] = loaded(tmp_path / f"{kind}.xml", capfd)
    assert made["none"].nu == 0
    for kind in ("position", "velocity", "motor"):
        model = made[kind]
        assert [model.actuator(a).name for a in range(model.nu)] == ["turn", "spin", "slide"], "one that follows has none"
        assert [model.joint(model.actuator_trnid[a][0]).name for a in range(model.nu)] == ["turn", "spin", "slide"]
    servo = made["position"]
    # The finger is light: its servo is as fast as 200 rad/s. So is the wheel with that of the velocity.
    np.testing.assert_allclose(servo.actuator_gainprm[:, 0], [40 / (0.02 * 3.5), 9 / (0.02 * 2 * np.pi), 4e4 * 0.2], rtol=1e-9)
    np.testing.assert_allclose(servo.actuator_ctrlrange, [[-1.5, 2], [0, 0], [0, 0.04]])
    np.testing.assert_allclose(servo.actuator_forcerange, [[-40, 40], [-9, 9], [-20, 20]])
    np.testing.assert_allclose(made["velocity"].actuator_gainprm[:, 0], [40 / 2, 200 * 0.002, 20 / 1], rtol=1e-9)
    np.testing.assert_allclose(made["velocity"].actuator_ctrlrange, [[-2, 2], [-3, 3], [-1, 1]])
    np.testing.assert_allclose(made["motor"].actuator_ctrlrange, [[-40, 40], [-9, 9], [-20, 20]])


def reflected(model):
    """Return the inertia that each actuator moves, in the rest pose."""
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    found, force = [], np.zeros(model.nv)
    for dof in model.jnt_dofadr[model.actuator_trnid[:, 0]]:
        mujoco.mj_mulM(model, data, force, np.eye(model.nv)[dof])
        found.append(force[dof])
    return np.array(found)


def held(model, seconds):
    """Return how far the joints that have servos are from their targets after some time, as a part of their range."""
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    while data.time < seconds:
        mujoco.mj_step(model, data)
    assert np.isfinite(data.qpos).all() and not any(warning.number for warning in data.warning)
    joints = model.actuator_trnid[:, 0]
    span = np.where(model.jnt_limited[joints], np.ptp(model.jnt_range[joints], axis=1), 2 * np.pi)
    return np.abs(data.qpos[model.jnt_qposadr[joints]] - data.ctrl) / span, np.abs(data.qvel).max()


def test_servos_hold_the_rest_pose(arm, tmp_path, capfd):
    written(arm, tmp_path / "arm.xml", actuators="position")
    error, velocity = held(loaded(tmp_path / "arm.xml", capfd), 2)
    assert error.max() < 0.02 and velocity < 1e-2


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.split("/")[0])
def test_robots(robot, tmp_path, capfd):
    urdf = SHARED / "robots" / robot
    if not urdf.is_file():
        pytest.skip(f"{urdf} is not there; FOAM_SHARED names the folder of robots")
    written(urdf, tmp_path / "out" / "robot.xml", actuators="position")
    ours = loaded(tmp_path / "out" / "robot.xml", capfd)
    compare(ours, *imported(urdf, tmp_path))
    check_geoms(ours)
    assert (ours.actuator_gainprm[:, 0] <= 200**2 * reflected(ours) * (1 + 1e-9)).all()
    assert (ours.geom_group == 2).sum() == len(ET.parse(urdf).findall("link/visual"))
    held(ours, 1)
