"""YAML texts as trees of values that know their places."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import yaml  # type: ignore

from .findings import Findings, Place, in_quotes

_INTEGER = re.compile(r"[-+]?[0-9]+")
_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)")
_WORDS = {"": None, "~": None, "null": None, "Null": None, "NULL": None,
          "true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}  # fmt: skip


@dataclass
class Value:
    """A value of a tree. Words are those of YAML 1.2's core schema: `yes` and `on` are texts."""

    kind: str  #: null, boolean, integer, number, text, list or map
    where: Place
    text: str = ""  #: of a scalar, as it is written
    plain: Any = None  #: of a scalar: None, bool, int, float or str
    items: list[Value] = field(default_factory=list)  #: of a list, or of a map by its keys
    keys: list[Key] = field(default_factory=list)

    def find(self, name: str) -> Value | None:
        """Return the value of a key; None if there is none."""
        return next((value for key, value in self.pairs() if key.text == name), None)

    def pairs(self) -> Iterator[tuple[Key, Value]]:
        """Give the keys and values of a map, in their order."""
        return zip(self.keys, self.items)

    def as_list(self) -> list[Value]:
        """Return the items of a list; of another value a list of it alone."""
        return self.items if self.kind == "list" else [self]

    @property
    def description(self) -> str:
        """The value in the words of messages."""
        if self.kind in ("list", "map"):
            return f"a {self.kind}"
        if self.kind == "null":
            return "nothing"
        if self.kind == "text":
            return f"the text {in_quotes(self.text)}"
        return self.text if len(self.text) <= 40 else "a long number"

    def data(self) -> Any:
        """Return the value as Python has it, for JSON."""
        if self.kind == "list":
            return [item.data() for item in self.items]
        if self.kind == "map":
            return {key.text: item.data() for key, item in self.pairs()}
        return self.plain


@dataclass(frozen=True)
class Key:
    """A key of a map."""

    text: str
    where: Place


def scalar(text: str, where: Place) -> Value:
    """Return what a text without quotes means."""
    if text in _WORDS:
        word = _WORDS[text]
        return Value("null" if word is None else "boolean", where, text, word)
    if _INTEGER.fullmatch(text):
        return Value("integer", where, text, int(text))
    if _NUMBER.fullmatch(text):
        number = float(re.sub(r"\.(inf|nan)", r"\1", text.lower()))
        return Value("number", where, text, math.nan if math.isinf(number) and "inf" not in text.lower() else number)
    return Value("text", where, text, text)


def _place(mark: Any) -> Place:
    return Place(mark.line + 1, mark.column + 1)


def _value_of(node: Any, findings: Findings) -> Value:
    where = _place(node.start_mark)
    if isinstance(node, yaml.ScalarNode):
        quoted = node.style is not None or node.tag == "!"
        return Value("text", where, node.value, node.value) if quoted else scalar(node.value, where)
    if isinstance(node, yaml.SequenceNode):
        return Value("list", where, items=[_value_of(item, findings) for item in node.value])
    result = Value("map", where)
    for name, item in node.value:
        key = Key(name.value if isinstance(name, yaml.ScalarNode) else "", _place(name.start_mark))
        if any(other.text == key.text for other in result.keys):
            findings.error(key.where, "duplicate-key", f"the key {in_quotes(key.text)} is there twice; remedy: delete one")
        result.keys.append(key)
        result.items.append(_value_of(item, findings))
    return result


def parse(text: str, findings: Findings) -> Value | None:
    """Return the tree of a text; None after a finding."""
    try:
        node = yaml.compose(text, yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        findings.error(_place(mark) if mark else Place(1, 1), "syntax", str(error.problem or error.context))
        return None
    except (yaml.YAMLError, RecursionError) as error:
        findings.error(Place(1, 1), "syntax", " ".join(str(error).split()))
        return None
    return Value("null", Place(1, 1)) if node is None else _value_of(node, findings)
