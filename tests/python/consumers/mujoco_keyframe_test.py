"""The rest pose of a written MJCF in the real MuJoCo: its keyframe is free where the zero pose is in contact."""
import mujoco
import pytest

import foam

# With all joints at zero the tip hangs down into the base.
FOLDED = """<robot name="folded">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.15"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <link name="upper"><collision><origin xyz="0 0 0.15"/><geometry><box size="0.04 0.04 0.2"/></geometry></collision></link>
  <joint name="bend" type="revolute"><parent link="upper"/><child link="tip"/><origin xyz="0 0 0.35"/>
    <axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <link name="tip"><collision><origin xyz="0.1 0 -0.3"/><geometry><box size="0.06 0.06 0.5"/></geometry></collision></link>
</robot>"""


def contacts(model, key=None):
    data = mujoco.MjData(model)
    if key is not None:
        mujoco.mj_resetDataKeyframe(model, data, key)
    mujoco.mj_forward(model, data)
    names = [model.body(model.geom_bodyid[geom]).name for geom in range(model.ngeom)]
    return {frozenset(names[g] for g in contact.geom) for contact in data.contact}


@pytest.mark.filterwarnings("ignore:.*no <inertial>")
def test_the_keyframe_is_free_where_the_zero_pose_is_in_contact(tmp_path):
    (tmp_path / "folded.urdf").write_text(FOLDED)
    spheres = foam.load(tmp_path / "folded.urdf").spherize(60)
    spheres.save(tmp_path / "folded.mjcf")
    model = mujoco.MjModel.from_xml_string((tmp_path / "folded.mjcf").read_text())
    assert frozenset(("base", "tip")) in contacts(model)
    home = model.key("home")
    assert list(home.qpos) != [0.0] * model.nq
    assert contacts(model, home.id) == set()
