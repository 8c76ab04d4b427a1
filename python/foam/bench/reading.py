"""Reads experiments: a YAML file, checked as a whole."""

from __future__ import annotations

from pathlib import Path

from .._judge import stages
from . import tree
from .experiment import Experiment, Source
from .findings import START, Finding, Findings, in_quotes
from .kinds import KINDS
from .stages import Reader
from .values import Parameter, read_value, required, text, why_no_file_name

_FORMAT = 1
_MOST_BYTES = 1_000_000


def read(file: Path) -> tuple[Experiment | None, list[Finding]]:
    """Return the experiment of a file, or what is wrong with it: all findings at once."""
    try:
        content = file.read_bytes()
    except OSError as error:
        return None, [Finding(str(file), None, "cannot-read", (error.strerror or str(error)).lower())]
    if len(content) > _MOST_BYTES:
        return None, [Finding(str(file), None, "too-large", f"the text has more than {_MOST_BYTES} bytes")]
    try:
        return parse(content.decode(), file)
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        return None, [Finding(f"{file}:{line}", None, "encoding", "the text is not UTF-8; remedy: save it as UTF-8")]


def parse(content: str, file: Path) -> tuple[Experiment | None, list[Finding]]:
    """Return the experiment of a text, as read() does. `file`: relative references start at its folder."""
    findings = Findings(str(file))
    root = tree.parse(content, findings)
    experiment = None if root is None else _read_root(root, findings, file)
    if experiment is None or findings:
        return None, findings.in_order()
    experiment.file, experiment.source = file, content
    return experiment, []


def _read_root(root: tree.Value, findings: Findings, file: Path) -> Experiment | None:
    begin = f"foam_experiment: {_FORMAT}"
    if root.kind != "map":
        findings.error(
            START, "wrong-type", f"an experiment is a map, got {root.description}; remedy: begin with '{begin}'"
        )
        return None
    version = root.find("foam_experiment")
    if version is None:
        findings.error(
            START, "missing-key",
            "this is a recipe; remedy: run it by `foam run`" if root.find("foam")
            else f"the version of the experiment format is missing; remedy: begin with '{begin}'",
        )  # fmt: skip
        return None
    if version.plain != _FORMAT or version.kind != "integer":
        findings.error(
            version.where, "version",
            f"this foam reads experiment format {_FORMAT}, the file says {version.description}; remedy: write '{begin}'",
        )  # fmt: skip
    kind = required(root, "kind", "kind: time_against_triangles", findings)
    declared = Parameter("kind", "choice", choices=tuple(KINDS))
    name = None if kind is None else read_value(kind, declared, "", findings)
    if name is None:
        return None
    experiment = KINDS[name](Source(root, Reader(stages(), findings), findings, file.parent))
    _read_names(root, experiment, findings)
    return experiment


def _read_names(root: tree.Value, experiment: Experiment, findings: Findings) -> None:
    name = required(root, "name", "name: my_experiment", findings)
    title = root.find("title")
    experiment.name = "" if name is None else read_value(name, text("name"), "", findings) or ""
    if name is not None and name.kind == "text" and (why := why_no_file_name(experiment.name)):
        findings.error(
            name.where, "bad-name",
            f"'name' is the name of the folder of results; {in_quotes(experiment.name)} {why}",
        )  # fmt: skip
    given = "" if title is None else read_value(title, text("title"), "", findings)
    experiment.title = given or experiment.name
