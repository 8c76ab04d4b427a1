"""SIGTERM ends foam within 2 s with exit code 130, whatever it is at work on, and leaves nothing half-written."""
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import program

TIME_TO_STOP = 2
AT_ONCE = 0.2  # s: it had ended by itself while the signal was sent
DELAYS = (0.05, 0.15, 0.4, 0.8, 1.5, 3)


def big_mesh(file):
    """Half a million triangles as text: it takes a while to read, to filter and to cover."""
    side = 500
    with open(file, "w", encoding="ascii") as out:
        for i in range(side):
            for k in range(side):
                out.write(f"v {i} {k} {(i * i + 3 * k * k) % 97 / 10}\n")
        for i in range(side - 1):
            for k in range(side - 1):
                a = i * side + k + 1
                out.write(f"f {a} {a + side} {a + 1}\nf {a + 1} {a + side} {a + side + 1}\n")


def many_balls(file):
    """A cover of the big mesh, made by hand: a lattice of balls."""
    with open(file, "w", encoding="ascii") as out:
        out.write("link,x,y,z,radius\n")
        for i in range(0, 500, 6):
            for k in range(0, 500, 6):
                out.write(f"big,{i},{k},5,9\n")


def many_pictures(folder):
    (folder / "pictures.yaml").write_text(
        "foam: 1\nname: pictures\nrobot: {urdf: ['%s']}\nstages: [spherize.cover: {effort: fast}]\n"
        "budget: {spheres: 30}\noutputs: [{write.urdf: {file: out.urdf}}]\nsnapshots: {size: [4000, 3000]}\n"
        "debug: {snapshots: true, meshes: true}\n" % (program.SOURCE / "configs/robots/panda/panda.urdf"),
        encoding="utf-8")
    return folder / "pictures.yaml"


def commands(folder):
    """(name, arguments) of what takes seconds, each longest in another phase."""
    panda = program.SOURCE / "configs/robots/panda/panda.urdf"
    mesh = folder / "big.obj"
    big_mesh(mesh)
    spherize = ["spherize", panda, "--fresh", "--run-dir", "run"]
    yield "loading", ["spherize", mesh, "-n", 8, "--fresh", "--run-dir", "run"]
    yield "filtering", ["spherize", mesh, "-n", 8, "-m", "medial", "--fresh", "--run-dir", "run"]
    yield "searching", [*spherize, "-n", 2000]
    yield "searching, medial", [*spherize, "-n", 500, "-m", "medial"]
    yield "pictures", ["run", many_pictures(folder), "--fresh", "--run-dir", "run"]
    yield "self-collision", ["self-collision", panda]
    balls = folder / "balls.csv"
    many_balls(balls)
    yield "certify", ["certify", mesh, balls]
    yield "evaluate", ["evaluate", mesh, balls]
    yield "compare", ["compare", mesh, balls, balls]
    subprocess.run([program.FOAM, "spherize", panda, "-n", "300", "--fresh", "--run-dir", folder / "done"], check=True,
                   capture_output=True)
    yield "verify", ["verify", folder / "done"]
    yield "bench", ["bench", program.SOURCE / "configs/experiments/filters.yaml", "--run-dir", "results"]
    twin = program.SHARED / "meshes/real/Generic_Twin_7081.1.t0_right.obj"
    if twin.exists():
        yield "growing", ["spherize", twin, "-n", 8, "--fresh", "--run-dir", "run"]


def outcome(folder, arguments, delay):
    """Returns "stopped", "ended" if it had ended before, "not handled" if it handles no signal, or what is wrong."""
    process = program.start(folder, arguments)
    time.sleep(delay)
    if process.poll() is not None:
        process.communicate()
        return "ended"
    begin = time.monotonic()
    process.send_signal(signal.SIGTERM)
    try:
        out, err = process.communicate(timeout=60)
    except subprocess.TimeoutExpired:
        process.kill()
        return "did not end within a minute"
    seconds = time.monotonic() - begin
    if seconds > TIME_TO_STOP + program.SLACK:
        return f"ended {seconds:.2f} s after the signal:\n{err}"
    left = program.half_written(folder)
    if left:
        return f"left {left}"
    if process.returncode == 0 and "stopping" not in err and seconds < AT_ONCE:
        return "ended"
    # Before the program handles signals, and after it has told everything, it ends as any program does.
    if process.returncode == -signal.SIGTERM and "stopping" not in err and (delay <= 1 or out):
        return "not handled"
    return "stopped" if process.returncode == 130 else f"exit code {process.returncode}:\n{err}"


def stopped(name, arguments):
    """Stops one command after each delay, until it ends by itself before. Returns what came of each, by delay."""
    outcomes = []
    for delay in DELAYS:
        with tempfile.TemporaryDirectory() as folder:
            what = outcome(pathlib.Path(folder), arguments, delay)
        if what == "ended":
            break
        outcomes.append((f"{name}, after {delay} s", what))
    return outcomes


def main():
    failed = stops = 0
    with tempfile.TemporaryDirectory() as place:
        # Half of the commands use one core; the next one is made while others run.
        for outcomes in program.side_by_side(stopped, commands(pathlib.Path(place)), min(3, program.CORES + 1)):
            for name, what in outcomes:
                stops += what == "stopped"
                wrong = what not in ("stopped", "not handled")
                failed += wrong
                print(f"{name}: {'FAILED: ' if wrong else ''}{what}", flush=True)
    if stops < 10:
        print(f"FAILED: only {stops} runs were stopped")
        return 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
