"""Other programs of foam that experiments run and measure."""

from __future__ import annotations

import json
import math
import os
import resource
import signal
import subprocess
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import _core
from .._installation import program
from ..errors import UsageError, error_of


@dataclass
class Measured:
    """A process that has ended."""

    cpu_seconds: float  #: user and system
    memory: float  #: bytes; the most that was resident
    exit_code: int
    over_limit: bool  #: it was ended
    output: str  #: what it wrote to stdout
    errors: str  #: and to stderr


def foam_program() -> str:
    """Return the program `foam` of this installation. Raises UsageError if it is not there."""
    file = program()
    if not file:
        raise UsageError("the program foam is not there; remedy: install it, or build it by `./foam bench`")
    return file


def _most_resident(process: int) -> float:
    """The most memory that was resident so far, bytes; 0 if the process has ended. The figure of wait4() would not be less
    than that of this process, from which the child was started."""
    try:
        status = Path(f"/proc/{process}/status").read_text()
    except OSError:
        return 0
    return next((1024.0 * float(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM:")), 0.0)


def run_measured(arguments: list[str], cpu_limit: float, scratch: Path) -> Measured:
    """Run a program to its end and measure it. `cpu_limit`: s."""
    output, errors = scratch / "stdout", scratch / "stderr"
    with output.open("wb") as out, errors.open("wb") as err:
        process = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=out, stderr=err)
    limit = math.ceil(cpu_limit) + 1
    try:
        resource.prlimit(process.pid, resource.RLIMIT_CPU, (limit, limit))
        memory, ended, status = 0.0, 0, 0
        while ended == 0:
            memory = max(memory, _most_resident(process.pid))
            time.sleep(0.002)
            ended, status, used = os.wait4(process.pid, os.WNOHANG)
    except BaseException:
        process.kill()
        process.wait()
        raise
    process.returncode = os.waitstatus_to_exitcode(status)
    return Measured(
        used.ru_utime + used.ru_stime, memory, process.returncode,
        -process.returncode in (signal.SIGXCPU, signal.SIGKILL), output.read_text(), errors.read_text(),
    )  # fmt: skip


def engine_folder() -> Path:
    """Return the folder of the programs that ask collision libraries; it may be missing."""
    return Path(_core.plugin_folders()[-1]).parent / "engines"


def engine_program(name: str, remedy: str) -> Path:
    """Return the program of that name. Raises Error with the remedy if it is not built."""
    program = engine_folder() / name
    if not program.is_file():
        raise error_of("plugin", f"the program {name} is not built; remedy: {remedy}")
    return program


def answers(program: Path, request: Any) -> Iterator[dict[str, Any]]:
    """Give the answers of a program, lines of JSON, to a request of JSON. It dies with the caller's interest.

    Raises Error for an answer {"error": …}, with its "code" if it has one, and for an end without an answer.
    """
    with subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdin is not None and process.stdout is not None
        try:
            process.stdin.write(json.dumps(request))
            process.stdin.close()
            answer: dict[str, Any] = {}
            for line in process.stdout:
                answer = json.loads(line)
                if "error" in answer:
                    raise error_of(answer.get("code", "input"), answer["error"])
                yield answer
            if process.wait() != 0 or not answer:
                raise error_of("internal", f"{program.name} ended with exit code {process.returncode} before it was done")
        except BrokenPipeError:
            raise error_of("internal", f"{program.name} ended before it had read the request") from None
        finally:
            process.kill()
