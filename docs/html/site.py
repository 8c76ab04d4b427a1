"""What mkdocs has to know of these pages: docs/index.md is the navigation, the pages beside docs/ belong to them, links
to other files of the repository become text, and the search index is a script."""
import json
import os
import pathlib
import re

from mkdocs.structure.files import File

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
CODE_OR_LINK = re.compile(r"^ *```.*?^ *```|`[^`\n]*`|" + LINK.pattern, re.MULTILINE | re.DOTALL)
DOCS = pathlib.Path(__file__).resolve().parents[1]


def page_of(file):
    """What mkdocs calls a file: its path in docs/; for README.md and its neighbours their name; None for others."""
    if file.is_relative_to(DOCS):
        return str(file.relative_to(DOCS))
    return file.name if file.parent == DOCS.parent and file.suffix == ".md" else None


def navigation_of(index):
    """Home, then a list of pages for each heading of the index."""
    navigation = [{"foam": "index.md"}]
    for section in re.split(r"^## +", index, flags=re.MULTILINE)[1:]:
        title = section.splitlines()[0]
        links = [(text, page_of((DOCS / target).resolve())) for _, text, target in LINK.findall(section)]
        navigation.append({title: [{text: page} for text, page in links if page]})
    return navigation


def on_config(config):
    config["nav"] = navigation_of((DOCS / "index.md").read_text(encoding="utf-8"))
    return config


def on_files(files, config):
    kept = [file for file in files if not file.src_path.startswith("html/")]
    for path in DOCS.parent.glob("*.md"):
        file = File(path.name, str(path.parent), config["site_dir"], False)
        file.name = path.stem # README is not another index
        file.dest_uri = file.url = path.stem + ".html"
        file.abs_dest_path = os.path.join(config["site_dir"], file.dest_uri)
        kept.append(file)
    return type(files)(kept)


def on_page_markdown(markdown, page, config, files):
    def relink(link):
        mark, text, target = link.groups()
        if target is None or re.match("[a-z]+:|#", target):
            return link.group()
        path, hash_sign, anchor = target.partition("#")
        found = page_of((pathlib.Path(page.file.abs_src_path).parent / path).resolve())
        if not found:
            return text
        return f"{mark}[{text}]({os.path.relpath(found, os.path.dirname(page.file.src_uri) or '.')}{hash_sign}{anchor})"

    return CODE_OR_LINK.sub(relink, markdown)


def on_post_build(config):
    """A page that was opened from disk may load scripts, and no JSON. Without the entries of whole pages, whose sections
    hold the same."""
    index = pathlib.Path(config["site_dir"], "search/search_index.json")
    entries = json.loads(index.read_text(encoding="utf-8"))["docs"]
    pages = {entry["location"]: entry["title"] for entry in entries if "#" not in entry["location"]}
    sections = [[entry["location"], pages[entry["location"].partition("#")[0]], entry["title"], entry["text"]]
                for entry in entries if "#" in entry["location"]]
    index.with_suffix(".js").write_text(f"const SECTIONS = {json.dumps(sections)};\n", encoding="utf-8")
    index.unlink()
