"""The tests of the pages find what is wrong with a page: each kind of mistake, on a tiny repository."""
import ast
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

import c_reference
import check_links
import html_test
import markdown
import prose
import python_reference
import recipe_reference
import reference
import run_page

FOAM = """#!/bin/sh
# Stands for the program: `foam say WORDS`, `foam fail CODE`, `foam check FILE`.
case $1 in
    say) shift; echo "$@" ;;
    fail) exit "$2" ;;
    check) ! grep -n wrong "$2" >&2 ;;
esac
"""


class Tiny(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.repository = pathlib.Path(folder.name).resolve()
        for name in ["configs", "docs", "tests/docs/room"]:
            (self.repository / name).mkdir(parents=True)
        self.foam = self.repository / "built"
        self.foam.write_text(FOAM)
        self.foam.chmod(0o755)

    def page(self, text, name="docs/page.md"):
        path = self.repository / name
        path.write_text(text)
        return path

    def told(self, call):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            code = call()
        return code, out.getvalue()

    def run_page(self, text):
        return self.told(lambda: run_page.run(str(self.foam), self.repository, self.page(text)))


class Commands(Tiny):
    def test_as_written(self):
        code, out = self.run_page("```sh\n./foam say a\nfoam fail 2   # exits 2\n```\n")
        self.assertEqual((code, out), (0, "docs/page.md: as written\n"))

    def test_a_failure_is_named_with_its_line_and_output(self):
        code, out = self.run_page("# Title\n\n```sh\n./foam say before\n./foam fail 3\n./foam say after\n```\n")
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:5: exit code 3, expected 0: ./foam fail 3\n", out)
        self.assertIn("before", out)
        self.assertNotIn("after", out)

    def test_an_expected_failure_must_come(self):
        self.assertIn("exit code 0, expected 2", self.run_page("```sh\n./foam say a   # exits 2\n```\n")[1])

    def test_one_shell_for_the_page(self):
        text = "```sh\nmkdir a; cd a\nword=7\n```\n\n```sh\n[ $word = 7 ] && cd ../a\n```\n"
        self.assertEqual(self.run_page(text)[0], 0)

    def test_commands_of_several_lines(self):
        text = ("```sh\ncat >file <<'X'\nfoam fail 1\nX\n./foam \\\n    say b\n"
                "for i in 1 2; do\n    ./foam say $i\ndone\n```\n")
        self.assertEqual(self.run_page(text)[0], 0)
        self.assertEqual(self.run_page("```sh\nif true; then\n```\n")[0], 1)

    def test_not_run(self):
        self.assertEqual(self.run_page("<!-- not run: takes hours -->\n```sh\n./foam fail 1\n```\n")[0], 0)
        self.assertEqual(self.run_page("<!-- other -->\n```sh\n./foam fail 1\n```\n")[0], 1)


class Python(Tiny):
    def test_runs_where_its_modules_are(self):
        text = "```sh\n./foam say 7 >file\n```\n\n```python\nimport json\nprint('read', json.load(open('file')){})\n```\n"
        shown = "\n<!-- output -->\n```text\nread 7\n```\n"
        self.assertEqual(self.run_page(text.format("") + shown), (0, "docs/page.md: as written\n"))
        code, out = self.run_page(text.format(" / 0"))
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:6: exit code 1, expected 0: this python\n", out)
        self.assertIn("ZeroDivisionError", out)

    def test_says_what_is_not_run(self):
        code, out = self.run_page("```python\nfrom no_such.module import a\nimport json\na / 0\n```\n")
        self.assertEqual((code, out), (0, "docs/page.md:2: not run: no module no_such\ndocs/page.md: as written\n"))

    def test_a_mistake_of_syntax_is_found_without_the_modules(self):
        code, out = self.run_page("```python\nimport no_such\nno_such.call(\n```\n")
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:2: no Python: '(' was never closed", out)

    def test_not_run(self):
        self.assertEqual(self.run_page("<!-- not run: shows a mistake -->\n```python\n1 / 0\n```\n")[0], 0)


class Contents(Tiny):
    def test_output(self):
        text = "```sh\n./foam say one; ./foam say two 3.5 s\n```\n\n<!-- output -->\n```text\n{}\n```\n"
        self.assertEqual(self.run_page(text.format("one\ntwo … s"))[0], 0)
        code, out = self.run_page(text.format("two … s\none"))
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:7: the commands do not print this line: one", out)

    def test_output_with_other_numbers(self):
        text = "```sh\n./foam say total  22 0.31 yes\n```\n\n<!-- output, other numbers -->\n```text\n{}\n```\n"
        self.assertEqual(self.run_page(text.format("total     7  12.5     yes"))[0], 0)
        self.assertEqual(self.run_page(text.format("total     7  12.5     no"))[0], 1)

    def test_recipes(self):
        self.assertEqual(self.run_page("```yaml\nfoam: 1\nname: right\n```\n")[0], 0)
        self.assertEqual(self.run_page("```yaml\nname: wrong\n```\n")[0], 0)
        code, out = self.run_page("```yaml\n# a comment\nfoam: 1\nname: wrong\n```\n")
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:2: this recipe is wrong:\n3:name: wrong", out)
        self.assertEqual(self.run_page("<!-- not checked: shows a mistake -->\n```yaml\nfoam: 1\nwrong\n```\n")[0], 0)

    def test_languages(self):
        code, out = self.run_page("```bash\n./foam fail 1\n```\n")
        self.assertEqual(code, 1)
        self.assertEqual(out, "docs/page.md:2: a block of 'bash'; known are c, cmake, cpp, json, python, sh, text, yaml\n")

    def test_files(self):
        text = "```yaml\n# mine.yaml\nfoam: 1\n```\n\n```sh\ngrep -c foam mine.yaml\n```\n"
        self.assertEqual(self.run_page(text)[0], 0)

    def test_quotes(self):
        (self.repository / "file.hpp").write_text("int a;\nint b;\n")
        self.assertEqual(self.run_page("<!-- from: file.hpp -->\n```cpp\nint b;\n```\n")[0], 0)
        other = self.run_page("<!-- from: file.hpp -->\n```cpp\nint c;\n```\n")
        self.assertIn("this is not what file.hpp holds", other[1])
        whole = self.run_page("<!-- all of: file.hpp -->\n```cpp\nint a;\nint b;\n```\n")
        self.assertEqual(whole[0], 0)
        part = self.run_page("<!-- all of: file.hpp -->\n```cpp\nint b;\n```\n")
        self.assertIn("this is not all of file.hpp", part[1])


class Links(Tiny):
    def check(self):
        arguments, sys.argv = sys.argv, ["check_links.py", str(self.repository)]
        try:
            return self.told(check_links.main)
        finally:
            sys.argv = arguments

    def test_good(self):
        self.page("# A heading: `x`\n\n[page](page.md#two-words) [up](../README.md) [here](#a-heading-x)\n",
                  "docs/index.md")
        self.page("## Two words\n\n```text\n[no](link)\n```\n`[no](link)` [out](https://example.org)\n")
        self.page("[index](docs/index.md)\n", "README.md")
        self.assertEqual(self.check(), (0, "5 links on 3 pages lead somewhere\n"))

    def test_bad(self):
        self.page("[a](none.md) [b](page.md#none) ![c](https://example.org/c.png) [d](../../d)\n", "docs/index.md")
        self.page("")
        self.page("", "docs/lost.md")
        self.assertEqual(self.check(), (1, "docs/index.md:1: ../../d is outside of the repository\n"
                                        "docs/index.md:1: none.md does not exist\n"
                                        "docs/index.md:1: page.md has no heading #none\n"
                                        "docs/index.md:1: the image https://example.org/c.png comes from the network\n"
                                        "docs/lost.md: no links lead here from docs/index.md\n"))

    def test_pages_of_the_site(self):
        (self.repository / "a.html").write_text(
            "<script src='https://example.org/a.js'></script><p id='here'>1. first\n</p><pre>- code</pre>"
            "<a href='#here'>x</a><a href='#there'>x</a><a href='b.html'>x</a><a href='https://example.org'>x</a>")
        (self.repository / "a.css").write_text("@import 'https://example.org/a.css'; a { background: url(a.png); }")
        self.assertEqual(list(html_test.findings_of(self.repository)), [
            "a.html: 1. first is shown as it was written",
            "a.html: https://example.org/a.js comes from the network",
            "a.html: #there: no such place",
            "a.html: b.html does not exist",
            "a.css: https://example.org/a.css comes from the network"])

    def test_open_block(self):
        with self.assertRaisesRegex(ValueError, "page.md:2: this block is not closed"):
            markdown.read(self.page("```sh\n"))


class Generated(unittest.TestCase):
    def test_a_parameter(self):
        text = reference.row({"name": "step", "type": "number", "unit": "m", "low": 1e-06, "high": 2.0, "default": 0.5,
                              "doc": "A | b", "source": "Someone 2001", "affects_output": False})
        self.assertEqual(text, "| `step` | number, 1e-06 … 2 | m | `0.5` | A \\| b. *Default from:* Someone 2001. "
                               "Does not change the result. |\n")
        text = reference.row({"name": "mode", "type": "choice", "unit": "1", "choices": ["a", "b"], "default": "a",
                              "doc": "Which.", "affects_output": True})
        self.assertEqual(text, "| `mode` | `a`, `b` |  | `a` | Which. |\n")

    def test_the_keys_of_recipes(self):
        skip = {"type": "boolean", "description": "Skip.", "default": False}
        link = {"properties": {"skip": skip, "a.stage": {"description": "No."}}}
        x = {"enum": [1], "description": "X."}
        count = {"type": "integer", "minimum": 0, "maximum": 1 << 63, "description": "Seed.", "default": 0}
        schema = {"properties": {"seed": {"$ref": "#/$defs/count"},
                                 "links": {"type": "object", "additionalProperties": link},
                                 "size": {"anyOf": [{"type": "string"}, {"properties": {"x": x}}]}},
                  "$defs": {"count": count}}
        self.assertEqual(list(recipe_reference.rows("", schema, schema)), [
            "| `seed` | integer ≥ 0 | `0` | Seed. |\n",
            "| `links.NAME.skip` | boolean | `false` | Skip. |\n",
            "| `size.x` | `1` |  | X. |\n"])

    def test_prose(self):
        text = "One < two * `a*b`.\n\nArgs:\n    x, y: metres;\n        any frame.\n    z: no.\n\nIts code:\n    f(x)\n\nname    what\n"
        self.assertEqual(prose.markdown(text), "One &lt; two \\* `a*b`.\n\n*Arguments*\n\n- `x`, `y`: metres; any frame.\n"
                                               "- `z`: no.\n\nIts code:\n\n    f(x)\n\n- `name`: what\n")
        self.assertEqual(prose.first_sentence("A | b, e.g. c. D.\n\nE."), "A \\| b, e.g. c.")

    def test_a_header(self):
        header = ("/* In C. */\n#ifndef FOAM_H\n#define FOAM_H\n#include <a.h>\n\n/* Kinds. */\nenum {\n    FOAM_A = 1 /* a */\n};\n\n"
                  "/* Counts.\n *\n * most   the limit\n */\nFOAM_API int foam_count(int most);\n\n#ifdef __cplusplus\n}\n#endif\n#endif\n")
        self.assertEqual(c_reference.page_of(header, "made\n"),
                         "# C header\n\nmade\n\n[foam in C](../guide/c_interface.md) shows how to use `foam.h`.\n\nIn C.\n"
                         "\n## FOAM_A, …\n\n```c\nenum {\n    FOAM_A = 1 /* a */\n};\n```\n\nKinds.\n"
                         "\n## foam_count()\n\n```c\nFOAM_API int foam_count(int most);\n```\n\nCounts.\n\n- `most`: the limit\n")


PACKAGE = {"__init__": """
from .errors import Error
_HOMES = {"Made": "_made", "make": "_make"}
#: All words.
WORDS: tuple[str, ...] = ("a",)
_OLD = ["old"]
__all__ = ["Error", "Made", "WORDS", "make"]
__all__ += _OLD
""", "errors": """
class Error(ValueError):
    \"\"\"Why not.\"\"\"
""", "_make": """
from ._made import built as make
""", "_types": """
from elsewhere import Foreign
#: How long.
Effort = Literal["fast", "best"]
Function = TypeVar("Function")
""", "_made": """
if TYPE_CHECKING:
    from ._types import Effort, Foreign, Function
class _Base:
    @property
    def size(self) -> float | None:
        \"\"\"Metres.\"\"\"

class Made(_Base):
    \"\"\"What was made of `count` things.\"\"\"
    kind: str  #: its kind
    _hidden: int
    def __init__(self, count: int, *, name: "str" = "x"):
        self.name = name  #: of it
        self.count: int = count
        self.other = 1
    def __len__(self): ...
    def to(self, *formats: str, **settings: int) -> list[str]:
        \"\"\"Write.\"\"\"

class Result(Made):
    \"\"\"What is returned.\"\"\"
    def __init__(self, values): ...

@overload
def built(a: int) -> Made: ...
@overload
def built(a: Effort, /, b: Foreign | Function = (1, 2)) -> Made: ...
def built(a, b=None):
    \"\"\"Make.\"\"\"
"""}


class PythonReference(Tiny):
    def page(self):
        for name, text in PACKAGE.items():
            (self.repository / f"{name}.py").write_text(text)
        return python_reference.page_of(self.repository, "made\n")

    def test_the_whole_of_a_package(self):
        page = self.page()
        for part in ("| [`foam.make()`](#foammake) | Make. |\n", "| [`class foam.Made`](#class-foammade) | What was made of",
                     "### foam.make()\n\n```python\nfoam.make(a: int) -> Made\nfoam.make(a: Effort, /, b: Foreign | Function = (1, 2)) -> Made\n```\n\nMake.\n",
                     "```python\nfoam.Made(count: int, *, name: str = 'x')\n```\n\nWhat was made of `count` things.\n",
                     "| `size` | `float or None` | Metres. |\n| `kind` | `str` | its kind |\n| `name` |  | of it |\n"
                     "| `count` | `int` |  |\n\nAlso: `len()`.\n",
                     "#### Made.to()\n\n```python\nto(*formats: str, **settings: int) -> list[str]\n```\n\nWrite.\n",
                     "### class foam.Error\n\nA kind of `ValueError`.\n\nWhy not.\n",
                     "```python\nfoam.WORDS: tuple[str, ...]\n```\n\nAll words.\n",
                     "## Types\n\n### Effort\n\n```python\nEffort = Literal['fast', 'best']\n```\n\nHow long.\n"):
            self.assertIn(part, page)
        for absent in ("_hidden", "other", "old", "Result", "### Foreign", "### Function"):
            self.assertNotIn(absent, page)

    def test_a_constructor_that_is_not_explained_is_not_for_users(self):
        self.page()
        module = python_reference.Module(self.repository, "_made")
        node = module.find("Result")[1][0]
        self.assertNotIn("foam.Result(", python_reference.class_text("Result", module, node))

    def test_a_name_that_no_module_defines(self):
        (self.repository / "_made.py").write_text("")
        with self.assertRaisesRegex(LookupError, "_made.py does not define thing"):
            python_reference.Module(self.repository, "_made").find("thing")

    def test_a_public_name_needs_a_docstring(self):
        with self.assertRaisesRegex(LookupError, "^f, in line 1 of its module, is public and has no docstring$"):
            python_reference.function_text("f", ast.parse("def f(): ...").body)


unittest.main()
