"""Small changes of C++ source that tests should notice, each found from the tokens of a file that clang-format laid out."""
import re
from dataclasses import dataclass

TOKEN = re.compile(r"""
    (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#[^\n]*)
  | (?P<string>"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])*')
  | (?P<number>\.?[0-9](?:[eEpP][+-]|['\w.])*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<operator><=>|<<=|>>=|->|\+\+|--|<<|&&|\|\||[<>=!+\-*/%&|^]=|::|[^\s\w])
""", re.VERBOSE | re.DOTALL | re.MULTILINE)

COMPARISONS = {"<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"), "==": ("!=",), "!=": ("==",)}
ARITHMETIC = {"+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
NAMES = {"min": ("max",), "max": ("min",), "min_element": ("max_element",), "max_element": ("min_element",),
         "any_of": ("all_of",), "all_of": ("any_of",), "none_of": ("any_of",), "ceil": ("floor",), "floor": ("ceil",),
         "round": ("floor", "ceil"), "true": ("false",), "false": ("true",), "sqrt": ("",), "abs": ("",),
         "sin": ("std::cos",), "cos": ("std::sin",), "rounded_up": ("",), "up": ("nearest", "down"),
         "down": ("nearest", "up"), "stable_sort": (), "isfinite": ("!std::isfinite",)}
OPEN, CLOSE = "([{", ")]}"


@dataclass(frozen=True)
class Token:
    kind: str
    text: str
    begin: int
    end: int


@dataclass(frozen=True)
class Mutant:
    number: int
    file: str
    line: int
    line_text: str  # stripped: what the list of equivalent mutants knows a place by
    change: str     # "BEFORE -> AFTER", with "(nth)" where the same change is possible several times on a line
    source: str

    @property
    def name(self):
        return f"{self.number:5} {self.file}:{self.line}: {self.change}    | {self.line_text}"


def tokens_of(source):
    found = [Token(m.lastgroup, m.group(), m.start(), m.end()) for m in TOKEN.finditer(source)]
    return [t for t in found if t.kind not in ("comment", "directive")]


def number_changes(text):
    """Twice and half of a constant; 0 and 1 become each other."""
    suffix = re.search(r"[uUlLfF]*$", text).group() if not text.lower().startswith("0x") else ""
    body = text[:len(text) - len(suffix)].replace("'", "")
    if body in ("0", "0.0"):
        return [body.replace("0", "1", 1) + suffix]
    if body in ("1", "1.0"):
        return [body.replace("1", "0", 1) + suffix, body.replace("1", "2", 1) + suffix]
    if body.isdigit():
        value = int(body)
        return [f"{value + 1}{suffix}", f"{value - 1}{suffix}"] if value < 8 else [f"{2 * value}{suffix}", f"{value // 2}{suffix}"]
    if body.lower().startswith("0x"):
        return []
    return [f"{float(body) * 2!r}", f"{float(body) / 2!r}"]


class File:
    def __init__(self, path, source):
        self.path, self.source, self.tokens = path, source, tokens_of(source)
        self.edits = []  # (begin, end, replacement)

    def spaced(self, k):
        """Whether an operator stands between spaces: that of an expression, not of a template or a pointer."""
        t = self.tokens[k]
        return self.source[t.begin - 1].isspace() and self.source[t.end].isspace()

    def matching(self, k):
        depth = 0
        for n in range(k, len(self.tokens)):
            depth += (self.tokens[n].text in OPEN) - (self.tokens[n].text in CLOSE)
            if depth == 0:
                return n
        return None

    def operand_after(self, k, ends):
        """The last token of the operand that begins after token k."""
        depth = 0
        for n in range(k + 1, len(self.tokens)):
            text = self.tokens[n].text
            if depth == 0 and (text in CLOSE or text in ends):
                return n - 1
            depth += (text in OPEN) - (text in CLOSE)
        return None

    def operand_before(self, k, ends):
        depth = 0
        for n in range(k - 1, -1, -1):
            text = self.tokens[n].text
            if depth == 0 and (text in OPEN or text in ends):
                return n + 1
            depth += (text in CLOSE) - (text in OPEN)
        return None

    def replace(self, first, last, text):
        self.edits.append((self.tokens[first].begin, self.tokens[last].end, text))

    def text(self, first, last):
        return self.source[self.tokens[first].begin:self.tokens[last].end]

    def arguments(self, k):
        """Token ranges of the arguments within the brackets that open at token k."""
        last = self.matching(k)
        ranges, begin = [], k + 1
        while last is not None and begin < last:
            end = self.operand_after(begin - 1, ",")
            ranges.append((begin, end))
            begin = end + 2
        return ranges

    def operators(self, k, t):
        if t.text in COMPARISONS and self.spaced(k) and self.tokens[k - 1].text != "operator":
            for other in COMPARISONS[t.text]:
                self.replace(k, k, other)
        if t.text in ARITHMETIC and self.spaced(k):
            self.replace(k, k, ARITHMETIC[t.text])
        before = self.tokens[k - 1].text
        if t.text in "-!" and not self.source[t.end].isspace() and (before in ("(", ",", "{", "?", ":", "return", "&&", "||", "=", "+", "-", "*", "/", "<", "<=", ">", ">=")):
            self.replace(k, k, "")
        if t.text in ("&&", "||") and self.spaced(k):
            self.replace(k, k, "||" if t.text == "&&" else "&&")
            nothing = "true" if t.text == "&&" else "false"
            ends = ("&&", "||", "?", ":", ",", ";", "return", "=")
            last = self.operand_after(k, ends)
            self.replace(k + 1, last, nothing)
            first = self.operand_before(k, ends)
            if self.tokens[first - 1].text not in ("&&", "||"):
                self.replace(first, k - 1, nothing)
        if t.text == "?":
            middle = self.operand_after(k, (":",))
            last = self.operand_after(middle + 1, (",", ";")) if middle else None
            if last:
                self.replace(k + 1, last, f"{self.text(middle + 2, last)} : {self.text(k + 1, middle)}")

    def words(self, k, t):
        if t.text in NAMES and self.tokens[k - 1].text in ("::", ".", "=", "(", ",", "return", "&&", "{") or t.text == "rounded_up":
            qualified = k > 1 and self.tokens[k - 1].text == "::" and self.tokens[k - 2].text == "std"
            for other in NAMES[t.text]:
                cut = other == "" or other.startswith("!") or other.startswith("std::")
                self.replace(k - 2 if cut and qualified else k, k, other)
        if t.text in ("min", "max", "clamp") and self.tokens[k - 1].text == "::" and self.tokens[k + 1].text == "(":
            self.drop_arguments(k)
        if t.text in ("if", "while") and self.tokens[k + 1].text == "(":
            last = self.matching(k + 1)
            if ";" not in self.text(k + 1, last) and not re.fullmatch(r"\(![\w.\[\]()]+\)", self.text(k + 1, last)):
                self.replace(k + 2, last - 1, f"!({self.text(k + 2, last - 1)})")

    def drop_arguments(self, k):
        last = self.matching(k + 1)
        arguments = self.arguments(k + 1)
        if self.tokens[k + 2].text == "{":  # a list: without one of its values
            values = self.arguments(k + 2)
            for left_out in range(len(values)):
                rest = [self.text(*v) for n, v in enumerate(values) if n != left_out]
                self.replace(k + 2, self.matching(k + 2), "{" + ", ".join(rest) + "}")
        else:
            for argument in arguments[:1] if self.tokens[k].text == "clamp" else arguments:
                self.replace(k - 2, last, f"({self.text(*argument)})")

    def statements(self):
        """Leaves out early exits, and statements of one line that call or assign."""
        at, before = 0, ""
        for line in self.source.splitlines(keepends=True):
            text = line.strip()
            exits = re.fullmatch(r"(return\b.*|continue|break);( //.*)?", text) and before.startswith(("if (", "} else"))
            acts = re.fullmatch(r"[a-z_][\w.\[\]+ ]*?(->[\w.]+)?(\(.*\)| [-+*/]?= .*);( //.*)?", text) and not re.match(
                r"(return|throw|const|constexpr|static|auto|std|double|bool|int|using|delete)\b|\w+ \w+", text)
            acts = acts and not re.match(r"asking_?\.check|check_cancelled|.*\.reserve\(", text)  # these are about time
            acts = acts or re.fullmatch(r"(\+\+|--)\w+;", text)
            if exits or acts:
                begin = at + len(line) - len(line.lstrip())
                self.edits.append((begin, at + len(line.rstrip()), ";"))
            at, before = at + len(line), text or before

    def mutants(self, first_number):
        skip = set()
        for k, t in enumerate(self.tokens):
            if t.text in ("static_assert", "throw", "CancellationCounter", "reserve"):
                end = self.operand_after(k, (";",))
                skip.update(range(k, (end or k) + 1))
            if t.text == "for" and self.tokens[k + 1].text == "(":  # the step of a loop: would only hang
                last = self.matching(k + 1)
                semicolons = [n for n in range(k, last) if self.tokens[n].text == ";"]
                skip.update(range(semicolons[-1], last) if semicolons else ())
        for k, t in enumerate(self.tokens):
            if k in skip or k == 0:
                continue
            if t.kind == "operator":
                self.operators(k, t)
            elif t.kind == "word":
                self.words(k, t)
            elif t.kind == "number" and not self.of_a_type(k):
                for other in number_changes(t.text):
                    self.replace(k, k, other)
        self.statements()
        return self.listed(first_number)

    def of_a_type(self, k):
        """Whether a number is an argument of a template or the width of a counter."""
        before = self.source[:self.tokens[k].begin].rsplit("\n", 1)[-1]
        after = self.source[self.tokens[k].end]
        return after == ">" or before.endswith("<") or "asking" in before

    def listed(self, number):
        result, seen, made = [], {}, set()
        for begin, end, text in sorted(self.edits):
            while self.source[begin].isspace():
                begin += 1
            source = self.source[:begin] + text + self.source[end:]
            if source == self.source or source in made:
                continue
            made.add(source)
            line_begin = self.source.rfind("\n", 0, begin) + 1
            line_text = self.source[line_begin:self.source.find("\n", begin)].strip()
            before = " ".join(self.source[begin:end].split())
            change = f"{before} -> {' '.join(text.split()) or 'nothing'}"
            if text == ";":
                change = "left out"
            seen[(line_text, change)] = nth = seen.get((line_text, change), 0) + 1
            if nth > 1:
                change += f" ({nth})"
            result.append(Mutant(number + len(result), self.path, self.source.count("\n", 0, begin) + 1, line_text, change, source))
        return result


def mutants_of(path, source, first_number=0):
    return File(path, source).mutants(first_number)
