#!/usr/bin/env python3
"""The experiment of configs/experiments/throughput.yaml in Genesis (pip install genesis-world pyyaml), for one model at a time.

    foam run configs/panda_22.yaml -o panda_22
    grasp_in_genesis.py configs/experiments/throughput.yaml panda.urdf panda_22/panda_22.urdf --backend gpu

Genesis is not among the packages that foam is built and tested with: this script has no results in these pages. It follows
Genesis's guide (genesis-world.readthedocs.io: control your robot, parallel simulation), and a test plays it against a stand-in
that knows the calls of that guide. It plays the same motion with the same box, timestep, gains and number of simulations;
masses and inertias are those that Genesis gives the URDF, contacts between the robot's own links are off and all of its links
touch the box, equally for all models. Each model runs in a process of its own. Mesh references must be such that Genesis
finds them.
"""

import argparse
import multiprocessing
import random
import time

JOINT_GAINS = {"kp": 10000.0, "kv": 200.0, "limit": 500.0}
FINGER_GAINS = {"kp": 5000.0, "kv": 100.0, "limit": 20.0}


def moments_of(experiment):
    """[(time, {joint: value})], with the values of joints that a moment does not name kept."""
    values, moments = {}, []
    for moment in experiment["motion"]:
        values = values | moment.get("joints", {})
        # The second finger follows the first: Genesis does not read <mimic> everywhere.
        both = values | {"panda_finger_joint2": values["panda_finger_joint1"]}
        moments.append((float(moment["time"]), both))
    return moments


def command(moments, joints, now):
    """Values of the joints at a time, linear in between."""
    after = next((i for i, (t, _) in enumerate(moments) if t > now), len(moments) - 1)
    (t0, a), (t1, b) = moments[max(after - 1, 0)], moments[after]
    share = min(max((now - t0) / (t1 - t0), 0.0), 1.0) if t1 > t0 else 1.0
    return [a[joint] + share * (b[joint] - a[joint]) for joint in joints]


def places_of(experiment):
    """Where the middle of the box begins, for each simulation: the same for all models."""
    x, y, z = experiment["object"]["position"]
    chance, spread = random.Random(0), experiment["spread"]
    height = z + experiment["object"]["size"][2] / 2
    return [[x + chance.uniform(-spread, spread), y + chance.uniform(-spread, spread), height]
            for _ in range(experiment["simulations"])]


def simulate(file, experiment, backend, answers):
    import genesis as gs
    import torch

    gs.init(backend=getattr(gs, backend), logging_level="warning")

    def on_device(values):
        return torch.tensor(values, dtype=gs.tc_float, device=gs.device)

    dt, count, box = experiment["timestep"], experiment["simulations"], experiment["object"]
    width, depth, height = box["size"]
    scene = gs.Scene(sim_options=gs.options.SimOptions(dt=dt), show_viewer=False,
                     rigid_options=gs.options.RigidOptions(dt=dt, enable_self_collision=False))
    scene.add_entity(gs.morphs.Plane())
    places = places_of(experiment)
    held = scene.add_entity(gs.morphs.Box(size=(width, depth, height), pos=tuple(places[0])),
                            material=gs.materials.Rigid(rho=box["mass"] / (width * depth * height)))
    robot = scene.add_entity(gs.morphs.URDF(file=file, fixed=True))
    scene.build(n_envs=count)

    moments = moments_of(experiment)
    joints = list(moments[0][1])
    dofs = [robot.get_joint(joint).dofs_idx_local[0] for joint in joints]
    gains = [FINGER_GAINS if "finger" in joint else JOINT_GAINS for joint in joints]
    limits = [g["limit"] for g in gains]
    robot.set_dofs_kp(kp=on_device([g["kp"] for g in gains]), dofs_idx_local=dofs)
    robot.set_dofs_kv(kv=on_device([g["kv"] for g in gains]), dofs_idx_local=dofs)
    robot.set_dofs_force_range(lower=on_device([-l for l in limits]), upper=on_device(limits), dofs_idx_local=dofs)

    def heights():
        return [place[2] for place in held.get_pos().tolist()]

    scene.step()  # compiles
    scene.reset()
    steps = round(moments[-1][0] / dt)
    commands = on_device([command(moments, joints, step * dt) for step in range(steps)])
    robot.set_dofs_position(commands[0].expand(count, -1), dofs)
    held.set_pos(on_device(places))
    start = heights()
    begin = time.perf_counter()
    for step in range(steps):
        robot.control_dofs_position(commands[step].expand(count, -1), dofs)
        scene.step()
    end = heights()  # waits for the device
    seconds = time.perf_counter() - begin
    answers.put((steps * count / seconds, sum(e - s >= experiment["lift"] for s, e in zip(start, end))))


def main():
    import yaml

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("experiment", help="configs/experiments/throughput.yaml")
    parser.add_argument("urdf", nargs="+", help="the original and the sphere models")
    parser.add_argument("--backend", default="gpu", choices=["gpu", "cpu", "cuda", "metal"])
    arguments = parser.parse_args()
    with open(arguments.experiment, encoding="utf-8") as stream:
        experiment = yaml.safe_load(stream)
    processes = multiprocessing.get_context("spawn")
    print("model,repeat,steps_per_s,lifted")
    for repeat in range(experiment["repeats"]):
        for file in arguments.urdf:
            answers = processes.Queue()
            process = processes.Process(target=simulate, args=(file, experiment, arguments.backend, answers))
            process.start()
            process.join()
            if process.exitcode != 0:
                raise SystemExit(f"{file}: the simulation ended with exit code {process.exitcode}")
            steps, lifted = answers.get()
            print(f"{file},{repeat + 1},{steps:.0f},{lifted}", flush=True)


if __name__ == "__main__":
    main()
