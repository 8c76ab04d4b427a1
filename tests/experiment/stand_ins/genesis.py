"""Takes the calls that docs/benchmarks/grasp_in_genesis.py may make of Genesis, as its guide describes them, and no others.

A robot goes where it is told at once. The box rises with joint 2 of the arm while the fingers are closed."""

import types
import xml.etree.ElementTree

import torch

tc_float, device, gpu, cpu, cuda, metal = "float32", "device", "gpu", "cpu", "cuda", "metal"
begun = []


def init(*, backend, logging_level):
    assert backend in (gpu, cpu, cuda, metal) and logging_level in ("debug", "info", "warning", "error")
    assert not begun, "one init() a process"
    begun.append(backend)


class Record(types.SimpleNamespace):
    pass


options = types.SimpleNamespace(
    SimOptions=lambda *, dt: Record(dt=dt),
    RigidOptions=lambda *, dt, enable_self_collision: Record(dt=dt, enable_self_collision=enable_self_collision))
morphs = types.SimpleNamespace(
    Plane=lambda: Record(kind="plane"),
    Box=lambda *, size, pos: Record(kind="box", size=size, pos=pos),
    URDF=lambda *, file, fixed: Record(kind="urdf", file=file, fixed=fixed))
materials = types.SimpleNamespace(Rigid=lambda *, rho: Record(rho=rho))


class Entity:
    def __init__(self, scene, morph, material):
        self.scene, self.morph, self.material = scene, morph, material

    def built(self):
        assert self.scene.count, "build() comes first"


class Box(Entity):
    def set_pos(self, pos):
        self.built()
        pos.expect(self.scene.count, 3)
        self.places = pos.tolist()

    def get_pos(self):
        self.built()
        return torch.tensor([[x, y, z + self.scene.raised] for x, y, z in self.places], dtype=tc_float, device=device)


class Robot(Entity):
    def __init__(self, scene, morph, material):
        super().__init__(scene, morph, material)
        moving = [joint.get("name") for joint in xml.etree.ElementTree.parse(morph.file).getroot().iter("joint")
                  if joint.get("type") in ("revolute", "prismatic", "continuous")]
        self.dofs = {name: i for i, name in enumerate(moving)}
        self.values = [0.0] * len(moving)

    def get_joint(self, name):
        return types.SimpleNamespace(dofs_idx_local=[self.dofs[name]])

    def gains(self, dofs_idx_local, *values):
        self.built()
        assert len(set(dofs_idx_local)) == len(dofs_idx_local)
        for value in values:
            value.expect(len(dofs_idx_local))

    def set_dofs_kp(self, kp, dofs_idx_local):
        self.gains(dofs_idx_local, kp)

    def set_dofs_kv(self, kv, dofs_idx_local):
        self.gains(dofs_idx_local, kv)

    def set_dofs_force_range(self, lower, upper, dofs_idx_local):
        self.gains(dofs_idx_local, lower, upper)
        assert all(low < 0 < high for low, high in zip(lower.tolist(), upper.tolist()))

    def set_dofs_position(self, position, dofs_idx_local):
        self.built()
        position.expect(self.scene.count, len(dofs_idx_local))
        for dof, value in zip(dofs_idx_local, position.tolist()[0]):
            self.values[dof] = value

    def control_dofs_position(self, position, dofs_idx_local):
        before = self.value("panda_joint2")
        self.set_dofs_position(position, dofs_idx_local)
        closed = all(self.value(f"panda_finger_joint{i}") < 0.02 for i in (1, 2))
        self.scene.raised += before - self.value("panda_joint2") if closed else 0.0

    def value(self, joint):
        return self.values[self.dofs[joint]]


class Scene:
    kinds = {"plane": Entity, "box": Box, "urdf": Robot}

    def __init__(self, *, sim_options, show_viewer, rigid_options):
        assert begun, "init() comes first"
        assert sim_options.dt == rigid_options.dt and not show_viewer
        self.count, self.raised, self.entities = 0, 0.0, []

    def add_entity(self, morph, material=None):
        assert not self.count, "build() comes last"
        self.entities.append(self.kinds[morph.kind](self, morph, material))
        return self.entities[-1]

    def build(self, *, n_envs):
        self.count = n_envs

    def step(self):
        assert self.count

    def reset(self):
        self.raised = 0.0
