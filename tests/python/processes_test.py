"""Threads, processes and Ctrl-C."""
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest

import foam
from shapes import box, wavy

TIMES = bool(os.environ.get("FOAM_TEST_TIMES"))


def spheres_of(mesh):
    return foam.spherize(mesh, 5).spheres.tobytes()


def test_searches_in_two_threads_give_the_bytes_of_one():
    meshes = [wavy(800), box(), foam.Mesh(*wavy(500))] * 2
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(spheres_of, meshes)) == [spheres_of(mesh) for mesh in meshes]


def test_the_lock_of_the_interpreter_is_released():
    turns, done = 0, threading.Event()

    def search():
        foam.spherize(wavy(3000), 40, effort="best", time_limit=0.5)
        done.set()

    thread = threading.Thread(target=search)
    thread.start()
    while not done.wait(0.005):
        turns += 1
    thread.join()
    assert turns > 10


def ball(count):
    """Return a strip of triangles through points on a ball: nothing is inside their hull."""
    i = np.arange(count)
    height, turn = 1 - 2 * (i + 0.5) / count, np.pi * (1 + 5**0.5) * i
    across = np.sqrt(1 - height**2)
    points = np.column_stack([across * np.cos(turn), across * np.sin(turn), height])
    return points, np.column_stack([i[:-2], i[1:-1], i[2:]])


def expect_quick_end(call):
    """Expect KeyboardInterrupt within 150 ms of Ctrl-C, 0.3 s after the call began; at least in one of six tries."""
    times = []
    for _ in range(6):  # others may use the machine
        sent = []

        def interrupt():
            time.sleep(0.3)
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with pytest.raises(KeyboardInterrupt):
            call()
        times.append(time.perf_counter() - sent[0])
        thread.join()
        if times[-1] <= 0.15 or not TIMES:
            return
    pytest.fail(f"ended after {times} s")


@pytest.mark.parametrize("call", [
    lambda mesh: foam.spherize(mesh, 500, effort="best"),
    lambda mesh: foam.spherize_each(mesh, [900, 1000]),
    lambda mesh: foam.spherize(mesh, 500, objective="protrusion", effort="best", time_limit=60),
    lambda mesh: foam.cover(mesh, 500, "hull", effort="best", progress=str),
    lambda mesh: foam.load(mesh).cover(2000, effort="best", fresh=True),
    lambda mesh: [foam.cover(mesh, 9, effort="fast").certificate for _ in range(100)],
    lambda mesh: foam.compare(mesh, [foam.cover(mesh, 9, effort="fast")] * 100),
    lambda mesh: foam.self_collision(foam.example("panda"), samples=10**8),
    lambda mesh: foam.proved_least(ball(30000), "box"),
], ids=["spherize", "spherize_each", "with time limit", "with progress", "model", "certificate", "compare", "self_collision",
        "proved_least"])
def test_ctrl_c_ends_a_call_within_150_milliseconds(call):
    mesh = foam.Mesh(*wavy(50000))
    expect_quick_end(lambda: call(mesh))


def test_ctrl_c_ends_the_reading_of_a_file(tmp_path):
    points, faces = ball(1_000_000)
    facets = np.zeros(len(faces), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    facets["corners"] = points[faces]
    (tmp_path / "large.stl").write_bytes(bytes(80) + np.uint32(len(faces)).tobytes() + facets.tobytes())
    expect_quick_end(lambda: foam.read_mesh(tmp_path / "large.stl"))
    expect_quick_end(lambda: foam.load(tmp_path / "large.stl"))


def test_a_handler_that_does_not_raise_does_not_end_a_search():
    calls = []
    before = signal.signal(signal.SIGALRM, lambda *_: calls.append(1))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05, 0.05)
        cover = foam.spherize(wavy(3000), 60, effort="best", time_limit=0.6)
        signal.setitimer(signal.ITIMER_REAL, 0)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert cover.certified and calls


@pytest.mark.parametrize("method", ["spawn", "forkserver"])
def test_pools_of_processes(method):
    meshes = [box(), foam.Mesh(*box(1, 1, 1))]
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(method)) as pool:
        assert list(pool.map(spheres_of, meshes)) == [spheres_of(mesh) for mesh in meshes]


def test_a_fork_says_what_to_do():
    code = ("import os, sys, foam; box = foam.Mesh([[0,0,0],[1,0,0],[0,1,0]], [[0,1,2]])\n"
            "if sys.argv[1] == 'used': foam.spherize(box, 1)\n"
            "child = os.fork()\n"
            "if child == 0:\n"
            "    try: print(foam.spherize(box, 1), flush=True)\n"
            "    except foam.UsageError as error: print(error, flush=True)\n"
            "    os._exit(0)\n"
            "os.waitpid(child, 0)\n")
    said = [subprocess.run([sys.executable, "-c", code, how], check=True, capture_output=True, text=True, timeout=60).stdout
            for how in ("used", "fresh")]
    assert "spawn" in said[0]
    assert "certified" in said[1]  # nothing had been started before


def test_threads_are_limited_in_a_block():
    before = foam.thread_count()
    with foam.threads(1):
        assert foam.thread_count() == 1
        with foam.threads(None):
            assert foam.thread_count() == before
        assert foam.thread_count() == 1
    assert foam.thread_count() == before
