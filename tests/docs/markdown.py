"""The few parts of Markdown that the tests of the pages look at: fenced blocks, headings, links, images."""
import dataclasses
import re

FENCE = re.compile(r"^(?P<indent> *)(?P<marks>`{3,})(?P<language>[\w+-]*)\s*$")
REMARK = re.compile(r"^\s*<!-- *(?P<text>.*?) *-->\s*$")
LINK = re.compile(r"(?P<image>!?)\[(?P<text>(?:[^\[\]]|\[[^\]]*\])*)\]\((?P<target>[^)\s]+)\)")


@dataclasses.dataclass
class Block:
    """A fenced block. line: of its first line of content, from 1. remark: the HTML comment before the fence."""
    language: str
    line: int
    lines: list
    remark: str

    @property
    def text(self):
        return "".join(line + "\n" for line in self.lines)


@dataclasses.dataclass
class Link:
    line: int
    target: str
    image: bool


@dataclasses.dataclass
class Page:
    blocks: list
    links: list
    anchors: set


def slug(heading):
    """The anchor that Markdown renderers give a heading."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
    return re.sub(r"[^\w\- ]", "", plain).strip().replace(" ", "-")


def read(path):
    blocks, links, anchors = [], [], set()
    remark, block, closing = "", None, ""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        fence = FENCE.match(line)
        if block is not None:
            if line.strip() == closing:
                blocks.append(block)
                block = None
            else:
                block.lines.append(line.removeprefix(indent))
        elif fence:
            indent, closing = fence["indent"], fence["marks"]
            block = Block(fence["language"], number + 1, [], remark)
        else:
            if heading := re.match(r"#+ +(.*)", line):
                anchors.add(slug(heading[1]))
            for link in LINK.finditer(re.sub(r"`[^`]*`", "", line)):
                links.append(Link(number, link["target"], bool(link["image"])))
        found = REMARK.match(line)
        remark = found["text"] if found else ""
    if block is not None:
        raise ValueError(f"{path}:{block.line}: this block is not closed")
    return Page(blocks, links, anchors)


def pages(repository):
    """README.md, CONTRIBUTING.md, … and all pages of docs/."""
    return sorted(repository.glob("*.md")) + sorted(repository.glob("docs/**/*.md"))
