"""The layout of every public type, against the committed record of the ABI epoch.

abi_layout.py check COMPILER CORE   0: as recorded, 1: not, 77: skipped (no readelf or x86-64)
abi_layout.py test  COMPILER CORE   whether `check` would notice: changes a copy of the headers

All public headers of the libraries that plugins may use are compiled into one object file with debug information, and
sizes, offsets, enumerators and virtual functions are read from that: no list that somebody could forget to extend.
"""
import difflib
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
TYPES = {"structure_type": "struct", "class_type": "struct", "union_type": "union", "enumeration_type": "enum"}


class Headers:
    """The headers that plugins may include: "geometry/mesh.hpp"."""

    LIBRARIES = ["base", "geometry", "xml", "robot", "search", "sdk", "yaml"]

    def __init__(self, core):
        self.core = pathlib.Path(core)
        self.folders = [self.core / library / "include" for library in self.LIBRARIES]
        self.names = [f"{library}/{path.name}" for library, folder in zip(self.LIBRARIES, self.folders)
                      for path in sorted((folder / "foam" / library).glob("*.hpp"))]

    def file(self, name):
        return self.core / name.split("/")[0] / "include" / "foam" / name


def debug_information(compiler, headers):
    """What readelf says of an object file that includes all headers."""
    with tempfile.TemporaryDirectory() as folder:
        source, binary = pathlib.Path(folder, "types.cpp"), pathlib.Path(folder, "types.o")
        source.write_text("".join(f"#include <foam/{name}>\n" for name in headers.names))
        record = pathlib.Path(folder, "foam", "sdk", "abi_record.hpp")  # made with the build; it has no types
        record.parent.mkdir(parents=True)
        record.write_text('#define FOAM_ABI_LAYOUT ""\n')
        subprocess.run([compiler, "-std=c++20", "-O0", "-g", "-fno-eliminate-unused-debug-types",
                        "-femit-class-debug-always", *(f"-I{include}" for include in headers.folders), f"-I{folder}", "-c", str(source), "-o", str(binary)], check=True)
        return subprocess.run(["readelf", "-W", "--debug-dump=info", str(binary)], check=True, capture_output=True,
                              text=True, env={**os.environ, "LC_ALL": "C"}).stdout


class Entry:
    """One debugging information entry: a type, a member, a function, …"""

    def __init__(self, tag, parent):
        self.tag, self.parent, self.attributes, self.children = tag, parent, {}, []

    def get(self, name, default=""):
        return self.attributes.get(name, default)

    def number(self, name):
        match = re.match(r"-?\w+", self.get(name, "0"))
        return int(match.group(), 0)


def parse(text):
    """All entries by their offset."""
    entries, stack = {}, []
    for line in text.splitlines():
        head = re.match(r" <(\w+)><(\w+)>: Abbrev Number: \d+(?: \(DW_TAG_(\w+)\))?", line)
        if head and head.group(3):
            depth = int(head.group(1), 16)
            del stack[depth:]
            entry = Entry(head.group(3), stack[-1] if stack else None)
            if stack:
                stack[-1].children.append(entry)
            stack.append(entry)
            entries[int(head.group(2), 16)] = entry
            continue
        attribute = re.match(r" +<\w+> +DW_AT_(\w+) *: (.*)", line)
        if attribute and stack:
            # "(strp) (offset: 0x5ecf8): foam", "(indirect string, offset: 0x5ecf8): foam", "(string) x", "x"
            value = re.sub(r"^\((?:strp|line_strp|string|data\d+|[us]data|ref\w+|flag\w*|implicit_const|exprloc"
                           r"|sec_offset|addr\w*)\) ", "", attribute.group(2))
            value = re.sub(r"^\((?:offset|indirect[^)]*|alt indirect[^)]*)[^)]*\): ", "", value)
            stack[-1].attributes[attribute.group(1)] = value.strip()
    return entries


def tidy(name):
    """A type's name without what differs between compilers and says nothing."""
    name = name.replace("__cxx11::", "")
    name = re.sub(r"std::basic_string<char, std::char_traits<char>, std::allocator<char> ?>", "std::string", name)
    while True:
        shorter = re.sub(r", std::(allocator|less|default_delete)<[^<>]*(<[^<>]*(<[^<>]*>)?[^<>]*>)?[^<>]*>", "", name)
        if shorter == name:
            break
        name = shorter
    name = re.sub(r", (18446744073709551615(ul)?|std::dynamic_extent)>", ">", name)
    return re.sub(r"\b(\d+)ul?\b", r"\1", name).replace(" >", ">")


