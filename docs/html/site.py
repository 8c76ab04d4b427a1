"""What mkdocs has to know of these pages: docs/index.md is the navigation, and files outside of docs/ have no page."""
import pathlib
import re

LINK = re.compile(r"(?<!!)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")


def navigation_of(index):
    """Home, then a list of pages for each heading of the index."""
    navigation = [{"foam": "index.md"}]
    for section in re.split(r"^## +", index, flags=re.MULTILINE)[1:]:
        title = section.splitlines()[0]
        pages = [{text: target} for text, target in LINK.findall(section) if not target.startswith("..")]
        navigation.append({title: pages})
    return navigation


def on_config(config):
    config["nav"] = navigation_of(pathlib.Path(config["docs_dir"], "index.md").read_text(encoding="utf-8"))
    return config


def on_files(files, config):
    return type(files)([file for file in files if not file.src_path.startswith("html/")])


def on_page_markdown(markdown, page, config, files):
    """A link to a file of the repository that is no page becomes its text."""
    docs = pathlib.Path(config["docs_dir"]).resolve()
    folder = pathlib.Path(page.file.abs_src_path).parent

    def keep_inside(link):
        text, target = link.groups()
        inside = re.match("[a-z]+:|#", target) or (folder / target.partition("#")[0]).resolve().is_relative_to(docs)
        return link.group() if inside else text

    return LINK.sub(keep_inside, markdown)
