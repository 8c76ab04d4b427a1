"""The public names of the Python package as a page, made from its sources: signatures, docstrings, attributes."""
import ast
import re

import prose

# What Python calls of an object, as users write it.
OPERATIONS = {"__len__": "`len()`", "__getitem__": "`x[…]`", "__iter__": "iteration", "__contains__": "`in`",
              "__eq__": "`==`", "__array__": "`numpy.asarray()`", "__bool__": "`bool()`", "__enter__": "`with`",
              "__call__": "calls", "_repr_html_": "a picture in notebooks"}
DOCUMENTED = re.compile(r"#: ?(.*)")
FUNCTION = (ast.FunctionDef, ast.AsyncFunctionDef)


class Module:
    """A module of the package, as it is written."""

    def __init__(self, package, name):
        self.package, self.name = package, name
        text = (package / f"{name}.py").read_text(encoding="utf-8")
        self.lines = text.splitlines()
        self.body = list(statements(ast.parse(text).body))

    def search(self, name):
        """(module, definitions) of a name, several where it is overloaded; None if it is of another package."""
        found = [node for node in self.body if name in names_of(node)]
        if found and isinstance(found[-1], ast.ImportFrom):
            alias = next(alias for alias in found[-1].names if (alias.asname or alias.name) == name)
            return Module(self.package, found[-1].module).search(alias.name)
        return (self, found) if found else None

    def find(self, name):
        found = self.search(name)
        if not found:
            raise LookupError(f"{self.package}/{self.name}.py does not define {name}")
        return found

    def remark(self, node):
        """The comment `#:` behind a line, or in the lines before it."""
        found = DOCUMENTED.search(self.lines[node.end_lineno - 1])
        if found:
            return found[1]
        before, line = [], node.lineno - 2
        while line >= 0 and (comment := re.fullmatch(r"\s*#: ?(.*)", self.lines[line])):
            before.insert(0, comment[1])
            line -= 1
        return " ".join(before)


def statements(body):
    """Those of a module, and those that are for type checkers alone."""
    for node in body:
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            yield from node.body
        else:
            yield node


def names_of(node):
    """The names that a statement binds."""
    if isinstance(node, (*FUNCTION, ast.ClassDef)):
        return [node.name]
    if isinstance(node, ast.ImportFrom) and node.level == 1:
        return [alias.asname or alias.name for alias in node.names]
    targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
    return [target.id for target in targets if isinstance(target, ast.Name)]


def literal(module, name):
    return ast.literal_eval(module.find(name)[1][0].value)


def public_names(package):
    """Name → (module, definitions): what `foam.__all__` lists in its first part, and values with a comment `#:`.

    The other parts of `__all__` are the names of CoMMALab/foam.
    """
    top = Module(package, "__init__")
    homes = literal(top, "_HOMES")
    values = [node for node in top.body if isinstance(node, ast.AnnAssign) and top.remark(node)]
    names = {*literal(top, "__all__"), *(name for node in values for name in names_of(node))}
    return {name: (Module(package, homes[name]) if name in homes else top).find(name) for name in sorted(names)}


def shown(annotation):
    return "" if annotation is None else ast.unparse(annotation).replace("'", "").replace('"', "")


def parameter(argument, default, stars=""):
    kind = shown(argument.annotation)
    text = f"{stars}{argument.arg}{f': {kind}' if kind else ''}"
    return text if default is None else f"{text}{' = ' if kind else '='}{ast.unparse(default)}"