class Layout:
    def __init__(self, text):
        self.entries = parse(text)

    def target(self, entry):
        match = re.match(r"<0x(\w+)>", entry.get("type"))
        return self.entries.get(int(match.group(1), 16)) if match else None

    def qualified(self, entry):
        names = []
        while entry is not None and entry.tag != "compile_unit":
            names.append(entry.get("name"))
            entry = entry.parent
        return "::".join(name for name in reversed(names) if name)

    def type_name(self, entry):
        """Of the type that an entry refers to, as it would be written."""
        target = self.target(entry)
        if target is None:
            return "void"
        wrapped = {"pointer_type": "{}*", "reference_type": "{}&", "rvalue_reference_type": "{}&&",
                   "const_type": "const {}", "array_type": "{}[]"}
        if target.tag in wrapped:
            return wrapped[target.tag].format(self.type_name(target))
        if target.tag == "subroutine_type":
            return f"{self.type_name(target)} (function)"
        return tidy(self.qualified(target))

    def public(self):
        """The named types of the namespace foam and of the C envelope."""
        found = {}
        for entry in self.entries.values():
            ours = entry.get("name").startswith("foam_") if entry.parent and entry.parent.tag == "compile_unit" else \
                self.qualified(entry).startswith("foam::") and self.is_reachable(entry)
            whole = entry.get("name") and "declaration" not in entry.attributes
            if entry.tag in (*TYPES, "typedef") and ours and whole:
                found[tidy(self.qualified(entry))] = entry
        return found

    @staticmethod
    def is_reachable(entry):
        """Not local to a function."""
        while entry is not None:
            if entry.tag in ("subprogram", "lexical_block"):
                return False
            entry = entry.parent
        return True

    def lines(self, name, entry):
        if entry.tag == "typedef":
            return [f"using {name} = {self.type_name(entry)}"]
        lines = [f"{TYPES[entry.tag]} {name}, {entry.number('byte_size')} bytes" +
                 (f", aligned to {entry.number('alignment')}" if entry.get("alignment") else "")]
        virtual = []
        for child in entry.children:
            if child.tag == "enumerator":
                lines.append(f"    {child.get('name')} = {child.number('const_value')}")
            elif child.tag == "inheritance":
                lines.append(f"    {child.number('data_member_location'):4} base {self.type_name(child)}")
            elif child.tag == "member" and "external" not in child.attributes and child.get("name"):
                if child.get("data_member_location") or entry.tag == "union_type":
                    lines.append(f"    {child.number('data_member_location'):4} {child.get('name')}: "
                                 f"{self.type_name(child)}")
            elif child.tag == "subprogram" and child.get("vtable_elem_location"):
                virtual.append(self.virtual(child))
        return lines + [f"    virtual {slot}: {function}" for slot, function in sorted(virtual)]

    def virtual(self, function):
        slot = int(re.search(r"DW_OP_constu: (\d+)", function.get("vtable_elem_location")).group(1))
        parameters = [child for child in function.children if child.tag == "formal_parameter"]
        this = self.type_name(parameters[0]) if parameters else ""
        given = ", ".join(self.type_name(p) for p in parameters if "artificial" not in p.attributes)
        result = "" if function.get("name").startswith("~") else f"{self.type_name(function)} "
        return slot, f"{result}{function.get('name')}({given}){' const' if this.startswith('const ') else ''}"

    def text(self, headers):
        types = self.public()
        parts = ["headers: " + " ".join(name.removesuffix(".hpp") for name in headers.names)]
        parts += ["\n".join(self.lines(name, types[name])) for name in sorted(types)]
        return "\n\n".join(parts) + "\n"


def epochs(headers):
    """The current epoch, and the epochs that abi.hpp gives a reason for."""
    text = headers.file("sdk/abi.hpp").read_text()
    current = int(re.search(r"#define FOAM_ABI_EPOCH (\d+)", text).group(1))
    reasons = re.findall(r"^/// +(\d+)  (\S.*)$", text, re.M)
    return current, [int(number) for number, reason in reasons if len(reason.split()) >= 2]


def differences(old, new):
    """Type by type: its name, what it loses (-) and what it gains (+)."""
    def blocks(text):
        return {re.split(r"[,:] ", block, maxsplit=1)[0]: block.splitlines() for block in text.strip().split("\n\n")}

    before, after, lines = blocks(old), blocks(new), []
    for name in sorted(before.keys() | after.keys()):
        one, other = before.get(name, []), after.get(name, [])
        if one != other:
            lines.append(name)
            lines += [line for line in difflib.ndiff(one, other) if line[0] in "+-"]
    return lines


def head(epoch, state):
    return (f"ABI epoch {epoch}, {state}: the public types of the libraries for plugins, x86-64, g++.\n"
            "Written by tests/abi/abi_layout.py; docs/dev/abi.md says when and how it may change.\n\n")


