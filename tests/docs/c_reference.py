"""foam.h as a page: each declaration under its name, after the comment that stands before it."""
import re

import prose

COMMENT = re.compile(r"/\*(.*?)\*/\n?", re.DOTALL)
# What is for the compiler alone.
GUARD = re.compile(r"^(?:#(?:if|else|elif|endif|include).*|#define FOAM_H|\})$", re.MULTILINE)
NAMES = [re.compile(pattern, re.DOTALL) for pattern in (
    r"^#define (?P<name>\w+)", r"^typedef struct (?P<name>\w+)", r"^FOAM_API [^(]*?(?P<name>\w+)\(")]


def comment_text(comment):
    """A comment without the stars at the beginning of its lines."""
    return "\n".join(re.sub(r"^ \* ?", "", line.rstrip()) for line in comment.splitlines()).strip()


def declarations(header):
    """(comment, code) of every declaration: they begin with a comment at the beginning of a line."""
    starts = [found.start() for found in re.finditer(r"^/\*", header, re.MULTILINE)] + [len(header)]
    for start, end in zip(starts, starts[1:]):
        comment = COMMENT.match(header, start)
        yield comment_text(comment[1]), header[comment.end():end].strip()


def name_of(comment, code):
    """What a declaration is called; constants without a name of their own after the first of them."""
    for pattern in NAMES:
        if found := pattern.match(code):
            return found["name"] + ("()" if code.startswith("FOAM_API") else "")
    first = re.match(r"enum \{\s*(\w+)", code)
    if not first:
        raise ValueError(f"foam.h: no name in {code!r} after {comment!r}")
    return f"{first[1]}, …"


def page_of(header, made):
    """The page of the header's text."""
    (about, _), *found = declarations(header)
    page = f"# C header\n\n{made}\n[foam in C](../guide/c_interface.md) shows how to use `foam.h`.\n\n"
    page += prose.markdown(about)
    for comment, code in ((comment, GUARD.sub("", code).strip()) for comment, code in found):
        page += f"\n## {name_of(comment, code)}\n\n```c\n{code}\n```\n\n{prose.markdown(comment)}"
    return page
