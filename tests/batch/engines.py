"""GNU parallel and Snakemake work on the shards by the lines that foam writes into README.md and Snakefile."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

from data_set import Foam, expect, skip, write_boxes


def run(command, folder):
    done = subprocess.run(command, cwd=folder, shell=True, text=True, capture_output=True, timeout=300)
    return done.returncode, done.stdout + done.stderr


def main():
    with tempfile.TemporaryDirectory() as scratch:
        foam, folder = Foam(sys.argv[1], scratch), pathlib.Path(scratch)
        write_boxes(folder / "it's boxes", 24)
        arguments = ("it's boxes", "-n", 4)
        foam(*arguments, "--run-dir", "plain", code=4)
        truth = foam.table("plain")
        done = []
        for engine in ("parallel", "snakemake"):
            # Both ways to write an option's value: the tasks run in other folders.
            folder_of_results = (f"--run-dir={engine}",) if engine == "parallel" else ("--run-dir", engine)
            out, _ = foam(*arguments, *folder_of_results, "--shards", 4, "--slurm")
            expect(out.startswith("24 meshes in 4 shards\n"), out)
            expect(not list((folder / engine).glob("shard-*")), "--slurm works on nothing")
            if not shutil.which(engine):
                continue
            lines = [line.strip() for line in (folder / engine / "README.md").read_text().splitlines()]
            line = next(line for line in lines if engine in line and "cores" in line or f"| {engine} " in line)
            code, text = run(line, folder / engine)
            # parallel's exit code is the number of jobs that failed: shards with failures in them
            expect(code == 0 or engine == "parallel" and code <= 4, f"{line}: {code}\n{text}")
            expect(foam.table(engine) == truth, f"{engine}: other bytes\n{text}")
            done.append(engine)
        if not done:
            skip("neither parallel nor snakemake is there")
        print(f"{', '.join(done)}: the same bytes")


main()
