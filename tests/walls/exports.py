"""What the libraries export: what their headers declare, and nothing else.

exports.py LIBRARY HEADERS   0: every exported symbol is declared in a header of the folder HEADERS; 1: not; 77: no nm
"""
import pathlib
import re
import shutil
import subprocess
import sys

SKIPPED = 77


def exported(library):
    """The functions and variables of the library, demangled; not those of templates and inline functions."""
    lines = subprocess.run(["nm", "-D", "-C", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    return [match.group(2) for match in map(re.compile(r"^\w+ ([A-Za-z]) (.*)$").match, lines.splitlines())
            if match and match.group(1) in "TDBR" and not match.group(2).startswith("__odr_asan.")]  # of the sanitizer


def identifiers(symbol):
    """The names of a symbol, without its namespace and parameters: "Solid", "distance"."""
    symbol = re.sub(r"\[abi:\w+\]", "", symbol)
    symbol = re.sub(r"^(vtable|typeinfo|typeinfo name|VTT|guard variable|non-virtual thunk|virtual thunk) (for|to) ", "", symbol)
    name = re.sub(r"<.*", "", symbol.split("(")[0].replace("operator()", "operator"))
    return [re.sub(r"\W.*", "", part.lstrip("~")) for part in name.split("::") if part][2:]


def main():
    if not shutil.which("nm"):
        print("skipped: there is no nm (package binutils)")
        return SKIPPED
    library, folder = sys.argv[1:]
    text = "\n".join(path.read_text() for path in pathlib.Path(folder).rglob("*.h*"))
    declared = set(re.findall(r"\w+", text))
    symbols = exported(library)
    odd = [symbol for symbol in symbols
           if not (symbol in declared and symbol.startswith("foam_")) # C
           and not symbol.startswith(("foam::", "vtable for foam::", "typeinfo", "non-virtual thunk", "virtual thunk", "VTT for"))
           or any(name not in declared for name in identifiers(symbol))]
    for symbol in odd:
        print(f"{library} exports {symbol}, which no header declares; remedy: an unnamed namespace, or a private header")
    if not symbols:
        print(f"{library} exports nothing")
    return 1 if odd or not symbols else 0


if __name__ == "__main__":
    sys.exit(main())
