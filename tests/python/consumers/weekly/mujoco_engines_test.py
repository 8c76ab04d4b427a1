"""MJCF of every kind of element in MJX and MuJoCo Warp, compared with MuJoCo."""
import warnings

import jax
import mujoco
import mujoco_warp
import numpy as np
import pytest
import urdf_truth
import warp
from mujoco import mjx
from reach import SINGLE

CLEAR = 1e-5  #: m; contacts that are shallower may be found by one and not by the other
#: MJX compiles a step of cylinders or hulls for minutes.
STEPPED_BY_MJX = ["sphere", "capsule", "box"]
warp.config.quiet = True


class InMjx:
    def __init__(self, model, data):
        self.model, self.data = mjx.put_model(model), mjx.make_data(model)
        self.forward = jax.jit(mjx.step)

    def places(self, data):
        values = jax.numpy.array(data.qpos)
        placed = mjx.kinematics(self.model, self.data.replace(qpos=values))  # compiling it for a robot takes longer
        return np.array(placed.geom_xpos), np.array(placed.geom_xmat).reshape(-1, 9)

    def step(self, data):
        done = self.forward(self.model, self.data.replace(qpos=data.qpos))
        return np.array(done.qpos), deepest(zip(np.array(done._impl.contact.geom), np.array(done._impl.contact.dist)))


class InWarp:
    def __init__(self, model, data):
        self.model, self.data = mujoco_warp.put_model(model), mujoco_warp.put_data(model, data, nconmax=500, njmax=2000)

    def set(self, data):
        self.data.qpos.assign(data.qpos[None].astype(np.float32))
        self.data.qvel.zero_()

    def places(self, data):
        self.set(data)
        mujoco_warp.kinematics(self.model, self.data)
        return self.data.geom_xpos.numpy()[0], self.data.geom_xmat.numpy()[0].reshape(-1, 9)

    def step(self, data):
        self.set(data)
        mujoco_warp.step(self.model, self.data)
        count = self.data.nacon.numpy()[0]
        contact = self.data.contact
        return self.data.qpos.numpy()[0], deepest(zip(contact.geom.numpy()[:count], contact.dist.numpy()[:count]))


def deepest(contacts):
    """Return the depth by pair of geoms that touch."""
    found = {}
    for (a, b), distance in contacts:
        if distance < 0:
            pair = frozenset((int(a), int(b)))
            found[pair] = max(found.get(pair, 0), -float(distance))
    return found


def set_random(model, data, random):
    low, high = model.jnt_range.T
    data.qpos[:] = random.uniform(low, high)


@pytest.mark.parametrize("kind", urdf_truth.KINDS)
@pytest.mark.parametrize("engine", (InMjx, InWarp))
def test_places_each_element(models, engine, kind):
    for _, urdf, file in models(kind, "xml"):
        model = mujoco.MjModel.from_xml_path(str(file))
        data = mujoco.MjData(model)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore" if kind == "hull" else "error", UserWarning)  # faces of more than 20 vertices
            found = engine(model, data)
        assert (model.geom_contype != 0).sum() == urdf_truth.Truth(urdf).count()
        random = np.random.default_rng(7)
        for _ in range(2):
            set_random(model, data, random)
            mujoco.mj_kinematics(model, data)
            places, turns = found.places(data)
            np.testing.assert_allclose(places, data.geom_xpos, atol=SINGLE)
            np.testing.assert_allclose(turns, data.geom_xmat, atol=SINGLE)


@pytest.mark.parametrize(
    ("engine", "kind"), [*((InMjx, kind) for kind in STEPPED_BY_MJX), *((InWarp, kind) for kind in urdf_truth.KINDS)]
)
def test_finds_contacts(models, engine, kind):
    _, _, file = next(one for one in models(kind, "xml") if one[0].stem == "hand")
    model = mujoco.MjModel.from_xml_path(str(file))
    model.jnt_range[:] = (-1.2, 1.2)  # fingers that cross
    data, random, touched = mujoco.MjData(model), np.random.default_rng(8), 0
    found = engine(model, data)
    for _ in range(20):
        set_random(model, data, random)
        mujoco.mj_forward(model, data)
        expected = deepest(zip(data.contact.geom, data.contact.dist))
        stepped, contacts = found.step(data)
        assert np.isfinite(stepped).all()
        for pair in expected.keys() | contacts.keys():
            names = [model.geom(g).name or model.body(model.geom_bodyid[g]).name for g in pair]
            ours, theirs = expected.get(pair, 0), contacts.get(pair, 0)
            assert max(ours, theirs) < CLEAR or (ours > 0 and theirs > 0), f"{names}: {ours} m deep in MuJoCo, {theirs}"
        touched += len(expected)
    assert touched > 10


def test_mjx_refuses_cylinders_with_boxes(tmp_path, foam):
    (tmp_path / "walker.urdf").write_text(urdf_truth.walker())
    foam("convert", tmp_path / "walker.urdf", tmp_path / "walker.urdf", "-o", tmp_path / "walker.xml")
    with pytest.raises(NotImplementedError, match="CYLINDER.*BOX.* collisions not implemented"):
        mjx.put_model(mujoco.MjModel.from_xml_path(str(tmp_path / "walker.xml")))
