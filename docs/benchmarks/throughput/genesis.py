#!/usr/bin/env python3
"""The experiment of configs/experiments/throughput.yaml in Genesis (pip install genesis-world pyyaml), for one model at a time.

    foam run configs/panda_22.yaml -o panda_22
    genesis.py configs/experiments/throughput.yaml panda.urdf panda_22/panda_22.urdf --backend gpu

Genesis is not among the packages that foam is built and tested with: this script is written from Genesis's documented
interface and has no results in these pages. It plays the same motion with the same box, timestep, gains and number of
simulations; masses and inertias are those that Genesis gives the URDF, and contacts between the robot's own links are off,
equally for all models. Each model runs in a process of its own. Mesh references must be such that Genesis finds them.
"""

import argparse
import multiprocessing
import time

JOINT_GAINS = {"kp": 10000.0, "kv": 200.0, "limit": 500.0}
FINGER_GAINS = {"kp": 5000.0, "kv": 100.0, "limit": 20.0}


def moments_of(experiment):
    """[(time, {joint: value})], with the values of joints that a moment does not name kept."""
    values, moments = {}, []
    for moment in experiment["motion"]:
        values = values | moment.get("joints", {})
        moments.append((float(moment["time"]), dict(values)))
    return moments


def command(moments, joints, now):
    """Values of the joints at a time, linear in between."""
    after = next((i for i, (t, _) in enumerate(moments) if t > now), len(moments) - 1)
    (t0, a), (t1, b) = moments[max(after - 1, 0)], moments[after]
    share = min(max((now - t0) / (t1 - t0), 0.0), 1.0) if t1 > t0 else 1.0
    return [a[joint] + share * (b[joint] - a[joint]) for joint in joints]


def simulate(file, experiment, backend, answers):
    import genesis as gs
    import numpy as np

    gs.init(backend=getattr(gs, backend), logging_level="warning")
    dt, count, box = experiment["timestep"], experiment["simulations"], experiment["object"]
    scene = gs.Scene(sim_options=gs.options.SimOptions(dt=dt), show_viewer=False,
                     rigid_options=gs.options.RigidOptions(dt=dt, enable_self_collision=False))
    scene.add_entity(gs.morphs.Plane())
    x, y, z = box["position"]
    density = box["mass"] / np.prod(box["size"])
    held = scene.add_entity(gs.morphs.Box(size=tuple(box["size"]), pos=(x, y, z + box["size"][2] / 2)),
                            material=gs.materials.Rigid(rho=density))
    robot = scene.add_entity(gs.morphs.URDF(file=file, fixed=True))
    scene.build(n_envs=count)

    moments = moments_of(experiment)
    # The second finger follows the first: Genesis does not read <mimic> everywhere.
    for _, values in moments:
        values.setdefault("panda_finger_joint2", values["panda_finger_joint1"])
    joints = list(moments[0][1])
    dofs = [robot.get_joint(joint).dof_idx_local for joint in joints]
    gains = [FINGER_GAINS if "finger" in joint else JOINT_GAINS for joint in joints]
    robot.set_dofs_kp(np.array([g["kp"] for g in gains]), dofs)
    robot.set_dofs_kv(np.array([g["kv"] for g in gains]), dofs)
    limits = np.array([g["limit"] for g in gains])
    robot.set_dofs_force_range(-limits, limits, dofs)

    def all_at(now):
        return np.tile(command(moments, joints, now), (count, 1))

    def heights():
        position = held.get_pos()
        return np.asarray(position.cpu() if hasattr(position, "cpu") else position).reshape(-1, 3)[:, 2]

    scene.step()  # compiles
    scene.reset()
    robot.set_dofs_position(all_at(0.0), dofs)
    start = heights()
    steps = round(moments[-1][0] / dt)
    begin = time.perf_counter()
    for step in range(steps):
        robot.control_dofs_position(all_at(step * dt), dofs)
        scene.step()
    lift = heights() - start  # waits for the device
    seconds = time.perf_counter() - begin
    answers.put((steps * count / seconds, int((lift >= experiment["lift"]).sum())))


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
