"""The command line: `foam bench`."""

from __future__ import annotations

import argparse
import os
import re
import signal
import sys
import tempfile
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from .. import _core
from .._threads import set_threads
from ..errors import Error, UsageError
from .experiment import Bench, Experiment
from .folder import Folder, refuse_replacing
from .modules import require
from .plots import to_svg
from .reading import read
from .report import circumstances, page, to_csv

_CODES = {"usage": 2, "recipe": 2, "plugin": 3, "cancelled": 130}


def tell(line: str) -> None:
    """Write a line for people who wait."""
    print(f"foam: {line}", file=sys.stderr, flush=True)


def _threads(text: str) -> int:
    if not re.fullmatch("[0-9]+", text) or int(text) > 1024:
        raise argparse.ArgumentTypeError(f"a whole number from 0 to 1024 is expected, got '{text}'")
    return int(text)


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line. That of `foam bench` is in the program foam, which starts this."""
    result = argparse.ArgumentParser(prog="foam bench", description="Measure stages, write tables and plots")
    result.add_argument("experiment", help="the experiment, a YAML file")
    result.add_argument("--run-dir", metavar="DIR", help="folder of the results; default: benchmarks/NAME")
    result.add_argument("-j", "--threads", metavar="N", type=_threads, default=1,
                        help="threads that a stage may use; 0: one per core; default: 1")  # fmt: skip
    result.add_argument("--force", action="store_true", help="write even if this replaces an input file")
    result.add_argument("--check", action="store_true", help="list all errors of the experiment, and measure nothing")
    return result


def run(experiment: Experiment, folder: Folder, threads: int) -> tuple[str, list[str]]:
    """Run an experiment and write its results; return results.md and the names of the files.

    On an error, or Ctrl-C, the folder is as it was before.
    """
    set_threads(threads or None)
    with tempfile.TemporaryDirectory(prefix="foam-bench-") as scratch:
        outcome = experiment.run(Bench(tell, Path(scratch)))
    measured_on = circumstances(experiment, threads)
    text = page(experiment, outcome, measured_on)
    files = {"results.csv": to_csv(outcome.cases), "results.md": text.encode(), "measured_on.csv": to_csv(measured_on)}
    files |= {name: to_svg(plot) for name, plot in outcome.plots.items()} | outcome.pictures
    folder.write(files)
    return text, list(files)


def bench(arguments: Sequence[str]) -> int:
    """Do what the command line says; return the exit code. Raises Error."""
    given = parser().parse_args(arguments)
    file = Path(given.experiment)
    experiment, findings = read(file)
    for finding in findings:
        print(finding, file=sys.stderr)
    if experiment is None:
        raise UsageError(f"{file}: nothing was measured")
    if given.check:
        tell(f"{file}: good")
        return 0
    require("matplotlib")
    target = Path(given.run_dir or Path("benchmarks") / experiment.name)
    refuse_replacing(target, file, given.force)
    text, files = run(experiment, Folder(target), given.threads)
    print(text, end="", flush=True)
    tell(f"written to {target}: {' '.join(files)}")
    return 0


def _end_by(number: int) -> int:
    """End as a program does that Ctrl-C ends: by the signal, so that a loop of the shell ends, too."""
    tell("error: cancelled; nothing was written")
    if number == signal.SIGINT:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
    return 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return the exit code; messages go to stderr."""
    heard: list[int] = []

    def stop(number: int, _: Any) -> NoReturn:
        heard.append(number)
        raise KeyboardInterrupt

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)
    warnings.showwarning = lambda message, *_, **__: tell(f"warning: {message}")
    try:
        return bench(sys.argv[1:] if arguments is None else arguments)
    except KeyboardInterrupt:
        return _end_by(heard[0] if heard else signal.SIGINT)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except Error as error:
        tell(f"error: {error}")
        return _CODES.get(error.code, 1)
