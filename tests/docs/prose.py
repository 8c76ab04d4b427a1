"""Comments and docstrings of sources as Markdown."""
import re

SECTIONS = {"Args": "Arguments"}
NAMES = r"^(?P<names>\*{0,2}[A-Za-z][\w.]*(?:, [A-Za-z][\w.]*)*)"
COLUMNS = re.compile(NAMES + r"  +(?P<text>.*)")
ITEM = re.compile(NAMES + r"(?:: |  +)(?P<text>.*)")
# What Markdown would take for HTML or emphasis, outside of code.
CODE_OR_MARK = re.compile(r"`[^`]*`|[<*]")
MARKS = {"<": "&lt;", "*": "\\*"}


def escaped(text):
    return CODE_OR_MARK.sub(lambda found: MARKS.get(found[0], found[0]), text)


def items(lines, item=ITEM):
    """A list of lines `name: text` or `name   text`; indented lines below belong to them, others stay prose."""
    margin = min(len(line) - len(line.lstrip()) for line in lines)
    found = []
    for line in (line[margin:] for line in lines):
        if entry := item.match(line):
            names = ", ".join(f"`{name}`" for name in entry["names"].split(", "))
            found.append(f"- {names}: {escaped(entry['text'].strip())}")
        elif line.startswith(" ") and found:
            found[-1] += " " + escaped(line.strip())
        else:
            found.append(escaped(line))
    return "\n".join(found)


def is_list(lines):
    return bool(COLUMNS.match(lines[0])) and all(COLUMNS.match(line) or line.startswith(" ") for line in lines)


def markdown(text):
    """Paragraphs; code that is indented; a section `Args:` with its items; columns as a list."""
    text = re.sub(r"^(\S.* .*:)\n(?=    )", r"\1\n\n", text, flags=re.MULTILINE)
    parts, section = [], ""
    for block in re.split(r"\n\s*\n", text.strip()):
        lines = block.splitlines()
        heading = re.fullmatch(r"(\w+):", lines[0])
        if heading and len(lines) > 1 and all(line.startswith(" ") for line in lines[1:]):
            section = SECTIONS.get(heading[1], heading[1])
            parts += [f"*{section}*", items(lines[1:])]
        elif all(line.startswith("    ") for line in lines):
            parts.append(items(lines) if section else block)
        else:
            section = ""
            parts.append(items(lines, COLUMNS) if is_list(lines) else escaped(block))
    return "\n\n".join(parts) + "\n"


def first_sentence(text):
    """For a cell of a table."""
    paragraph = " ".join(text.split("\n\n")[0].split())
    return escaped(re.split(r"(?<=[.!?]) (?=[A-Z])", paragraph)[0]).replace("|", "\\|")