def check(compiler, headers):
    """What is wrong; empty if nothing."""
    epoch, reasons = epochs(headers)
    for number in range(1, epoch + 1):
        if number not in reasons:
            return (f"abi.hpp gives no reason for ABI epoch {number}\nremedy: add a line '///  {number}  what changed "
                    "and why' to the reasons above FOAM_ABI_EPOCH")
    record = headers.core / "abi" / f"epoch_{epoch}.txt"
    found = Layout(debug_information(compiler, headers)).text(headers)
    if not record.exists():
        if os.environ.get("FOAM_TEST_UPDATE"):
            record.write_text(head(epoch, "open") + found)
            return ""
        return f"{record.name}: there is no record of ABI epoch {epoch}\nremedy: run this test with FOAM_TEST_UPDATE=1"
    text = record.read_text()
    state = "released" if text.startswith(head(epoch, "released")) else "open"
    kept = text.removeprefix(head(epoch, state))
    if kept == found:
        return ""
    if os.environ.get("FOAM_TEST_UPDATE") and state == "open":
        record.write_text(head(epoch, "open") + found)
        return ""
    message = f"the public types are not those of {record.name}; plugins built before would misread them:\n" + \
        "\n".join(differences(kept, found))
    if state == "released":
        return message + (f"\nremedy: undo it, or raise FOAM_ABI_EPOCH to {epoch + 1} in abi.hpp, add a line "
                          f"'///  {epoch + 1}  what changed and why', and run this test with FOAM_TEST_UPDATE=1")
    return message + (f"\nremedy: epoch {epoch} is not released yet: run this test with FOAM_TEST_UPDATE=1 and commit "
                      f"{record.name}")


# What the record must notice: file, text, replacement, and what the message says then.
CHANGES = [
    ("geometry/elements.hpp", "double radius = 0;", "float weight = 0;\n    double radius = 0;", "+       24 weight: float"),
    ("geometry/sphere.hpp", "    outer,  ///<", "    none,\n    outer,  ///<", "+     outer = 1"),
    ("sdk/context.hpp", "    virtual bool cancelled() const = 0;\n", "", "-     virtual 3: bool cancelled() const"),
    ("base/text.hpp", "namespace foam {\n", "namespace foam {\nstruct Novelty {\n    int x;\n};",
     "+ struct foam::Novelty, 4 bytes"),
    ("search/cover.hpp", "std::uint64_t seed = 0;", "std::uint32_t seed = 0;", "+       32 seed: uint32_t"),
]


def test(compiler, core):
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder, "core")
        shutil.copytree(core, copy)
        headers = Headers(copy)
        for name, old, new, _ in CHANGES:
            file = headers.file(name)
            text = file.read_text()
            if old not in text:
                failures.append(f"{name} no longer holds '{old}': choose another change")
            file.write_text(text.replace(old, new, 1))
        # QuietContext overrides what is no longer there.
        context = headers.file("sdk/context.hpp")
        context.write_text(context.read_text().replace("bool cancelled() const override;", "bool cancelled() const;"))
        headers.file("sdk/unknown.hpp").write_text("#pragma once\n")
        os.environ.pop("FOAM_TEST_UPDATE", None)
        message = check(compiler, Headers(copy))
        for *_, wanted in CHANGES + [("unknown",)]:
            if wanted not in message:
                failures.append(f"the message does not say '{wanted}'")
        if "remedy: epoch" not in message:
            failures.append("an open epoch may be written anew, but the message does not say so")
        epoch, _ = epochs(headers)
        record = copy / "abi" / f"epoch_{epoch}.txt"
        record.write_text(record.read_text().replace(", open:", ", released:", 1))
        os.environ["FOAM_TEST_UPDATE"] = "1"
        if f"raise FOAM_ABI_EPOCH to {epoch + 1}" not in check(compiler, Headers(copy)):
            failures.append("a released epoch was written anew")
        abi = headers.file("sdk/abi.hpp")
        line = "#define FOAM_ABI_EPOCH {}"
        abi.write_text(abi.read_text().replace(line.format(epoch), line.format(epoch + 1)))
        if f"abi.hpp gives no reason for ABI epoch {epoch + 1}" not in check(compiler, Headers(copy)):
            failures.append("an epoch without a reason was accepted")
        if failures:
            failures.append(message)
    return "\n".join(failures)


def main():
    what, compiler, core = sys.argv[1:]
    if platform.machine() != "x86_64" or not shutil.which("readelf"):
        print("skipped: the record is of x86-64, and is compared by readelf (package binutils)")
        return SKIPPED
    problem = test(compiler, core) if what == "test" else \
        check(compiler, Headers(core))
    print(problem or "as recorded")
    return 1 if problem else 0


if __name__ == "__main__":
    sys.exit(main())
