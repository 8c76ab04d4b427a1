"""Plays docs/benchmarks/grasp_in_genesis.py against a stand-in for Genesis: grasp_in_genesis_test.py SCRIPT URDF"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

JOINTS = {"panda_joint1": 0, "panda_joint2": 0.4, "panda_joint3": 0, "panda_joint4": -2.3, "panda_joint5": 0,
          "panda_joint6": 2.7, "panda_joint7": 0.8, "panda_finger_joint1": 0.04}
EXPERIMENT = {"simulations": 7, "repeats": 2, "timestep": 0.01, "spread": 0.003, "lift": 0.05,
              "object": {"size": [0.03, 0.03, 0.1], "position": [0.5, 0, 0], "mass": 0.1},
              "motion": [{"time": 0, "joints": JOINTS}, {"time": 0.5, "joints": {"panda_finger_joint1": 0}},
                         {"time": 1, "joints": {"panda_joint2": 0.3}}]}


def lines_of(script, urdf, experiment):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "experiment.yaml"
        file.write_text(json.dumps(experiment), encoding="utf-8")
        stand_ins = pathlib.Path(__file__).parent / "stand_ins"
        run = subprocess.run([sys.executable, script, file, urdf, urdf, "--backend", "cpu"], capture_output=True, text=True,
                             env=os.environ | {"PYTHONPATH": str(stand_ins), "PYTHONDONTWRITEBYTECODE": "1"}, check=False)
        assert run.returncode == 0, run.stderr
        return run.stdout.splitlines()


def main():
    script, urdf = sys.argv[1:]
    header, *rows = lines_of(script, urdf, EXPERIMENT)
    assert header == "model,repeat,steps_per_s,lifted", header
    fields = [row.split(",") for row in rows]
    assert [(f[0], f[1], f[3]) for f in fields] == [(urdf, repeat, "7") for repeat in "1122"], rows
    assert all(float(f[2]) > 0 for f in fields), rows
    # Fingers that stay open lift nothing.
    EXPERIMENT["motion"][1]["joints"] = {}
    assert [row.split(",")[3] for row in lines_of(script, urdf, EXPERIMENT)[1:]] == ["0"] * 4


if __name__ == "__main__":
    main()
