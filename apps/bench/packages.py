"""What the comparisons of foam with other readers on folders of robots share."""
import argparse
import collections
import os
import warnings
from pathlib import Path


def read_arguments(description):
    """Return the folders, and which verdicts to print."""
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--only", default="", help="verdicts to print, such as 'differs'")
    warnings.simplefilter("ignore")
    return parser.parse_args()


def compare(folder, files, verdict, only):
    """Print the verdicts that are not 'equal', then how many there are of each. Nothing for no files."""
    counts = collections.Counter()
    for file in sorted(files):
        what, why = verdict(file)
        counts[what] += 1
        if what != "equal" and only in what:
            print(f"{what}: {os.path.relpath(file, folder)}: {' '.join(str(why).split())[:600]}", flush=True)
    if counts:
        print(f"{folder.name}: {sum(counts.values())} files: {dict(counts)}", flush=True)
