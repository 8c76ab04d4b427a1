"""The search of the documentation as HTML, in Chromium, on pages opened from disk.

search_test.py REPOSITORY
"""
import html
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

import html_test

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
# The page that is open, what is searched, and what must be found first.
SEARCHES = [
    ("index.html", "read_mesh", "./reference/python.html#foamread_mesh"),
    ("guide/python.html", "class cover", "../reference/python.html#class-foamcover"),
    ("reference/stages/spherize.cover.html", "FOAM_region_free", "../../reference/c.html#foam_region_free"),
    ("index.html", "glossary swept box", "./dev/glossary.html#geometry"),
    ("index.html", "no_such_word", None),
]


def opened(page, words, profile):
    """A page with its results, as Chromium has it after its scripts ran."""
    address = f"{page.as_uri()}?q={urllib.parse.quote(words)}"
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=10000",
               f"--user-data-dir={profile}", "--dump-dom", address]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def results_of(document):
    return re.search(r'<ol id="results">(.*?)</ol>', document, re.DOTALL)[1]


def findings_of(site, profile):
    for page, words, wanted in SEARCHES:
        results = results_of(opened(site / page, words, profile))
        links = [html.unescape(link) for link in re.findall(r'<a href="([^"]*)"', results)]
        if links[:1] != ([wanted] if wanted else []) or (not wanted and results != "Nothing found"):
            yield f"{page}: '{words}' finds {links[:3] or results}, not {wanted}"


def main():
    missing = [name for name, path in (("mkdocs", shutil.which("mkdocs")), ("Chromium", CHROMIUM)) if not path]
    if missing:
        print(f"skipped: there is no {' and no '.join(missing)}")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder, "site").resolve()
        findings = html_test.build(pathlib.Path(sys.argv[1]), site) or list(findings_of(site, f"{folder}/profile"))
    print("\n".join(findings) or f"{len(SEARCHES)} searches find what they should")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
