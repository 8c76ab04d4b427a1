"""Values of an experiment, checked against their declarations."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .findings import START, Findings, in_quotes, nearest, suggestion
from .tree import Value, scalar

_METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254}


@dataclass(frozen=True)
class Parameter:
    """The declaration of a value."""

    name: str
    type: str  #: integer, number, text, choice or boolean
    default: Any = None
    low: float | None = None
    high: float | None = None
    unit: str = ""
    choices: tuple[str, ...] = ()

    @classmethod
    def of_stage(cls, declared: dict[str, Any]) -> Parameter:
        """Return the parameter that `foam describe --json` prints."""
        return cls(declared["name"], declared["type"], declared.get("default"), declared.get("low"), declared.get("high"),
                   declared.get("unit", ""), tuple(declared.get("choices", ())))  # fmt: skip

    @property
    def expectation(self) -> str:
        """What is expected, in words."""
        if self.type == "boolean":
            return "true or false"
        if self.type == "text":
            return "text"
        if self.type == "choice":
            return f"one of {', '.join(self.choices)}"
        text = "an integer" if self.type == "integer" else "a number"
        if self.low is not None and self.high is not None:
            return f"{text} between {_bound(self.low)} and {_bound(self.high)}"
        if self.low is not None:
            return f"{text} of at least {_bound(self.low)}"
        return text if self.high is None else f"{text} of at most {_bound(self.high)}"


def integer(name: str, default: int, low: float, high: float) -> Parameter:
    """Declare an integer."""
    return Parameter(name, "integer", default, low, high)


def number(name: str, default: float, low: float, high: float, unit: str = "") -> Parameter:
    """Declare a number."""
    return Parameter(name, "number", default, low, high, unit)


def text(name: str) -> Parameter:
    """Declare a text."""
    return Parameter(name, "text", "")


def _bound(value: float) -> str:
    return str(int(value)) if abs(value) < 1e15 and value == math.floor(value) else repr(value)


def _length(written: str) -> float | None:
    """The metres of "10mm" or "1 cm"; None of anything else."""
    match = re.fullmatch(r"(.*?) ?(mm|cm|m|in)", written)
    value = scalar(match[1], START) if match else None
    return value.plain * _METRES[match[2]] if match and value and value.kind in ("integer", "number") else None


def _converted(value: Value, parameter: Parameter) -> Any:
    """The value in the declared type; None if it has another type."""
    if parameter.type == "boolean":
        return value.plain if value.kind == "boolean" else None
    if parameter.type in ("text", "choice"):
        return value.text if value.kind == "text" else None
    if parameter.type == "number":
        if value.kind == "text" and parameter.unit == "m":
            return _length(value.text)
        return float(value.plain) if value.kind in ("integer", "number") and math.isfinite(value.plain) else None
    if value.kind == "integer":
        return value.plain
    whole = value.kind == "number" and math.isfinite(value.plain) and value.plain == math.floor(value.plain)
    return int(value.plain) if whole and abs(value.plain) <= 2**53 else None


def _valid(parameter: Parameter, value: Any) -> bool:
    if parameter.type == "choice":
        return value in parameter.choices
    if parameter.type in ("integer", "number"):
        return (parameter.low is None or value >= parameter.low) and (parameter.high is None or value <= parameter.high)
    return True


def _remedy(value: Value, parameter: Parameter) -> str:
    if parameter.type == "choice":
        near = nearest(value.text, parameter.choices) if value.kind == "text" else ""
        return f"; did you mean {in_quotes(near)}?" if near else ""
    if parameter.type == "text":
        return f'; remedy: put it in quotes, "{value.text}"' if value.text else ""
    if parameter.type in ("integer", "number") and value.kind == "text":
        if scalar(value.text, START).kind in ("integer", "number"):
            return f"; remedy: without quotes, {value.text}"
        if re.match(r"[-+.]?[0-9]", value.text):
            return f"; remedy: write the bare number{f', in {parameter.unit}' if parameter.unit not in ('', '1') else ''}"
    return ""


def read_value(value: Value, parameter: Parameter, owner: str, findings: Findings) -> Any:
    """Return the value as it is declared; None after a finding. `owner`: what it belongs to; empty: the experiment."""
    result = _converted(value, parameter)
    if result is not None and _valid(parameter, result):
        return result
    code = "wrong-type"
    if result is not None:
        code = "out-of-bounds" if parameter.type in ("integer", "number") else "unknown-choice"
    name = f"{in_quotes(parameter.name)} of {owner}" if owner else in_quotes(parameter.name)
    findings.error(
        value.where, code, f"{name} expects {parameter.expectation}, got {value.description}{_remedy(value, parameter)}"
    )
    return None


def read_values(
    map_: Value, declared: Sequence[Parameter], owner: str, others: Sequence[str], findings: Findings
) -> dict[str, Any]:
    """Return the values that are given, as they are declared; a finding for each key that is neither declared nor among
    `others`."""
    given = {}
    for parameter in declared:
        value = map_.find(parameter.name)
        checked = None if value is None else read_value(value, parameter, owner, findings)
        if checked is not None:
            given[parameter.name] = checked
    refuse_unknown_keys(map_, owner, [*(p.name for p in declared), *others], findings)
    return given


def refuse_unknown_keys(map_: Value, owner: str, known: Sequence[str], findings: Findings) -> None:
    """Add a finding for each key that is not known."""
    for key in map_.keys:
        if key.text not in known:
            within = f" in {owner}" if owner else ""
            findings.error(
                key.where, "unknown-key", f"unknown key {in_quotes(key.text)}{within}{suggestion(key.text, list(known))}"
            )


def _expect(kind: str, value: Value, name: str, example: str, findings: Findings) -> bool:
    if value.kind != kind:
        findings.error(
            value.where, "wrong-type", f"'{name}' expects a {kind}, got {value.description}; remedy: write {example}"
        )
    return value.kind == kind


def expect_map(value: Value, name: str, example: str, findings: Findings) -> bool:
    """Return whether it is a map; otherwise add a finding."""
    return _expect("map", value, name, example, findings)


def expect_list(value: Value, name: str, example: str, findings: Findings) -> bool:
    """Return whether it is a list; otherwise add a finding."""
    return _expect("list", value, name, example, findings)


def required(root: Value, key: str, example: str, findings: Findings) -> Value | None:
    """Return the value of a key that must be there; None after a finding."""
    value = root.find(key)
    if value is None:
        findings.error(START, "missing-key", f"'{key}' is missing; remedy: write {example}")
    return value


def read_texts(value: Value, name: str, findings: Findings) -> list[str]:
    """Return a text or a list of texts as a list."""
    texts = []
    for item in value.as_list():
        if item.kind == "text" and item.text:
            texts.append(item.text)
            continue
        quotes = f'; remedy: put it in quotes, "{item.text}"' if item.text else ""
        findings.error(
            item.where, "wrong-type", f"'{name}' expects a text or a list of texts, got {item.description}{quotes}"
        )
    if value.kind == "list" and not value.items:
        findings.error(value.where, "wrong-type", f"'{name}' expects at least one text, got an empty list")
    return texts


def read_counts(value: Value, key: str, low: float, high: float, findings: Findings) -> list[int]:
    """Return a list of integers within the bounds, each larger than the one before it."""
    counts: list[int] = []
    if not expect_list(value, key, f"{key}: [1, 2, 4]", findings):
        return counts
    if not value.items:
        findings.error(value.where, "wrong-type", f"'{key}' expects at least one number")
    for item in value.items:
        count = read_value(item, integer(key, 1, low, high), "", findings)
        if count is None:
            continue
        if counts and count <= counts[-1]:
            findings.error(
                item.where, "out-of-order", f"'{key}' expects ascending numbers, got {count} after {counts[-1]}"
            )
        counts.append(count)
    return counts


def required_counts(root: Value, key: str, example: str, low: float, high: float, findings: Findings) -> list[int]:
    """Return the list of a key that must be there."""
    value = required(root, key, example, findings)
    return [] if value is None else read_counts(value, key, low, high, findings)


def why_no_file_name(name: str) -> str:
    """Return why a text cannot name a file or a folder; empty if it can."""
    if not name:
        return "is empty"
    if name[0] in ".-":
        return f"begins with '{name[0]}'"
    if not re.fullmatch(r"[A-Za-z0-9_\-+=.]*", name):
        return "holds other characters than letters, digits, _ - + = and ."
    return "is longer than 200 characters" if len(name) > 200 else ""
