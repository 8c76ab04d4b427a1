"""Links between pages lead somewhere, images exist, and docs/index.md leads to every page.

check_links.py REPOSITORY
"""
import pathlib
import re
import sys

import markdown


def destination(page, target):
    """File and anchor that a relative link names; None for a link to the network."""
    if re.match(r"[a-z]+:", target):
        return None
    file, _, anchor = target.partition("#")
    return (page.parent / file).resolve() if file else page, anchor


def findings_of(repository, pages):
    for path, page in pages.items():
        for link in page.links:
            place = f"{path.relative_to(repository)}:{link.line}"
            found = destination(path, link.target)
            if found is None:
                if link.image:
                    yield f"{place}: the image {link.target} comes from the network"
                continue
            file, anchor = found
            if not file.is_relative_to(repository):
                yield f"{place}: {link.target} is outside of the repository"
            elif not file.exists():
                yield f"{place}: {link.target} does not exist"
            elif anchor and file in pages and anchor not in pages[file].anchors:
                yield f"{place}: {file.name} has no heading #{anchor}"


def reachable(pages, start):
    seen, waiting = set(), [start]
    while waiting:
        path = waiting.pop()
        if path in seen or path not in pages:
            continue
        seen.add(path)
        waiting += [found[0] for link in pages[path].links if (found := destination(path, link.target))]
    return seen


def main():
    repository = pathlib.Path(sys.argv[1]).resolve()
    pages = {path: markdown.read(path) for path in markdown.pages(repository)}
    findings = list(findings_of(repository, pages))
    index = repository / "docs/index.md"
    for path in pages.keys() - reachable(pages, index):
        if path.is_relative_to(repository / "docs"):
            findings.append(f"{path.relative_to(repository)}: no links lead here from docs/index.md")
    links = sum(len(page.links) for page in pages.values())
    print("\n".join(sorted(findings)) or f"{links} links on {len(pages)} pages lead somewhere")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
