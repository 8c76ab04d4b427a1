"""to_mujoco(spec) with the real MuJoCo: frames, proof, old geoms, all kinds of elements."""
import warnings

import mujoco
import numpy as np
import pytest

import foam

pytestmark = pytest.mark.filterwarnings("ignore:.*(no <inertial>|elements are used)")

ARM = """<robot name="arm">
  <link name="base"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.3 0.2 0.2"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.3" rpy="0 0 0.4"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <link name="upper"><collision><origin xyz="0.05 0 0.2"/><geometry><box size="0.1 0.06 0.4"/></geometry></collision></link>
  <joint name="bend" type="revolute"><parent link="upper"/><child link="tip"/><origin xyz="0.1 0 0.4" rpy="0.3 0 0"/>
    <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <link name="tip"><collision><origin xyz="0 0.04 0.1" rpy="0 0 0.2"/><geometry><box size="0.05 0.15 0.2"/></geometry></collision></link>
</robot>"""

# The body of `upper` is turned by 90 degrees about z against its link; geoms, joint and child make up for it.
UPPER = '<body name="upper" pos="0 0 0.3" euler="0 0 0.4"><joint name="turn" axis="0 1 0"/>{}'
SPEC = """<mujoco><compiler angle="radian" eulerseq="xyz"/><worldbody><body name="base" pos="1 2 3" euler="0.1 0.2 0.3">
  <geom name="old" type="box" pos="0 0 0.1" size="0.15 0.1 0.1" group="2" friction="0.3 0.01 0.001"/>
  <body name="upper" {upper}
    <body name="tip" {tip}<joint name="bend" axis="1 0 0"/>
      <geom type="box" pos="0 0.04 0.1" euler="0 0 0.2" size="0.025 0.075 0.1" contype="4" conaffinity="2"/>
      <geom name="seen" type="sphere" size="0.3" contype="0" conaffinity="0"/>
    </body></body></body></worldbody></mujoco>"""
STRAIGHT = {
    "upper": 'pos="0 0 0.3" euler="0 0 0.4"><joint name="turn" axis="0 1 0"/><geom type="box" pos="0.05 0 0.2" size="0.05 0.03 0.2"/>',
    "tip": 'pos="0.1 0 0.4" euler="0.3 0 0">',
}
TURN = 1.5707963267948966
TURNED = {
    "upper": f'pos="0 0 0.3" euler="0 0 {0.4 + TURN}"><joint name="turn" axis="1 0 0"/>'
    '<geom type="box" pos="0 -0.05 0.2" size="0.03 0.05 0.2"/>',
    "tip": 'pos="0 -0.1 0.4" quat="{} {} {} {}">',
}


def turned():
    """The tip's orientation in the turned body: Rz(-90°) Rx(0.3)."""
    first, second, both = np.zeros(4), np.zeros(4), np.zeros(4)
    mujoco.mju_axisAngle2Quat(first, np.array([0.0, 0, 1]), -TURN)
    mujoco.mju_axisAngle2Quat(second, np.array([1.0, 0, 0]), 0.3)
    mujoco.mju_mulQuat(both, first, second)
    return SPEC.format(upper=TURNED["upper"], tip=TURNED["tip"].format(*both))


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    file = tmp_path_factory.mktemp("arm") / "arm.urdf"
    file.write_text(ARM)
    return foam.load(file)


@pytest.fixture(scope="module")
def model(arm):
    return arm.spherize(24, effort="fast")


def outside(compiled, pose, bodies):
    """Sample the old boxes of bodies in the world at a pose: the largest distance of a point from all new elements, m."""
    data = mujoco.MjData(compiled)
    for joint, value in pose.items():
        data.qpos[compiled.joint(joint).qposadr[0]] = value
    mujoco.mj_forward(compiled, data)
    worst = 0.0
    for body in bodies:
        geoms = [g for g in range(compiled.ngeom) if compiled.geom_bodyid[g] == compiled.body(body).id]
        new = [g for g in geoms if compiled.geom_contype[g]]
        old = next(g for g in geoms if not compiled.geom_contype[g] and compiled.geom_type[g] == int(mujoco.mjtGeom.mjGEOM_BOX))
        grid = np.stack(np.meshgrid(*[np.linspace(-1, 1, 9)] * 3), -1).reshape(-1, 3)
        grid = grid[np.abs(grid).max(1) == 1] * compiled.geom_size[old]
        points = grid @ data.geom_xmat[old].reshape(3, 3).T + data.geom_xpos[old]
        gaps = []
        for g in new:
            assert compiled.geom_type[g] == int(mujoco.mjtGeom.mjGEOM_SPHERE)
            gaps.append(np.linalg.norm(points - data.geom_xpos[g], axis=1) - compiled.geom_size[g, 0])
        worst = max(worst, np.min(gaps, axis=0).max())
    return worst


@pytest.mark.parametrize("text", [SPEC.format(**STRAIGHT), turned()], ids=["straight", "turned"])
def test_the_elements_cover_what_they_replace(model, text):
    spec = mujoco.MjSpec.from_string(text)
    assert model.to_mujoco(spec, pairs=[("base", "upper", "Adjacent")]) == model.count
    compiled = spec.compile()
    for pose in ({}, {"turn": 0.7, "bend": -0.4}):
        assert outside(compiled, pose, ["base", "upper", "tip"]) < 1e-8
    assert compiled.nexclude == 1
    old = compiled.geom("old")
    assert old.contype[0] == old.conaffinity[0] == 0 and old.group[0] == 2
    new = next(g for g in spec.body("base").geoms if g.contype)
    assert new.group == 3 and new.friction[0] == 0.3 and new.mass == 0
    assert {(g.contype, g.conaffinity) for g in spec.body("tip").geoms if g.contype or g.conaffinity} == {(4, 2)}
    assert compiled.body("base").mass[0] == pytest.approx(12), "the mass stays that of the old geoms"