def parameters(arguments, bound):
    """The parameters as they are written; `bound`: without self or cls."""
    plain = [*arguments.posonlyargs, *arguments.args]
    defaults = [None] * (len(plain) - len(arguments.defaults)) + arguments.defaults
    words = [parameter(*pair) for pair in zip(plain, defaults)]
    if arguments.posonlyargs:
        words.insert(len(arguments.posonlyargs), "/")
    if arguments.vararg:
        words.append(parameter(arguments.vararg, None, "*"))
    elif arguments.kwonlyargs:
        words.append("*")
    words += [parameter(*pair) for pair in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    if arguments.kwarg:
        words.append(parameter(arguments.kwarg, None, "**"))
    return words[1:] if bound else words


def signature(name, function, bound=False):
    words = parameters(function.args, bound)
    result = f" -> {shown(function.returns)}" if function.returns and function.name != "__init__" else ""
    line = f"{name}({', '.join(words)}){result}"
    return line if len(line) <= 100 else f"{name}(\n    " + ",\n    ".join(words) + f",\n){result}"


def decorators(node):
    return {ast.unparse(decorator).split(".")[-1] for decorator in node.decorator_list}


def docstring(node):
    text = ast.get_docstring(node)
    if not text:
        raise LookupError(f"{node.name}, in line {node.lineno} of its module, is public and has no docstring")
    return text


def function_text(name, definitions, bound=False):
    """Signatures and docstring; of an overloaded function the signatures of all forms."""
    forms = [node for node in definitions if "overload" in decorators(node)] or definitions[-1:]
    code = "\n".join(signature(name, node, bound) for node in forms)
    return f"```python\n{code}\n```\n\n" + prose.markdown(docstring(definitions[-1]))


def lineage(module, node):
    """A class, and before it those bases whose members are its own, because they are private: (module, class)."""
    for base in node.bases:
        if isinstance(base, ast.Name) and base.id.startswith("_"):
            yield from lineage(*at(module, base.id))
    yield module, node


def at(module, name):
    home, found = module.find(name)
    return home, found[-1]


def attributes(module, node):
    """Name → (type, meaning): what a class declares, its properties, what __init__ sets with a type or a comment."""
    found = {}
    for statement in node.body:
        if isinstance(statement, ast.AnnAssign):
            found[statement.target.id] = shown(statement.annotation), prose.escaped(module.remark(statement))
        elif isinstance(statement, ast.Assign) and isinstance(statement.value, ast.Name):
            for name in names_of(statement):
                found[name] = "", f"another name of `{statement.value.id}`"
        elif isinstance(statement, FUNCTION) and "property" in decorators(statement):
            found[statement.name] = shown(statement.returns), property_doc(statement)
        elif isinstance(statement, FUNCTION) and statement.name == "__init__":
            found |= {name: value for name, value in set_by(module, statement).items() if name not in found}
    return {name: value for name, value in found.items() if not name.startswith("_")}


def property_doc(function):
    return prose.escaped(" ".join((ast.get_docstring(function) or "").split()))


def set_by(module, init):
    found = {}
    for statement in ast.walk(init):
        targets = statement.targets if isinstance(statement, ast.Assign) else [getattr(statement, "target", None)]
        for target in targets:
            if isinstance(target, ast.Attribute) and isinstance(target.value, ast.Name) and target.value.id == "self":
                kind = shown(statement.annotation) if isinstance(statement, ast.AnnAssign) else ""
                remark = prose.escaped(module.remark(statement))
                if kind or remark:
                    found.setdefault(target.attr, (kind, remark))
    return found


def is_for_users(node, init):
    """Whether a class is made by users: then its docstring speaks of what its constructor needs."""
    needed = [argument.arg for argument in init.args.args[1:len(init.args.args) - len(init.args.defaults)]]
    return all(re.search(rf"\b{name}\b", docstring(node)) for name in needed)


def methods(node):
    """Name → definitions, in the order of the class."""
    found = {}
    for statement in node.body:
        if isinstance(statement, FUNCTION) and "property" not in decorators(statement):
            found.setdefault(statement.name, []).append(statement)
    return {name: nodes for name, nodes in found.items() if not any("setter" in decorators(node) for node in nodes)}


def attribute_table(found):
    if not found:
        return ""
    # Renderers differ on | in a cell.
    types = {name: f"`{kind}`".replace(" | ", " or ") if kind else "" for name, (kind, _) in found.items()}
    rows = [f"| `{name}` | {types[name]} | {text} |" for name, (_, text) in found.items()]
    return "| attribute | type | meaning |\n|---|---|---|\n" + "\n".join(rows) + "\n\n"


def class_text(name, module, node):
    """Docstring, constructor, attributes, operations and methods."""
    found, functions = {}, {}
    for home, base in lineage(module, node):
        found |= attributes(home, base)
        functions |= methods(base)
    text = ""
    init = functions.get("__init__")
    if init and is_for_users(node, init[-1]):
        text += f"```python\n{signature(f'foam.{name}', init[-1], bound=True)}\n```\n\n"
    text += prose.markdown(docstring(node)) + "\n" + attribute_table(found)
    operations = [words for special, words in OPERATIONS.items() if special in functions]
    if operations:
        text += f"Also: {', '.join(operations)}.\n\n"
    for method, nodes in functions.items():
        if not method.startswith("_"):
            bound = "staticmethod" not in decorators(nodes[-1])
            text += f"#### {name}.{method}()\n\n" + function_text(method, nodes, bound) + "\n"
    return text


def bases_of(node, names):
    bases = [shown(base) for base in node.bases]
    public = [f"`foam.{base}`" if base in names else f"`{base}`" for base in bases if not base.startswith("_")]
    return f"A kind of {' and '.join(public)}.\n\n" if public else ""


def section(name, module, definitions, names):
    """(part of the page, heading, first sentence, text) of a name."""
    node = definitions[-1]
    if isinstance(node, ast.ClassDef):
        errors = module.name == "errors"
        text = bases_of(node, names) + class_text(name, module, node)
        return "Errors" if errors else "Classes", f"class foam.{name}", docstring(node), text
    if isinstance(node, FUNCTION):
        return "Functions", f"foam.{name}()", docstring(node), function_text(f"foam.{name}", definitions)
    remark = module.remark(node)
    kind = f"```python\nfoam.{name}: {shown(node.annotation)}\n```\n\n" if isinstance(node, ast.AnnAssign) else ""
    return "Values", f"foam.{name}", remark, kind + prose.escaped(remark) + "\n"


def annotations(node):
    for part in ast.walk(node):
        for annotation in (getattr(part, "annotation", None), getattr(part, "returns", None)):
            if isinstance(annotation, ast.Constant) and isinstance(annotation.value, str):
                yield ast.parse(annotation.value, mode="eval")
            elif isinstance(annotation, ast.AST):
                yield annotation


def types_in(module, definitions):
    """The names of the package in annotations, and in what a name stands for: name → (module, definitions)."""
    parts = [part for node in definitions for part in (*annotations(node), getattr(node, "value", None)) if part]
    names = {part.id for tree in parts for part in ast.walk(tree) if isinstance(part, ast.Name)}
    found = {name: module.search(name) for name in sorted(names) if not name.startswith("_")}
    return {name: definitions for name, definitions in found.items() if definitions}


def type_section(name, module, definitions):
    """The section of a type that arguments or results have, and that is no name of foam itself."""
    node = definitions[-1]
    if isinstance(node, ast.ClassDef):
        return "Types", name, docstring(node), bases_of(node, {}) + class_text(name, module, node)
    remark = module.remark(node)
    code = f"{name} = {ast.unparse(node.value)}"
    return "Types", name, remark or f"`{code}`", f"```python\n{code}\n```\n\n{prose.escaped(remark)}\n"


def type_sections(sections, public):
    """Sections of the types that the sections name, and of those that these name."""
    found, queue = {}, list(zip(sections, public.values()))
    while queue:
        (*_, text), definitions = queue.pop(0)
        for name, (module, nodes) in types_in(*definitions).items():
            known = name in public or name in found or "TypeVar(" in ast.unparse(nodes[-1])
            if not known and re.search(rf"\b{name}\b", text):
                found[name] = type_section(name, module, nodes)
                queue.append((found[name], (module, nodes)))
    return [found[name] for name in sorted(found)]


def anchor(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def page_of(package, made):
    """The page of a package's folder."""
    names = public_names(package)
    sections = [section(name, *found, names) for name, found in names.items()]
    sections += type_sections(sections, names)
    page = (f"# Python package\n\n{made}\n[foam in Python](../guide/python.md) shows how to use these names, and "
            "[coming from the Python foam](../guide/coming_from_python_foam.md) those of CoMMALab/foam.\n")
    body = ""
    for part in ("Functions", "Classes", "Errors", "Values", "Types"):
        own = [entry for entry in sections if entry[0] == part]
        if not own:
            continue
        page += f"\n| {part.lower()} | |\n|---|---|\n"
        page += "".join(f"| [`{heading}`](#{anchor(heading)}) | {prose.first_sentence(doc)} |\n"
                        for _, heading, doc, _ in own)
        body += f"\n## {part}\n" + "".join(f"\n### {heading}\n\n{text.rstrip()}\n" for _, heading, _, text in own)
    return page + body
