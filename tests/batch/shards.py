"""The same bytes for any number of shards, workers and restarts; a second run does nothing."""
import signal
import sys
import tempfile
import pathlib
import time

from data_set import Foam, expect, write_boxes

MESHES = 42  # one of six is broken, and each of seven shards has one


def wait_for_worker(process):
    """Returns when the process has started its worker, or ended."""
    children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
    while process.poll() is None and not children.read_text():
        time.sleep(0.001)


def cut(foam, results, how):
    """Starts the work again and again, and ends it while it is at work."""
    for delay in (0, 0.02, 0.05, 0.1, 0.2):
        process = foam.start("boxes", "-n", 4, "--run-dir", results, "-j", 1, "--shards", 2)
        wait_for_worker(process)
        time.sleep(delay)
        process.send_signal(how)
        process.communicate()
        if process.returncode == 4:
            break  # it was faster
        expected = 130 if how == signal.SIGTERM else -how
        expect(process.returncode == expected, f"{how}: exit code {process.returncode}")
    foam("boxes", "-n", 4, "--run-dir", results, "--shards", 2, code=4)


def main():
    with tempfile.TemporaryDirectory() as scratch:
        foam = Foam(sys.argv[1], scratch)
        write_boxes(pathlib.Path(scratch, "boxes"), MESHES)
        out, _ = foam("boxes", "-n", 4, "--run-dir", "one", code=4)
        expect(out == f"{MESHES} meshes: 35 with spheres, 7 failed, 0 without a result yet\n", out)
        truth = foam.table("one")
        expect(len(truth.splitlines()) == MESHES, "a line a mesh")
        for line in foam.results("one").values():
            expect(("error" in line) != ("spheres" in line and line["certified"]), line)

        for shards, workers in ((1, 2), (2, 1), (7, 3)):
            name = f"of{shards}"
            foam("boxes", "-n", 4, "--run-dir", name, "--shards", shards, "-j", workers, code=4)
            expect(foam.table(name) == truth, f"{shards} shards: other bytes")
        for shard in range(7):  # one process a shard, as a cluster does
            foam("boxes", "-n", 4, "--run-dir", "single", "--shards", 7, "--shard", shard, code=4)
        expect(foam.table("single") == truth, "one process a shard: other bytes")
        for task in range(3):
            foam("boxes", "-n", 4, "--run-dir", "array", "--shards", 7, code=4,
                 env={"SLURM_ARRAY_TASK_ID": str(5 + 2 * task), "SLURM_ARRAY_TASK_MIN": "5",
                      "SLURM_ARRAY_TASK_STEP": "2", "SLURM_ARRAY_TASK_COUNT": "3"})
        expect(foam.table("array") == truth, "tasks of an array: other bytes")
        for how in (signal.SIGKILL, signal.SIGTERM):
            cut(foam, f"cut{how}", how)
            expect(foam.table(f"cut{how}") == truth, f"after {how}: other bytes")

        together = [foam.start("boxes", "-n", 4, "--run-dir", "together", "--shards", 3, "-j", 1) for _ in range(3)]
        texts = [process.communicate()[1] for process in together]
        expect(all(process.returncode == 4 for process in together), texts)
        expect(all(text == "" or "left out: other processes work on them" in text for text in texts), texts)
        expect(foam.table("together") == truth, "three processes at once: other bytes")

        files = sorted(pathlib.Path(scratch, "one").iterdir())
        expect("index.html" in [file.name for file in files], files)
        before = [(file.name, file.stat().st_mtime_ns) for file in files]
        foam("boxes", "-n", 4, "--run-dir", "one", code=4)
        expect(before == [(file.name, file.stat().st_mtime_ns) for file in files], "a second run does nothing")
        moved = Foam(sys.argv[1], "/")
        moved(pathlib.Path(scratch, "boxes"), "-n", 4, "--run-dir", pathlib.Path(scratch, "one"), code=4)
        for other, what in ((("boxes", "-n", 5), "recipe"), (("boxes/box00*.obj", "-n", 4), "list of meshes"),
                            (("boxes", "-n", 4, "--shards", 9), "number of shards")):
            _, err = foam(*other, "--run-dir", "one", code=2)
            expect(f"one: its results are of another {what} (" in err, err)
        expect(foam.table("one") == truth, "refused, and nothing was changed")
        print(f"{MESHES} meshes: the same {len(truth)} bytes in every way")


main()
