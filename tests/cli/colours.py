"""Asks for colours on a terminal (a pty), in pipes, and where they are refused: colours.py FOAM"""
import os
import pathlib
import pty
import subprocess
import sys
import tempfile

FOAM = sys.argv[1]
BOX = """v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"""
RED, YELLOW, GREEN, BEGIN = "\x1b[1m\x1b[31m", "\x1b[1m\x1b[33m", "\x1b[1m\x1b[32m", "\x1b["
failures = []


def environment(folder, **more):
    kept = {key: value for key, value in os.environ.items() if key not in ("NO_COLOR", "TERM")}
    return {**kept, "TERM": "xterm", "XDG_CACHE_HOME": str(folder / "cache"), **more}


def on_terminal(folder, *arguments, **more):
    """Returns what the program writes to a terminal."""
    terminal, end = pty.openpty()
    process = subprocess.Popen([FOAM, *map(str, arguments)], cwd=folder, env=environment(folder, **more),
                               stdin=subprocess.DEVNULL, stdout=end, stderr=end)  # fmt: skip
    os.close(end)
    written = b""
    try:
        while piece := os.read(terminal, 65536):
            written += piece
    except OSError:  # Linux: the other end is closed
        pass
    process.wait()
    os.close(terminal)
    return written.decode()


def in_pipes(folder, *arguments, **more):
    done = subprocess.run([FOAM, *map(str, arguments)], cwd=folder, env=environment(folder, **more), text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)  # fmt: skip
    return done.stdout


def expect(what, text, *parts, without=()):
    for part in parts:
        if part not in text:
            failures.append(f"{what}: {part!r} is not in {text!r}")
    for part in without:
        if part in text:
            failures.append(f"{what}: {part!r} is in {text!r}")


with tempfile.TemporaryDirectory() as scratch:
    folder = pathlib.Path(scratch)
    (folder / "box.obj").write_text(BOX)
    (folder / "wrong.yaml").write_text("foam: 1\nmesh: box.obj\nstages: [spherize.octre]\nbudget: {spheres: 2}\n")
    (folder / "glob.yaml").write_text("foam: 1\nmesh: box.obj\nstages: [spherize.grid]\nbudget: {spheres: 2}\n"
                                      "links:\n  none*: {max_spheres: 1}\noutputs: [write.csv]\n")  # fmt: skip
    missing = ("info", "none.obj")
    expect("an error", on_terminal(folder, *missing), f"foam: {RED}error:\x1b[0m {folder / 'none.obj'}: there is no such file")
    expect("NO_COLOR", on_terminal(folder, *missing, NO_COLOR="1"), "error:", without=[BEGIN])
    expect("empty NO_COLOR", on_terminal(folder, *missing, NO_COLOR=""), RED)
    expect("TERM=dumb", on_terminal(folder, *missing, TERM="dumb"), "error:", without=[BEGIN])
    expect("--color never", on_terminal(folder, "--color", "never", *missing), "error:", without=[BEGIN])
    expect("a pipe", in_pipes(folder, *missing), "error:", without=[BEGIN])
    expect("--color always", in_pipes(folder, *missing, "--color", "always", NO_COLOR="1"), RED)
    expect("a finding", on_terminal(folder, "check", "wrong.yaml"), f"{RED}error\x1b[0m[unknown-stage]")
    expect("a warning", on_terminal(folder, "run", "glob.yaml"), YELLOW)

    made = ("spherize", "box.obj", "-n", "2", "-m", "grid", "--color", "always")
    expect("a proof", in_pipes(folder, *made, "-o", "box.csv"), GREEN)
    expect("a file", (folder / "box.csv").read_text(), without=[BEGIN])
    expect("data", in_pipes(folder, *made, "-q", "-o", "-", "--format", "csv"), without=[BEGIN])
    expect("JSON", in_pipes(folder, *made, "-q", "-o", "box.csv", "--json"), "{", without=[BEGIN])
    expect("JSON", on_terminal(folder, "info", "box.obj", "--json"), "{", without=[BEGIN])
    (folder / "few.csv").write_text("link,x,y,z,radius\nbox,0.5,0.5,0.5,0.2\n")
    expect("no proof", in_pipes(folder, "certify", "box.obj", "few.csv", "--color", "always"), f"{RED}Not certified")
    expect("another word", in_pipes(folder, "--color", "sometimes", *missing), "--color")

print(*failures, sep="\n")
sys.exit(1 if failures else 0)
