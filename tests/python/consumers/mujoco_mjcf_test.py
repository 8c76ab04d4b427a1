"""load.mjcf against the real MuJoCo: geoms with contact, their form and place, and world poses at random positions."""
import struct

import mjcf_truth
import mujoco
import numpy as np
import pytest

import foam

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
#: An L with a lump: no axis of inertia lies along an axis of the file.
LUMP = " ".join(f"{x} {y} {z}" for x, y, z in [
    (0, 0, 0), (0.3, 0, 0.02), (0.3, 0.1, 0), (0, 0.12, 0), (0, 0, 0.2), (0.28, 0, 0.21), (0.3, 0.11, 0.2), (0, 0.1, 0.25)
])  # fmt: skip
FACES = "0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7"
HAND = f"""<mujoco model="hand"><compiler angle="radian" eulerseq="zyx"/>
  <default><geom size="0.02"/><default class="soft"><geom type="capsule" size="0.01 0.03"/></default></default>
  <asset><mesh name="lump" vertex="{LUMP}" face="{FACES}" scale="0.2 0.2 -0.3"/></asset>
  <contact><pair geom1="tip" geom2="palm_geom"/></contact>
  <worldbody><geom pos="0 0 1"/><frame pos="0.1 0 0" euler="0.3 0 0"><body name="palm" pos="0 0.1 0" childclass="soft">
    <joint name="wrist" axis="1 0 0" range="-1 1"/><geom name="palm_geom" type="mesh" mesh="lump"/>
    <frame name="side" pos="0.1 0 0" euler="0 0.5 0"><geom/><body name="finger" pos="0 0 0.1"><joint name="bend"/>
      <geom name="tip" contype="0" conaffinity="0"/></body></frame></body></frame></worldbody></mujoco>"""