def test_pairs_of_geoms_that_are_switched_off_are_named(model):
    pairs = '<contact><pair geom1="old" geom2="seen"/><pair name="own" geom1="seen" geom2="old"/></contact></mujoco>'
    spec = mujoco.MjSpec.from_string(SPEC.format(**STRAIGHT).replace("</mujoco>", pairs))
    with pytest.warns(UserWarning, match="<pair> elements still name geoms that are switched off: old and seen, own$"):
        model.to_mujoco(spec)


def test_straight_frames_keep_the_numbers(model):
    spec = mujoco.MjSpec.from_string(SPEC.format(**STRAIGHT))
    model.to_mujoco(spec)
    read = {
        link: [[*g.pos, g.size[0]] for g in spec.body(link).geoms if g.contype] for link in model
    }  # fmt: skip
    assert all(np.array_equal(read[link], model[link]) for link in model)
    assert foam.certify(model.robot, read)


def test_what_differs_is_refused_by_name_and_nothing_changes(model):
    spec = mujoco.MjSpec.from_string(SPEC.format(**STRAIGHT).replace('pos="0.1 0 0.4"', 'pos="0.1 0 0.43"'))
    before = spec.to_xml()
    with pytest.raises(foam.UsageError, match="body 'tip' and link 'tip' do not move alike: at zero .* turned by 0° and moved by 30 mm"):
        model.to_mujoco(spec)
    assert spec.to_xml() == before
    other_axis = SPEC.format(**STRAIGHT).replace('name="bend" axis="1 0 0"', 'name="bend" axis="0 0 1"')
    with pytest.raises(foam.UsageError, match="body 'tip' and link 'tip' do not move alike"):
        model.to_mujoco(mujoco.MjSpec.from_string(other_axis))
    shifted = SPEC.format(**STRAIGHT).replace('euler="0.3 0 0">', 'euler="0.5 0 0">')  # the joint's zero is another one
    with pytest.raises(foam.UsageError, match="turned by 11.5° .*, and its geoms differ from the link's by"):
        model.to_mujoco(mujoco.MjSpec.from_string(shifted))
    with pytest.raises(foam.UsageError, match="no body for base, upper, tip; there are: world"):
        model.to_mujoco(mujoco.MjSpec())


def test_a_single_body_is_compared_by_its_geometry(tmp_path):
    file = tmp_path / "one.urdf"
    box = '<collision><geometry><box size="0.1 0.2 0.4"/></geometry></collision>'
    file.write_text(f'<robot name="one"><link name="one">{box}</link></robot>')
    model = foam.load(file).spherize(4, effort="fast")
    text = '<mujoco><worldbody><body name="one" euler="0 90 0"><geom type="box" size="{}"/></body></worldbody></mujoco>'
    assert model.to_mujoco(mujoco.MjSpec.from_string(text.format("0.05 0.1 0.2"))) == model.count
    with pytest.raises(foam.UsageError, match="differs by .* mm, and no joints say whether the body is turned"):
        model.to_mujoco(mujoco.MjSpec.from_string(text.format("0.2 0.1 0.05")))


@pytest.mark.parametrize("kind", [kind for kind in foam.KINDS if kind != "sphere"])
@pytest.mark.parametrize("text", [SPEC.format(**STRAIGHT), turned()], ids=["straight", "turned"])
def test_every_kind_is_placed_and_proved(arm, kind, text):
    model = arm.approximate(6, kinds=[kind], effort="fast")
    spec = mujoco.MjSpec.from_string(text)
    assert model.to_mujoco(spec) == model.count
    compiled = spec.compile()
    assert compiled.ngeom == 4 + model.count
    assert foam.certify(arm, model)


def test_a_second_model_takes_the_place_of_the_first(arm, model):
    spec = mujoco.MjSpec.from_string(model.to_mujoco())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert arm.spherize(12, effort="fast").to_mujoco(spec) == 12
    compiled = spec.compile()
    assert sum(1 for g in range(compiled.ngeom) if compiled.geom_contype[g]) == 12


def test_a_model_without_a_robot_says_that_frames_are_not_known(model):
    spec = mujoco.MjSpec.from_string(SPEC.format(**STRAIGHT))
    with pytest.warns(UserWarning, match="without a robot nothing says whether"):
        assert foam.SphereModel(dict(model)).to_mujoco(spec) == model.count


def test_a_cover_goes_into_a_body(tmp_path):
    text = '<mujoco><worldbody><body name="{}"><geom name="old" type="box" size="0.05 0.1 0.2"/></body></worldbody></mujoco>'
    vertices = np.array([[x, y, z] for x in (-0.05, 0.05) for y in (-0.1, 0.1) for z in (-0.2, 0.2)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    cover = foam.cover((vertices, faces), 3, "capsule", effort="fast")
    spec = mujoco.MjSpec.from_string(text.format("part"))
    for count in (1, 2):  # the second takes the place of the first
        assert cover.to_mujoco(spec, body="part") == len(cover)
        compiled = spec.compile()
        assert compiled.ngeom == 1 + count * len(cover) and compiled.geom("old").contype[0] == 0
        assert sum(1 for g in range(compiled.ngeom) if compiled.geom_contype[g]) == len(cover)
    with pytest.raises(foam.UsageError, match="body: the MjSpec has no body 'part'; there are: world"):
        cover.to_mujoco(mujoco.MjSpec(), body="part")
