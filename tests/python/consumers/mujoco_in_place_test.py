"""MJCF in place, by the real MuJoCo: the file that foam writes compiles to the same model with other geoms in contact."""
import os
import pathlib

import mujoco
import numpy as np
import pytest
from mujoco_mjcf_test import FACES, LUMP

import foam

CLASSES = """<mujoco><default>
    <geom friction="0.9 0.02 0.003"/><joint damping="0.3" armature="0.01"/>
    <default class="skin"><geom type="capsule" size="0.03" condim="4" solref="0.03 1.1" solimp="0.8 0.9 0.002" margin="0.001" rgba="0.1 0.7 0.3 1"/></default>
    <default class="looks"><geom contype="0" conaffinity="0" group="2" density="300"/></default>
  </default></mujoco>"""
MOTORS = """<mujoco><actuator>
    <position name="p" joint="shoulder" kp="40" ctrlrange="-1 1"/><motor name="m" tendon="cable" gear="3"/>
    <velocity name="v" joint="elbow" kv="2" class="main"/><general name="g" site="tool" gear="0 0 1 0 0 0" gainprm="2"/>
  </actuator></mujoco>"""
ARM = f"""<?xml version="1.0"?>
<!-- An arm that uses much of MJCF. -->
<mujoco model="arm">
  <compiler angle="radian" eulerseq="zyx"/>
  <option timestep="0.001" integrator="implicitfast" gravity="0 0.1 -9.7"/>
  <include file="classes.xml"/>
  <asset><mesh name="lump" vertex="{LUMP}" face="{FACES}" scale="0.5 0.5 0.6"/><material name="red" rgba="0.9 0.1 0.1 1"/></asset>
  <worldbody>
    <light pos="0 0 3"/><camera name="eye" pos="1 1 1"/><geom name="floor" type="plane" size="3 3 0.1" pos="0 0 -1"/>
    <body name="base" pos="0 0 0.1" euler="0.2 0 0">
      <geom name="foot" type="cylinder" size="0.12 0.06" friction="0.5 0.01 0.002" density="2700"/>
      <frame name="turned" pos="0 0 0.06" euler="0 0.1 0.3">
        <body name="upper" childclass="skin" gravcomp="0.5">
          <joint name="shoulder" axis="0 1 0" range="-1.5 1.5" limited="true" frictionloss="0.2" stiffness="1" springref="0.1"/>
          <geom name="bone" fromto="0 0 0.05 0 0 0.35" mass="1.3"/>
          <geom class="looks" type="mesh" mesh="lump" material="red"/>
          <site name="mount" pos="0 0.05 0.2"/>
          <body name="fore" pos="0 0 0.4" quat="1 0.1 0 0">
            <inertial pos="0.01 0 0.1" mass="0.7" fullinertia="0.01 0.012 0.004 0.0001 0 0.0002"/>
            <joint name="elbow" axis="0 1 0.1" range="-2 2" limited="true" ref="0.2"/>
            <frame pos="0 0 0.02"><geom type="mesh" mesh="lump" solref="0.05 1" priority="2"/></frame>
            <geom type="box" size="0.03 0.04 0.05" pos="0 0 0.3"/>
            <site name="tool" pos="0 0 0.4"/>
          </body>
        </body>
      </frame>
    </body>
    <body name="ball" pos="0.6 0 1"><freejoint/><geom name="ball" size="0.07" condim="6" solimp="0.7 0.8 0.01"/></body>
    <body name="target" mocap="true" pos="0 0.5 0.5"><geom class="looks" size="0.02"/></body>
  </worldbody>
  <include file="motors.xml"/>
  <tendon><spatial name="cable" limited="true" range="0 2"><site site="mount"/><site site="tool"/></spatial>
    <fixed name="both"><joint joint="shoulder" coef="1"/><joint joint="elbow" coef="-0.5"/></fixed></tendon>
  <equality><weld body1="target" body2="ball" active="false"/><joint joint1="elbow" joint2="shoulder" polycoef="0 0.5 0 0 0" active="false"/></equality>
  <contact><exclude body1="base" body2="upper"/><exclude body1="upper" body2="fore"/><pair geom1="floor" geom2="ball" friction="2 2 0.1 0.1 0.1"/></contact>
  <sensor><jointpos joint="elbow"/><framepos objtype="site" objname="tool"/><touch site="tool"/><subtreecom body="base"/></sensor>
  <keyframe><key name="home" qpos="0.3 -0.4 0.6 0 1 1 0 0 0" ctrl="0.3 0 0 0"/></keyframe>
</mujoco>
"""

#: Fields that tell of geoms and their size, of the assets of new ones, of text, or where something lies in a list of geoms.
ABOUT_GEOMS = ("geom", "mesh", "polygon", "dof_length", "bvh", "text", "oct", "name", "path", "adr", "buffer", "signature", "stat", "pair")


@pytest.fixture
def arm(tmp_path):
    (tmp_path / "classes.xml").write_text(CLASSES)
    (tmp_path / "motors.xml").write_text(MOTORS)
    (tmp_path / "arm.xml").write_text(ARM)
    return tmp_path / "arm.xml"


def numbers(model):
    """Returns the numbers of the compiled model that are not about geoms, as bytes by field."""
    fields = {name: getattr(model, name) for name in dir(model) if not name.startswith("_") and not any(part in name for part in ABOUT_GEOMS)}
    found = {name: np.asarray(value).tobytes() for name, value in fields.items() if isinstance(value, (int, float, np.ndarray))}
    for name in dir(model.opt):
        value = getattr(model.opt, name)
        if isinstance(value, (int, float, np.ndarray)):
            found["opt." + name] = np.asarray(value).tobytes()
    return found