MODELS = {
    "joints": """<worldbody><body name="a" pos="1 0 0" euler="10 20 30"><joint type="slide" axis="0 1 2" range="-1 2" ref="0.5"/>
        <joint axis="1 1 0" pos="0.5 0.2 0.1" range="-90 45"/><joint axis="1 0 0" ref="30"/><geom size="0.1"/>
        <body pos="0 0 1"><joint type="ball" pos="0 0 0.1"/><geom type="box" size="0.1 0.2 0.3"/>
        </body><body><frame pos="1 2 3" euler="0 0 90"><joint axis="1 0 0" pos="0 0 0.3"/></frame><geom size="0.1" pos="0 1 0"/></body></body>
        <body name="free" pos="0 0 3"><freejoint/><geom size="0.2"/><body><joint type="slide" axis="1 0 0"/><geom size="0.1"/></body></body>
        <body mocap="true" pos="1 1 1" euler="0 0 45"><geom size="0.1"/></body></worldbody>""",
    "primitives": """<default><geom size="0.3 0.2"/><default class="turned"><geom euler="90 0 0"/></default></default><worldbody>
        <geom type="capsule"/><geom type="cylinder" size="0.1" class="turned"/><geom type="box" size="0.1 0.2 0.3" zaxis="1 1 1"/>
        <geom type="ellipsoid" size="0.1 0.2 0.3" xyaxes="1 1 0 0 0 1" pos="1 0 0"/><geom type="capsule" size="0.1" fromto="0 0 0 1 2 3"/>
        <geom type="box" size="0.1" fromto="0 0 0 1 2 3"/><geom type="ellipsoid" size="0.1" fromto="0 0 0 0 0 -3"/>
        <geom axisangle="1 2 3 40" class="turned" type="box" size="0.1 0.2 0.3"/><geom quat="1 0 0 1" class="turned" type="cylinder"/>
        <geom type="plane" size="1 1 1"/><geom contype="0" conaffinity="0"/><geom contype="0"/></worldbody>""",
    "replicas": """<compiler eulerseq="XYZ"/><worldbody><replicate count="4" offset="0.5 0.1 0" euler="0 20 50" sep="-"><body name="r" pos="1 0 0">
        <joint name="j"/><geom name="g" type="box" size="0.1 0.2 0.3" euler="10 20 30"/><replicate count="3" offset="0 0 0.3" euler="0 0 10"><body pos="0.2 0 0">
        <joint name="k" axis="0 1 0" pos="0 0 0.1"/><geom type="capsule" size="0.05 0.1"/></body></replicate></body></replicate>
        <body name="b"><frame pos="1 1 1" euler="0 30 0"><replicate count="12" offset="0.1 0 0" euler="5 0 0"><geom type="box" size="0.01 0.02 0.03"/></replicate>
        </frame></body></worldbody>""",
    "meshes": f"""<asset><mesh name="a" vertex="{LUMP}"/><mesh name="b" vertex="{LUMP}" face="{FACES}" refpos="0.1 0.2 0.3" refquat="1 2 3 4" scale="1 -2 3"/>
        <mesh file="t.obj" scale="0.1 0.1 0.1"/><mesh name="s" vertex="{LUMP}" face="{FACES}" inertia="shell"/></asset><worldbody>
        <geom type="mesh" mesh="a" pos="1 2 3" euler="10 20 30"/><geom type="mesh" mesh="b" euler="30 0 0"/><geom type="mesh" mesh="t"/>
        <body><joint axis="1 0 0"/><geom type="mesh" mesh="s"/></body></worldbody>""",
    "fitted": f"""<asset><mesh name="l" vertex="{LUMP}" face="{FACES}" scale="1 1 -2"/><mesh name="e" vertex="{LUMP}" face="{FACES}" inertia="exact"/>
        <mesh name="s" vertex="{LUMP}" face="{FACES}" inertia="shell"/><mesh name="c" vertex="{LUMP}" inertia="convex" refquat="1 1 0 0"/></asset><worldbody>
        {{}}</worldbody>""",
    "models": """<asset><model name="h" file="hand.xml"/></asset><worldbody>
        <body name="arm" pos="0 0 2" euler="0 40 0"><joint axis="0 1 0"/><geom size="0.1"/><attach model="h" body="palm" prefix="left_"/></body>
        <frame pos="5 0 0" euler="0 0 70"><attach model="h" body="finger" prefix="f_"/><attach model="h" prefix="all_"/></frame>
        <body name="side"><attach model="h" frame="side" prefix="s_"/></body></worldbody>""",
}  # fmt: skip
MODELS["fitted"] = MODELS["fitted"].format("".join(
    f'<geom type="{kind}" mesh="{mesh}" pos="0.1 0 0" euler="0 0 30" fitscale="{scale}"/>'
    for kind in mjcf_truth.KINDS.values() for mesh in "lesc" for scale in (1, 1.5)
))  # fmt: skip
MODELS["fitted_by_box"] = '<compiler fitaabb="true"/>' + MODELS["fitted"]


@pytest.mark.parametrize("name", MODELS)
def test_foam_reads_what_mujoco_compiles(name, tmp_path):
    (tmp_path / "t.obj").write_text(TETRAHEDRON)
    (tmp_path / "hand.xml").write_text(HAND)
    file = tmp_path / f"{name}.xml"
    file.write_text(f"<mujoco>{MODELS[name]}</mujoco>")
    model = mujoco.MjModel.from_xml_path(str(file))
    assert mjcf_truth.compare(foam.load(file), model, tmp_path) > 0


def test_a_geom_with_a_mesh_and_no_type_is_a_sphere(tmp_path):
    file = tmp_path / "sphere.xml"
    file.write_text(f'<mujoco><asset><mesh name="m" vertex="{LUMP}"/></asset><worldbody><geom mesh="m"/></worldbody></mujoco>')
    assert mjcf_truth.compare(foam.load(file), mujoco.MjModel.from_xml_path(str(file)), tmp_path) == 1


def test_msh_files_are_read(tmp_path):
    vertices = np.array(LUMP.split(), np.float32)
    faces = np.array(FACES.split(), np.int32)
    (tmp_path / "m.msh").write_bytes(struct.pack("<4i", 8, 0, 0, 12) + vertices.tobytes() + faces.tobytes())
    file = tmp_path / "msh.xml"
    file.write_text('<mujoco><asset><mesh file="m.msh"/></asset><worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>')
    assert mjcf_truth.compare(foam.load(file), mujoco.MjModel.from_xml_path(str(file)), tmp_path) == 1
