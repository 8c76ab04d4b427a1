"""The documentation as HTML: built without a warning, nothing comes from the network, every link leads somewhere.

html_test.py REPOSITORY
"""
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

RESOURCES = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}
# Rows of tables, items of lists and fences that the renderer took for prose.
UNREAD = re.compile(r"^(?:\|.*\||[-*] .*|\d+\. .*|```.*)$", re.MULTILINE)
NETWORK = re.compile(r"(https?:)?//")


class References(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.resources, self.links, self.anchors, self.prose, self.code = [], [], set(), "", 0
        self.feed(text)

    def handle_endtag(self, tag):
        self.code -= tag in ("pre", "code")

    def handle_data(self, data):
        self.prose += "" if self.code else data

    def handle_starttag(self, tag, attributes):
        self.code += tag in ("pre", "code")
        attributes = dict(attributes)
        if "id" in attributes:
            self.anchors.add(attributes["id"])
        target = attributes.get(RESOURCES.get(tag, "href"))
        if target is not None:
            (self.resources if tag in RESOURCES else self.links).append(target)


def findings_of(site):
    pages = {file: References(file.read_text()) for file in site.rglob("*.html") if file.name != "404.html"}
    for file, page in pages.items():
        name = file.relative_to(site)
        yield from (f"{name}: {line} is shown as it was written" for line in UNREAD.findall(page.prose))
        yield from (f"{name}: {target} comes from the network" for target in page.resources if NETWORK.match(target))
        for target in page.links + page.resources:
            path, _, anchor = target.partition("#")
            if re.match(r"[a-z]+:|//", target):
                continue
            found = (file.parent / path.partition("?")[0]).resolve() if path else file
            if not found.exists():
                yield f"{name}: {target} does not exist"
            elif anchor and anchor not in pages[found].anchors:
                yield f"{name}: {target}: no such place"
    for file in site.rglob("*.css"):
        yield from (f"{file.name}: {url} comes from the network"
                    for url in re.findall(r"(?:url\(|@import )[\"']?((?:https?:)?//[^\"') ]+)", file.read_text()))


def build(repository, site):
    """Builds the pages; returns what mkdocs finds wrong."""
    command = ["mkdocs", "build", "--strict", "--quiet", "--config-file", repository / "mkdocs.yml", "--site-dir", site]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return [done.stdout or f"mkdocs ends with {done.returncode}"] if done.returncode or done.stdout else []


def main():
    if not shutil.which("mkdocs"):
        print("skipped: there is no mkdocs")
        return 77
    repository = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder).resolve()
        findings = build(repository, site) or list(findings_of(site))
        pages = len(list(site.rglob("*.html")))
    if pages < 10 and not findings:
        findings = [f"there are only {pages} pages"]
    print("\n".join(findings) or f"{pages} pages need no network")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
