"""Time limits of 0.2, 1 and 2.5 s are kept on what takes longer: a tenth and half a second, and either there is a proved
model by then or an error says where the time went."""
import pathlib
import sys
import tempfile

import program

MESHES = [("Generic_Twin_7081.1.t0_right.obj", "cover"), ("Generic_Twin_7081.1.t0_right.obj", "medial"),
          ("armadillo.obj", "cover"), ("armadillo.obj", "grid"), ("stanford-bunny.obj", "cover"),
          ("stanford-bunny.obj", "octree"), ("cycloidal.ply", "medial"), ("cycloidal.ply", "voxel")]
ROBOTS = ["baxter", "fetch"]
LIMITS = (0.2, 1, 2.5)  # s: all of these runs are cut by all of them


def cases():
    for mesh, method in MESHES:
        file = program.SHARED / "meshes/real" / mesh
        if file.exists():
            yield f"{mesh} {method}", [file, "-n", 64, "-m", method]
    for name in ROBOTS:
        if program.robot(name):
            yield name, [program.robot(name), "-n", 316]


def complaint(folder, limit, ended):
    if ended.seconds > 1.1 * limit + 0.5 + program.SLACK:
        return f"took {ended.seconds:.2f} s"
    if program.half_written(folder):
        return f"left {program.half_written(folder)}"
    written = any(folder.glob("out*"))
    if ended.code == 1 and not written and f"the time limit of {limit:g} s ended" in ended.err:
        return ""
    if ended.code == 0 and written:
        return ""
    return f"exit code {ended.code}, {'something' if written else 'nothing'} was written:\n{ended.err}"


def limited(name, arguments, limit):
    """Runs one case. Returns its line, and whether it kept the limit."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        output = "out.urdf" if str(arguments[0]).endswith(".urdf") else "out.json"
        ended = program.run(folder, ["spherize", *arguments, "--fresh", "--time-limit", limit, "-o", output],
                            4 * limit + 20)
        wrong = complaint(folder, limit, ended)
    return (f"{name}, {limit} s: {ended.seconds:.2f} s, exit code {ended.code} {'FAILED: ' + wrong if wrong else ''}",
            not wrong)


def main():
    found = list(cases())
    if not found:
        print("skipped: the meshes of FOAM_SHARED are not there")
        return program.SKIPPED
    kept = True
    runs = [(*case, limit) for case in found for limit in LIMITS]
    # A run uses a little more than one core on average.
    for line, well in program.side_by_side(limited, runs, min(2, program.CORES)):
        print(line, flush=True)
        kept = kept and well
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
