"""Runs foam and says how long it took; what it may leave behind is checked."""
import concurrent.futures
import os
import pathlib
import subprocess
import sys
import time

FOAM = sys.argv[1]
SHARED = pathlib.Path(os.environ.get("FOAM_SHARED") or (sys.argv[2] if len(sys.argv) > 2 else "") or "/nowhere")
SOURCE = pathlib.Path(__file__).resolve().parents[2]
# s beyond what foam promises: for machines that have other things to do.
SLACK = float(os.environ.get("FOAM_TEST_SLACK", "2"))
SKIPPED = 77
CORES = os.cpu_count() or 1


class Ended:
    def __init__(self, code, err, seconds):
        self.code, self.err, self.seconds = code, err, seconds


def start(folder, arguments):
    return subprocess.Popen([FOAM, *map(str, arguments)], cwd=folder, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, errors="replace",
                            env={**os.environ, "XDG_CACHE_HOME": str(folder / "cache")})


def run(folder, arguments, timeout):
    """Killed after `timeout` s: then the code is negative."""
    begin = time.monotonic()
    process = start(folder, arguments)
    try:
        _, err = process.communicate(timeout=timeout)
    except subprocess.TimeoutExpired:
        process.kill()
        _, err = process.communicate()
    return Ended(process.returncode, err, time.monotonic() - begin)


def side_by_side(function, cases, at_a_time):
    """Yields function(*case) in the order of the cases, so many at a time; without slack, one by one."""
    with concurrent.futures.ThreadPoolExecutor(at_a_time if SLACK >= 1 else 1) as pool:
        yield from pool.map(lambda case: function(*case), cases)


def half_written(folder):
    """Unfinished folders, and run folders that lack what is written last."""
    left = [path for path in folder.rglob("*") if ".partial-" in path.name]
    return left + [path for path in folder.glob("run*") if path.is_dir() and not (path / "events.jsonl").exists()]


def robot(name):
    return next(iter(sorted((SHARED / "robots" / name).rglob("*.urdf"))), None)
