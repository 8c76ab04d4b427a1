#!/usr/bin/env python3
"""damaged.py FOAM FOLDER SEED COUNT FILE…: every command that reads files, on each FILE and on COUNT damaged copies of it.

FOAM is a program that was built with sanitizers. What it reports, crashes, and what takes more than a minute of CPU time are
kept in FOLDER/found, with the command and its messages. Exit code 1 if there is any.
"""
import os
import random
import re
import resource
import shutil
import subprocess
import sys

WORDS = [b"1e308", b"nan", b"inf", b"-0", b"1e-320", b"99999999999999999999", b"0", b"-1", b"", b"1e400", b"0x10", b"1,5", b"4294967296", b"${1/0}",
         b"$(find x)", b"&amp;", b"&#0;", b"<!--", b"]]>", b"\x00", b"\xff\xfe", b"\xef\xbb\xbf", b"../../x", b"\r\n", b"null", b"[]", b"{}", b"*a",
         b"&a", b"!!binary x", b"\\u0000", b"\xed\xa0\x80"]
ROBOT = """<robot name="r"><link name="base_link"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
<link name="tool0"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="j" type="revolute"><parent link="base_link"/><child link="tool0"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>"""
MODEL = "link,x,y,z,radius\nbase_link,0,0,0,1\ntool0,0,0,0,0.2\n"


def replaced(data, pattern, choose, rng):
    found = list(re.finditer(pattern, bytes(data)))
    if found:
        place = rng.choice(found)
        data[place.start():place.end()] = choose(found)


def with_lines_changed(data, rng):
    lines = bytes(data).split(b"\n")
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    change = rng.randrange(3)
    if change == 0:
        lines[a], lines[b] = lines[b], lines[a]
    elif change == 1:
        del lines[a]
    else:
        lines[a:a] = [lines[b]] * rng.choice([1, 3, 100])
    return bytearray(b"\n".join(lines))


def damaged(bytes_of_file, rng):
    data = bytearray(bytes_of_file)
    for _ in range(rng.choice([1, 1, 1, 2, 3, 6])):
        if not data:
            break
        i, length, kind = rng.randrange(len(data)), rng.choice([1, 2, 4, 8, 20, 60, 300]), rng.randrange(9)
        if kind == 0:
            data[i] ^= 1 << rng.randrange(8)
        elif kind == 1:
            data[i] = rng.randrange(256)
        elif kind == 2:
            del data[i:]
        elif kind == 3:
            data[i:i] = data[i:i + length] * rng.choice([1, 2, 5, 50])
        elif kind == 4:
            del data[i:i + length]
        elif kind == 5:
            replaced(data, rb"-?\d+\.?\d*(?:[eE][-+]?\d+)?", lambda found: rng.choice(WORDS), rng)
        elif kind == 6:
            replaced(data, rb"[A-Za-z_]+", lambda found: rng.choice(found).group(), rng)
        elif kind == 7:
            data[i:i] = rng.choice(WORDS)
        else:
            data = with_lines_changed(data, rng)
    return bytes(data)


def commands(file, robot, model, rng):
    out = os.path.join(os.path.dirname(file), "out")
    written = out + rng.choice([".urdf", ".xrdf", ".yml", ".json", ".srdf", ".xml", ".sdf", ".usda", ".glb", ".ply"])
    few = ["--samples", "200", "--proof-boxes", "200"]
    return [["info", file], ["check", file], ["certify", robot, file], ["certify", file, model], ["certify", file, file],
            ["certify", robot, file, "--guarantee", "inner"], ["evaluate", robot, file], ["evaluate", file, model, "--poses", "5"],
            ["compare", file, model, model], ["convert", file, "-o", out + ".csv"], ["convert", file, robot, "-o", written],
            ["convert", model, robot, "--into", file, "-o", out + os.path.splitext(file)[1]], ["convert", model, file, "-o", written],
            ["self-collision", file, "--spheres", "4", "--srdf", out + ".srdf"] + few, ["self-collision", robot, "--against", file] + few,
            ["self-collision", robot, "--model", file] + few, ["spherize", file, "-n", "6", "-m", "grid", "-o", out + ".json", "-q"],
            ["approximate", file, "-n", "4", "--with", rng.choice(["box", "capsule", "hull"]), "--effort", "fast", "-o", out + ".urdf", "-q"]]


def is_bad(run):
    words = ("Sanitizer", "runtime error", "a bug in foam")
    return run.returncode not in (0, 1, 2, 3, 4) or any(word in run.stderr.decode("utf8", "replace") for word in words)


def run_on(foam, folder, command, file, found):
    environment = dict(os.environ, XDG_CACHE_HOME=os.path.join(folder, "cache"))
    minute = lambda: resource.setrlimit(resource.RLIMIT_CPU, (60, 70))
    run = subprocess.run([foam] + command, env=environment, cwd=os.path.dirname(file), stdin=subprocess.DEVNULL, capture_output=True,
                         preexec_fn=minute)
    if is_bad(run):
        kept = os.path.join(folder, "found", f"{len(found)}_{os.path.basename(file)}")
        os.makedirs(os.path.dirname(kept), exist_ok=True)
        shutil.copy(file, kept)
        with open(kept + ".txt", "wb") as text:
            text.write(f"{command}\nexit code {run.returncode}\n".encode() + run.stderr[-8000:])
        found.append(kept)
        print("found:", kept, command[0], run.returncode, flush=True)


def main(foam, folder, seed, count, files):
    rng, found, runs = random.Random(int(seed)), [], 0
    folder = os.path.abspath(folder)
    os.makedirs(folder, exist_ok=True)
    robot, model = os.path.join(folder, "robot.urdf"), os.path.join(folder, "model.csv")
    for name, text in (robot, ROBOT), (model, MODEL):
        with open(name, "w") as made:
            made.write(text)
    for file in files:
        with open(file, "rb") as read:
            original = read.read()
        for copy in range(int(count) + 1):
            work = os.path.join(folder, "work")
            shutil.rmtree(work, ignore_errors=True)
            shutil.copytree(os.path.dirname(os.path.abspath(file)), work, copy_function=shutil.copyfile)
            name = os.path.join(work, os.path.basename(file))
            with open(name, "wb") as changed:
                changed.write(original if copy == 0 else damaged(original, rng))
            all_commands = commands(name, robot, model, rng)
            for command in all_commands if copy == 0 else rng.sample(all_commands, 3):
                runs += 1
                run_on(os.path.abspath(foam), folder, command, name, found)
    print(f"{len(files)} files, {runs} commands, {len(found)} found")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:5], sys.argv[5:]))
