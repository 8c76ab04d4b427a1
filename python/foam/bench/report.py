"""The report of an experiment: results.md, and what it was measured on."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import subprocess
from pathlib import Path

import pandas  # type: ignore

from .._judge import stages
from .experiment import Experiment, Outcome, table
from .programs import foam_program


def to_csv(rows: pandas.DataFrame) -> bytes:
    """Return the table as a CSV file."""
    return str(rows.to_csv(index=False, lineterminator="\n")).encode()


def to_markdown(rows: pandas.DataFrame) -> str:
    """Return the table for a Markdown page: the first column to the left, the others to the right."""
    lines = [list(rows.columns), *rows.fillna("").values.tolist()]
    texts = ["| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |" for line in lines]
    return "\n".join([texts[0], "|---|" + "---:|" * (len(rows.columns) - 1), *texts[1:]]) + "\n"


def _processor() -> str:
    """The "model name" of Linux; "unknown" where there is none."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    name = next((line.partition(": ")[2] for line in lines if line.startswith("model name")), "unknown")
    cores = os.cpu_count() or 1
    return f"{name}, {cores} thread{'' if cores == 1 else 's'}"


def circumstances(experiment: Experiment, threads: int) -> pandas.DataFrame:
    """Return the machine and the versions behind the results."""
    foam = json.loads(subprocess.run([foam_program(), "version", "--json"], check=True, capture_output=True).stdout)
    known = stages()
    plugins = {f"{known[name]['plugin']} {known[name]['plugin_version']}" for name in experiment.stages() if name in known}
    digest = hashlib.sha256(experiment.source.encode()).hexdigest()[:32]
    return table(["measured on", ""], [
        ["processor", _processor()],
        ["threads of a stage", str(threads) if threads else "all"],
        ["foam", foam["foam_version"]],
        ["compiler", foam["built_from"].rpartition(", ")[2]],
        ["libraries", ", ".join(f"{name} {version}" for name, version in foam["libraries"].items())],
        ["plugins", ", ".join(sorted(plugins))],
        ["python", platform.python_version()],
        ["experiment", f"{experiment.file.name}, digest {digest}"],
    ])  # fmt: skip


def page(experiment: Experiment, outcome: Outcome, measured_on: pandas.DataFrame) -> str:
    """Return results.md."""
    parts = [f"# {experiment.title}\n"]
    for section in outcome.sections:
        if section.title:
            parts.append(f"## {section.title}\n")
        if section.text:
            parts.append(f"{section.text.rstrip()}\n")
        if section.figure:
            parts.append(f"![{section.title or experiment.title}]({section.figure})\n")
        if section.table is not None:
            parts.append(to_markdown(section.table))
    return "\n".join([*parts, "## Measured on\n", to_markdown(measured_on)])
