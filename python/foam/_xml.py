"""XML as a tree of dictionaries and back, in the shape that the package xmltodict uses.

Attributes are "@name", text beside them "#text"; an element that occurs several times is a list; text alone is a str.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any
from xml.parsers import expat
from xml.sax.saxutils import escape, quoteattr

from .errors import InputError


class _Tree:
    def __init__(self) -> None:
        self.stack: list[tuple[str, dict[str, Any], list[str]]] = [("", {}, [])]

    def start(self, name: str, attributes: dict[str, str]) -> None:
        self.stack.append((name, {f"@{key}": value for key, value in attributes.items()}, []))

    def text(self, text: str) -> None:
        self.stack[-1][2].append(text)

    def end(self, name: str) -> None:
        _, content, texts = self.stack.pop()
        text = "".join(texts).strip()
        value: Any = content
        if content and text:
            content["#text"] = text
        elif not content:
            value = text or None
        parent = self.stack[-1][1]
        if name in parent:
            if not isinstance(parent[name], list):
                parent[name] = [parent[name]]
            parent[name].append(value)
        else:
            parent[name] = value


def parse(text: bytes, file: str) -> dict[str, Any]:
    """Return the tree of an XML text. Raises InputError with the line. Entities of the file's own are refused."""
    tree = _Tree()
    parser = expat.ParserCreate()
    parser.buffer_text = True
    parser.StartElementHandler = tree.start
    parser.EndElementHandler = tree.end
    parser.CharacterDataHandler = tree.text

    def refuse(*_: Any) -> None:
        raise InputError(f"{file}: it defines entities; remedy: write them out")

    parser.EntityDeclHandler = refuse
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise InputError(f"{file}:{error.lineno}:{error.offset}: XML: {expat.ErrorString(error.code)}") from None
    return tree.stack[0][1]


def unparse(tree: Mapping[str, Any]) -> str:
    """Return the XML text of a tree, with two blanks a level."""
    lines = ['<?xml version="1.0" encoding="utf-8"?>']
    for name, value in tree.items():
        _write(name, value, "", lines)
    return "\n".join(lines) + "\n"


def _write(name: str, value: Any, indent: str, lines: list[str]) -> None:
    if isinstance(value, (list, tuple)):
        for one in value:
            _write(name, one, indent, lines)
        return
    if not isinstance(value, Mapping):
        lines.append(f"{indent}<{name}/>" if value is None else f"{indent}<{name}>{escape(str(value))}</{name}>")
        return
    start = name + "".join(f" {key[1:]}={quoteattr(str(text))}" for key, text in value.items() if key[0] == "@")
    children = [(key, child) for key, child in value.items() if key[0] not in "@#"]
    text = value.get("#text")
    if not children:
        lines.append(f"{indent}<{start}/>" if text is None else f"{indent}<{start}>{escape(str(text))}</{name}>")
        return
    lines.append(f"{indent}<{start}>")
    if text is not None:
        lines.append(f"{indent}  {escape(str(text))}")
    for key, child in children:
        _write(key, child, indent + "  ", lines)
    lines.append(f"{indent}</{name}>")