def pairs(model):
    """Returns the pairs of geoms in <pair>; the floor by its name."""
    number = lambda geom: "floor" if model.geom(geom).name == "floor" else int(geom)  # noqa: E731
    return {frozenset((number(one), number(other))) for one, other in zip(model.pair_geom1, model.pair_geom2, strict=True)}


def in_contact(model, geom):
    return model.geom_contype[geom] != 0 or model.geom_conaffinity[geom] != 0


def geoms(model, body, contact):
    """Returns the geoms of a body with or without contact."""
    return [geom for geom in range(model.ngeom) if model.geom_bodyid[geom] == model.body(body).id and in_contact(model, geom) == contact]


def settings(model, geom):
    """Returns what contact and the eye take from a geom, but not its shape and place."""
    names = ("contype", "conaffinity", "condim", "group", "priority", "solmix", "solref", "solimp", "margin", "gap", "friction", "rgba", "matid")
    return {name: np.asarray(getattr(model, "geom_" + name)[geom]).tolist() for name in names}


def elements(arm, kind):
    loaded = foam.load(arm)
    return loaded.spherize(24, effort="fast") if kind == "sphere" else loaded.approximate(16, kinds=[kind], effort="fast")


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("kind", ["sphere", "capsule", "cylinder", "box", "hull"])
def test_all_but_the_geoms_in_contact_stays(kind, arm, tmp_path):
    after_file = tmp_path / "after.xml"
    elements(arm, kind).save(after_file)
    before, after = (mujoco.MjModel.from_xml_path(str(file)) for file in (arm, after_file))
    old, new = numbers(before), numbers(after)
    assert len(old) > 250 and {"body_mass", "body_inertia", "dof_armature", "actuator_gear", "key_qpos", "nexclude"} <= set(old)
    assert [name for name in old if old[name] != new[name]] == []
    assert before.exclude_signature.tolist() == after.exclude_signature.tolist()
    assert pairs(after) == {frozenset(("floor", geom)) for geom in geoms(after, "ball", True)}
    for body in ("upper", "target", "world"):  # a geom that weighs stays beside the elements
        stay = [settings(after, geom) for geom in geoms(after, body, False)]
        assert all(settings(before, geom) in stay for geom in geoms(before, body, False))
    floor = (model.geom("floor") for model in (before, after))
    assert len({(tuple(geom.size), tuple(geom.pos), tuple(geom.quat)) for geom in floor}) == 1


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("kind", ["sphere", "capsule", "hull"])
def test_new_geoms_have_the_settings_of_the_old(kind, arm, tmp_path):
    after_file = tmp_path / "after.xml"
    elements(arm, kind).save(after_file)
    before, after = (mujoco.MjModel.from_xml_path(str(file)) for file in (arm, after_file))
    for body in ("base", "upper", "fore", "ball"):
        wanted = settings(before, geoms(before, body, True)[0])
        made = geoms(after, body, True)
        assert made
        assert all(settings(after, geom) == wanted for geom in made), body


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("kind", ["sphere", "capsule", "cylinder", "box", "hull"])
def test_what_touched_the_robot_touches_its_elements(kind, arm, tmp_path):
    after_file = tmp_path / "after.xml"
    elements(arm, kind).save(after_file)
    before, after = (probed(file) for file in (arm, after_file))
    random = np.random.default_rng(7)
    seen = 0
    for _ in range(3000):
        pose = np.concatenate([random.uniform(-1.5, 1.5, 2), [0.3, 0.3, 0.3, 1, 0, 0, 0]])
        where = random.uniform([-0.3, -0.3, 0], [0.4, 0.4, 0.9])
        touched = touches(*before, pose, where)
        seen += len(touched)
        assert touched <= touches(*after, pose, where)
    assert seen > 100


def probed(file):
    """Returns the model of a file with a small ball as a probe in its mocap body, and its data."""
    spec = mujoco.MjSpec.from_file(str(file))
    spec.body("target").add_geom(name="probe", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.04, 0, 0])
    model = spec.compile()
    return model, mujoco.MjData(model)


def touches(model, data, pose, where):
    """Returns the bodies that the probe touches."""
    data.qpos[:] = pose
    data.mocap_pos[0] = where
    mujoco.mj_forward(model, data)
    probe = model.geom("probe").id
    with_probe = [contact.geom for contact in data.contact if probe in contact.geom and contact.dist <= 0]
    return {int(model.geom_bodyid[pair[0] if pair[1] == probe else pair[1]]) for pair in with_probe}


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("kind", ["sphere", "capsule", "hull"])
def test_two_hundred_steps_are_finite(kind, arm, tmp_path):
    after_file = tmp_path / "after.xml"
    elements(arm, kind).save(after_file)
    model = mujoco.MjModel.from_xml_path(str(after_file))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    for _ in range(200):
        mujoco.mj_step(model, data)
    assert np.isfinite(data.qpos).all() and np.isfinite(data.qvel).all()
    assert not any(warning.number for warning in data.warning)


def test_the_embedded_panda_stays_itself(tmp_path):
    robot = pathlib.Path(os.environ["FOAM_TEST_SOURCE"]) / "configs/robots/panda/panda.xml"
    after_file = tmp_path / "panda_capsules.xml"
    foam.load(robot).approximate(16, kinds=["capsule"], effort="fast").save(after_file)
    before, after = (mujoco.MjModel.from_xml_path(str(file)) for file in (robot, after_file))
    old, new = numbers(before), numbers(after)
    assert [name for name in old if old[name] != new[name]] == []
    data = mujoco.MjData(after)
    mujoco.mj_resetDataKeyframe(after, data, 0)
    mujoco.mj_forward(after, data)
    assert data.ncon == 0
