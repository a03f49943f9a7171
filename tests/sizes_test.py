#!/usr/bin/env python3
"""How large things may be: no source file above 300 lines, no function above 60, no class above 12 data members, no options struct above 7 fields.

Reads the sources of include/, src/ and examples/ by their tokens: comments, texts and preprocessor lines are blanked, what is left is sorted by its
braces into namespaces, classes, functions and initializers.

- Lines of a table are not counted: those strictly inside a braced list of at least ten lines that holds no statement.
- A function counts from the first line of its signature to its closing brace, with the lambdas and classes inside it.
- Data members are those of each object, not the static ones. A struct that only one class holds (itself, or by a pointer or an optional, not a list
  of such), and that no other unit names, counts with it. A unit is a header with its source: the files of one folder and one name.
- Options are what is named ...Options, ...Arguments, ...Model, ...Plan or ...Rule, and what a parameter takes by default (`= {}`). The fields of
  options inside options count in their place.

EXCEPTIONS may only shrink: one that is not needed any more is a fault, too. Before it judges the tree it judges samples that it must reject.

usage: sizes_test.py PROJECT_ROOT [--all]        needs Python 3 and nothing else; --all prints what was measured
"""

import collections
import pathlib
import re
import sys
import tempfile

LIMITS = {"file": 300, "function": 60, "class": 12, "options": 7}
UNITS = {"file": "lines", "function": "lines", "class": "data members", "options": "fields"}
LEAST_TABLE = 10  # lines, with its braces

# What is too large still: (file, kind, name) and how large it may be at most.
EXCEPTIONS = {
    ("include/palpation/exploration/model.h", "options", "FieldModel"): 15,
    ("include/palpation/exploration/model.h", "options", "Model"): 20,
    ("include/palpation/exploration/plan.h", "options", "Plan"): 12,
    ("include/palpation/world/phantom.h", "options", "StiffnessModel"): 8,
    ("src/experiments/experiment_command.h", "options", "ExperimentArguments"): 11,
    ("src/geometry/surface_state.h", "class", "State"): 25,
    ("src/tool/commands.h", "class", "MeshArguments"): 17,
    ("src/tool/commands.h", "options", "MeshArguments"): 17,
    ("src/tool/surface_command.h", "options", "SurfaceArguments"): 11,
}

BLANKED = re.compile(
    r'//(?:[^\n\\]|\\.|\\\n)*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:[^\n\\]|\\\n|\\.)*",
    re.DOTALL | re.MULTILINE,
)
TOKEN = re.compile(r"[A-Za-z_]\w*|[0-9](?:[\w.']|(?<=[eEpP])[+-])*|\"|::|->|\.\.\.|\[\[|\]\]|[^\s\w]")
OPENERS = {"(": ")", "[": "]", "{": "}", "[[": "]]"}
CLASS_KEYS = {"class", "struct", "union"}
HOLDERS_OF_ONE = {"optional", "unique_ptr", "shared_ptr"}
NO_MEMBER = {"using", "typedef", "friend", "static_assert", "static", "template", "enum", "public", "private", "protected"}
OPTIONS_NAME = re.compile(r"\w*(Options|Arguments|Model|Plan|Rule)$")

Token = collections.namedtuple("Token", "text line")
Found = collections.namedtuple("Found", "kind name first last")  # of a function
Class = collections.namedtuple("Class", "place name line members")  # members: (name, the words of its type)


def tokens_of(code):
    def blank(match):
        text = match.group(0)
        lines = "\n" * text.count("\n")
        return '"' + lines if text[0] in "\"'R" else " " + lines

    code = BLANKED.sub(blank, code)
    tokens, line, at = [], 1, 0
    for match in TOKEN.finditer(code):
        line += code.count("\n", at, match.start())
        at = match.start()
        tokens.append(Token(match.group(0), line))
    return tokens


class Reader:
    """Sorts the tokens of one file."""

    def __init__(self, place, code):
        self.place, self.tokens = place, tokens_of(code)
        self.functions, self.classes, self.tables, self.taken_by_default = [], [], [], set()
        self.partner = self.partners()
        self.find_tables()
        self.declarations(0, len(self.tokens), "", None)

    def text(self, at):
        return self.tokens[at].text if 0 <= at < len(self.tokens) else ""

    def partners(self):
        partner, stack = {}, []
        for at, token in enumerate(self.tokens):
            if token.text in OPENERS:
                stack.append(at)
            elif token.text in OPENERS.values():
                if not stack and token.text != "]]":
                    raise ValueError(f"{self.place}:{token.line}: {token.text} closes nothing")
                # x[y[0]] ends with two brackets that only look like the end of an attribute.
                if token.text == "]]" and self.text(stack[-1]) == "[":
                    partner[stack.pop()] = at
                opened = stack.pop()
                if OPENERS[self.text(opened)] != token.text and token.text != "]]":
                    raise ValueError(f"{self.place}:{token.line}: {token.text} closes {self.text(opened)}")
                partner[opened] = at
        if stack:
            raise ValueError(f"{self.place}:{self.tokens[stack[-1]].line}: {self.text(stack[-1])} is never closed")
        return partner

    def find_tables(self):
        """The outermost braced lists of many lines without a statement: (line of its brace, line of the other)."""
        last = -1
        for at, end in sorted(self.partner.items()):
            if self.text(at) != "{" or at < last:
                continue
            inside = {token.text for token in self.tokens[at + 1 : end]}
            first_line, last_line = self.tokens[at].line, self.tokens[end].line
            is_list = self.text(at - 1) != ")" and not inside & ({";"} | CLASS_KEYS) and not self.is_enum(at)
            if is_list and last_line - first_line + 1 >= LEAST_TABLE:
                self.tables.append((first_line, last_line))
                last = end

    def is_enum(self, brace):
        at = brace - 1
        while at >= 0 and (re.match(r"\w|::|:", self.text(at))):
            if self.text(at) == "enum":
                return True
            at -= 1
        return False

    def lines_of_tables(self, first, last):
        return sum(max(0, min(b - 1, last) - max(a + 1, first) + 1) for a, b in self.tables)

    def after_angles(self, at):
        """Behind the > that closes the < at this place; behind the < where there is none."""
        depth, start = 0, at
        while at < len(self.tokens):
            text = self.text(at)
            if text == "<":
                depth += 1
            elif text == ">":
                depth -= 1
                if depth == 0:
                    return at + 1
            elif text in OPENERS:
                at = self.partner[at]
            elif text in {";", ")", "}", "]"}:
                break
            at += 1
        return start + 1

    def declarations(self, at, end, owner, members):
        """What stands in a namespace (members is None) or a class (members receives its data)."""
        while at < end:
            at = self.declaration(at, end, owner, members)

    def declaration(self, start, end, owner, members):
        """Reads one declaration or definition, and returns where the next begins."""
        head = []  # places of the tokens at its top level, what stands in brackets and <> left out
        at, has_class, has_list, in_initializers, assigned = start, False, False, False, False
        is_function = False
        while at < end:
            text = self.text(at)
            if text in {"public", "private", "protected"} and self.text(at + 1) == ":" and not head:
                return at + 2
            if text == ";":
                break
            if text == "operator":  # its name may be a bracket, < or =
                head.append(at)
                at += 1
                if self.text(at) in {"(", "["}:
                    at += 2
                while at < end and self.text(at) != "(":
                    at += 1
                continue
            if text in {"[", "[["}:
                at = self.partner[at] + 1
                continue
            if text == "<" and re.match(r"\w", self.text(at - 1)) and not (assigned and self.after_angles(at) == at + 1):
                at = self.after_angles(at)
                continue
            if text == "(":
                is_pointer = self.text(at + 1) in {"*", "&"} or (self.text(at + 2) == "::" and self.text(at + 3) == "*")
                if self.text(at - 1) not in {"alignas", "noexcept", "decltype", "requires", "explicit"} and not assigned and not is_pointer:
                    if not is_function:
                        self.parameters(at)
                    is_function = True
                if is_pointer and not assigned:
                    head.append(at + 2)
                at = self.partner[at] + 1
                if is_pointer and self.text(at) == "(":
                    at = self.partner[at] + 1
                continue
            if text == "=":
                assigned = True
            if text == ":" and is_function:
                in_initializers = True
            if text == "{":
                words = [self.text(place) for place in head]
                closing = self.partner[at]
                if not assigned and not is_function and ("namespace" in words or words == ["extern", '"'] or not words):
                    self.declarations(at + 1, closing, owner, None)
                    return closing + 1
                if is_function and not assigned:
                    if in_initializers and self.text(at - 1) not in {")", "}"}:
                        at = closing + 1
                        continue
                    self.body(at + 1, closing, owner)
                    self.functions.append(Found("function", owner + self.name_of(head), self.tokens[start].line, self.tokens[closing].line))
                    return closing + 1
                if not assigned and "enum" not in words and CLASS_KEYS & set(words) and not has_class:
                    name = self.class_name(head)
                    inner = []
                    self.declarations(at + 1, closing, owner + name + "::", inner)
                    self.classes.append(Class(self.place, owner + name, self.tokens[start].line, inner))
                    has_class, head = True, []
                    at = closing + 1
                    continue
                has_list = True
                self.body(at + 1, closing, owner)
                at = closing + 1
                continue
            head.append(at)
            at += 1

        words = [self.text(place) for place in head]
        if (has_list or assigned) and "enum" not in words:  # a variable; one with a lambda is as long as a function
            first, last = self.tokens[start].line, self.tokens[min(at, end - 1)].line
            self.functions.append(Found("function", owner + self.name_of(head), first, last))
        if members is not None and not is_function and words and not NO_MEMBER & set(words):
            is_forward = words[0] in CLASS_KEYS and len(words) == 2 and not has_class
            if not is_forward:
                members.extend(self.declarators(start, at, has_class))
        return at + 1

    def declarators(self, start, end, after_class):
        """The members that a declaration makes: (name, words of its type), parted by commas at its top level."""
        if after_class:
            start = next(self.partner[at] + 1 for at in range(start, end) if self.text(at) == "{")
        parts, at = [[]], start
        while at < end:
            text = self.text(at)
            if text == ",":
                parts.append([])
            elif text in OPENERS:
                if text == "(" and self.text(at + 1) in {"*", "&"}:
                    parts[-1].append(self.text(at + 2))
                at = self.partner[at]
            elif text == "<" and self.after_angles(at) > at + 1:
                after = self.after_angles(at)
                parts[-1] += ["<", *[self.text(place) for place in range(at + 1, after - 1)], ">"]
                at = after - 1
            else:
                parts[-1].append(text)
            at += 1
        named = []
        for part in parts:
            declared = part[: part.index("=")] if "=" in part else part
            declared = declared[: declared.index(":")] if ":" in declared else declared  # a bit field
            words = [word for word in declared if re.match(r"[A-Za-z_]", word)]
            type_words = [word for word in declared if re.match(r"[A-Za-z_<]", word)][:-1]
            named.append((words[-1] if words else "?", type_words))
        kind = named[0][1]
        return [(name, words or kind) for name, words in named]

    def parameters(self, opening):
        """Notes the types that a parameter list takes by default, as in `const Options& options = {}`."""
        at, end = opening + 1, self.partner[opening]
        words = []
        while at < end:
            text = self.text(at)
            if text == "=" and self.text(at + 1) == "{" and self.partner[at + 1] == at + 2 and "<" not in words:
                named = [word for word in words if re.match(r"[A-Za-z_]", word) and word != "const"]
                self.taken_by_default.update(named[-2:-1])
            words = [] if text == "," else words + [text]
            at = self.partner[at] + 1 if text in {"(", "{", "["} else at + 1

    def body(self, at, end, owner):
        """Of a function or an initializer: only the classes in it matter."""
        while at < end:
            if self.text(at) in CLASS_KEYS and self.text(at - 1) not in {"enum", "<", ",", "("}:
                stop = at
                while stop < end and self.text(stop) not in {"{", ";", "(", ")", "=", "}"}:
                    stop = self.after_angles(stop) if self.text(stop) == "<" else stop + 1
                if self.text(stop) == "{":
                    at = self.declaration(at, end, owner, None)
                    continue
            at += 1

    def name_of(self, head):
        words = [self.text(place) for place in head]
        if "operator" in words:
            return "operator"
        for stop in (":", "="):
            if stop in words:
                words = words[: words.index(stop)]
        names = [word for word in words if re.match(r"[A-Za-z_~]", word) and word not in {"const", "override", "final", "noexcept", "try", "mutable"}]
        if "->" in words:
            names = [word for word in words[: words.index("->")] if re.match(r"[A-Za-z_]", word)]
        return names[-1] if names else "?"

    def class_name(self, head):
        words = [self.text(place) for place in head]
        words = words[next(i for i, word in enumerate(words) if word in CLASS_KEYS) + 1 :]
        if ":" in words:
            words = words[: words.index(":")]
        names = [word for word in words if re.match(r"[A-Za-z_]", word) and word not in {"final", "alignas"}]
        return names[-1] if names else "(unnamed)"


def unit_of(place):
    """Folder and name of a header and its source, which are one unit."""
    path = pathlib.PurePosixPath(place)
    return f"{path.parent.name}/{path.stem}"


def held(words):
    """The words of a member's type that it holds one of: what a list is made of does not count."""
    if "<" not in words:
        return words
    opened = words.index("<")
    return words[:opened] + held(words[opened + 1 :]) if opened and words[opened - 1] in HOLDERS_OF_ONE else words[:opened]


class Tree:
    """Everything that was measured: {(file, kind, name): (line, size)}."""

    def __init__(self, root):
        self.readers, self.sizes, self.named_in = [], {}, collections.defaultdict(set)
        for folder in ("include", "src", "examples"):
            for path in sorted((root / folder).rglob("*")):
                if path.suffix in {".h", ".cpp"}:
                    self.read(path.relative_to(root).as_posix(), path.read_text(encoding="utf-8"))
        self.by_name = collections.defaultdict(list)
        for reader in self.readers:
            for found in reader.classes:
                self.by_name[found.name.split("::")[-1]].append(found)
        self.by_default = set().union(*(reader.taken_by_default for reader in self.readers))
        self.measure_classes()

    def read(self, place, code):
        reader = Reader(place, code)
        self.readers.append(reader)
        for word in {token.text for token in reader.tokens}:
            self.named_in[word].add(unit_of(place))
        lines = code.count("\n")
        self.sizes[place, "file", ""] = (1, lines - reader.lines_of_tables(1, lines))
        for found in reader.functions:
            size = found.last - found.first + 1 - reader.lines_of_tables(found.first, found.last)
            key = (place, "function", found.name)
            self.sizes[key] = max(self.sizes.get(key, (0, 0)), (found.first, size), key=lambda entry: entry[1])

    def measure_classes(self):
        holders = collections.defaultdict(set)  # of a class, by its name: who has members of it
        for found in (found for reader in self.readers for found in reader.classes):
            for _, words in found.members:
                for word in words:
                    if word in self.by_name:
                        holders[word].add((found.place, found.name))
        for found in (found for reader in self.readers for found in reader.classes):
            self.sizes[found.place, "class", found.name] = (found.line, self.data_members(found, holders, ()))
            if self.is_options(found):
                self.sizes[found.place, "options", found.name] = (found.line, self.fields(found, ()))

    def data_members(self, found, holders, seen):
        own = 0
        for _, words in found.members:
            only = [
                self.by_name[word][0]
                for word in held(words)
                if len(holders[word]) == 1 and len(self.by_name[word]) == 1 and word not in seen and self.named_in[word] == {unit_of(found.place)}
            ]
            own += self.data_members(only[0], holders, (*seen, only[0].name.split("::")[-1])) if only else 1
        return own

    def is_options(self, found):
        name = found.name.split("::")[-1]
        return bool(OPTIONS_NAME.match(name)) or name in self.by_default

    def fields(self, found, seen):
        total = 0
        for _, words in found.members:
            inner = [self.by_name[word][0] for word in words if len(self.by_name.get(word, [])) == 1 and word not in seen]
            inner = [other for other in inner if self.is_options(other)]
            total += self.fields(inner[0], (*seen, inner[0].name.split("::")[-1])) if inner else 1
        return total

    def faults(self, exceptions):
        words = []
        for (place, kind, name), (line, size) in sorted(self.sizes.items()):
            if size > exceptions.get((place, kind, name), LIMITS[kind]):
                words.append(f"{place}:{line}: {kind} {name}: {size} {UNITS[kind]}, at most {LIMITS[kind]}".replace("file :", "file:"))
        for place, kind, name in sorted(exceptions):
            if self.sizes.get((place, kind, name), (0, 0))[1] <= LIMITS[kind]:
                words.append(f"tests/sizes_test.py: the exception for {kind} {name or place} of {place} is not needed any more: delete it")
        return words


def lines(count):
    return "  f();\n" * count


def members(count, name="a"):
    return "".join(f"  int {name}{i}_ = 0;\n" for i in range(count))


FULL = "class Full {\n public:\n  Full();\n  int f(int x, int y = 3) const;\n private:\n" + members(12) + "};\n"
# (file, its text, the part of its one fault, or None where there must be none)
SAMPLES = [
    ("src/a/short.cpp", "\n" * 300, None),
    ("src/a/long.cpp", "\n" * 301, "file: 301 lines"),
    ("include/p/a/long.h", "// words\n" * 301, "file: 301 lines"),
    ("src/a/table.cpp", "const int kRows[] = {\n" + "  {1, 2},\n" * 400 + "};\n", None),
    ("src/a/small_table.cpp", "const int kRows[] = {\n" + "  {1, 2},\n" * 7 + "};\n" + "\n" * 292, "file: 301 lines"),
    ("src/a/no_table.cpp", "namespace a {\n" + "int f();\n" * 400 + "}\n", "file: 402 lines"),
    ("src/a/enum.cpp", "enum class E : int {\n" + "  A,\n" * 400 + "};\n", "file: 402 lines"),
    ("src/a/function.cpp", "void g() {\n" + lines(58) + "}\n", None),
    ("src/a/function.cpp", "void g() {\n" + lines(59) + "}\n", "function g: 61 lines"),
    ("src/a/signature.cpp", "std::map<int, int>\nA::g(\n    int x) const {\n" + lines(57) + "}\n", "function g: 61 lines"),
    ("src/a/template.cpp", "template <typename T, int n = (3 > 2)>\nstd::vector<T> g(T x) {\n" + lines(58) + "}\n", "function g: 61 lines"),
    ("src/a/table_function.cpp", "const K& g() {\n  static const K keys = {\n" + "  {1, f(2)},\n" * 80 + "  };\n  return keys;\n}\n", None),
    ("src/a/lambda_in_list.cpp", "const K& g() {\n  static const K keys = {\n" + "  [] { return 1; },\n" * 80 + "  };\n  return keys;\n}\n", "function g: 85 lines"),
    ("src/a/lambda.cpp", "void g() {\n  const auto h = [&](int x) {\n" + lines(58) + "  };\n}\n", "function g: 62 lines"),
    ("src/a/variable.cpp", "const auto g = [](int x) {\n" + lines(60) + "};\n", "function g: 62 lines"),
    ("src/a/constructor.cpp", "A::A(int x)\n    : a_{x}, b_(x), c_{{1, 2}} {\n" + lines(58) + "}\n", "function A: 61 lines"),
    ("src/a/trailing.cpp", "auto g(int x) -> std::vector<int> {\n" + lines(59) + "}\n", "function g: 61 lines"),
    ("src/a/operator.cpp", "bool operator<(A a, A b) {\n" + lines(59) + "}\n", "function operator: 61 lines"),
    ("src/a/call.cpp", "int A::operator()(A a) const noexcept {\n" + lines(59) + "}\n", "function operator: 61 lines"),
    ("src/a/method.cpp", "namespace n {\nclass A : public B<int> {\n  int g() override {\n" + lines(59) + "}\n};\n}\n", "function A::g: 61 lines"),
    ("src/a/braces.cpp", 'void g() {\n  f("}", \'}\', R"(}})");  // }\n' + lines(59) + "}\n", "function g: 62 lines"),
    ("src/a/test.cpp", "TEST(A, B) {\n" + lines(59) + "}\n", "function TEST: 61 lines"),
    ("src/a/full.cpp", FULL, None),
    ("src/a/over.cpp", FULL.replace(" private:\n", " private:\n  std::function<void(int, int)> f_;\n"), "class Full: 13 data members"),
    ("src/a/pointer.cpp", FULL.replace(" private:\n", " private:\n  void (*f_)(int);\n"), "class Full: 13 data members"),
    ("src/a/array.cpp", FULL.replace(" private:\n", " private:\n  alignas(64) double x_[3] = {1, 2, 3};\n"), "class Full: 13 data members"),
    ("src/a/two.cpp", FULL.replace("  int a0_ = 0;\n", "  std::map<int, int> x_{}, y_ = {};\n"), "class Full: 13 data members"),
    ("src/a/static.cpp", FULL.replace(" private:\n", " private:\n  static constexpr int k = 3;\n  using T = int;\n  friend class F;\n  struct G;\n"), None),
    ("src/a/unnamed.cpp", FULL.replace(" private:\n", " private:\n  struct {\n    int x, y;\n  } both_;\n"), "class Full: 13 data members"),
    ("src/a/local.cpp", "void g() {\n  struct Local final : B {\n" + members(13) + "  };\n}\n", "class Local: 13 data members"),
    ("src/a/nested.cpp", "struct Outer {\n  template <class T>\n  struct Inner {\n" + members(13) + "  };\n};\n", "class Outer::Inner: 13 data members"),
    ("src/a/hidden.cpp", "struct Part {\n" + members(7) + "};\nclass Whole {\n  Part part_;\n" + members(6) + "};\n", "class Whole: 13 data members"),
    ("src/a/optional.cpp", "struct Part {\n" + members(7) + "};\nclass Whole {\n  std::optional<Part> part_;\n" + members(6) + "};\n", "class Whole: 13"),
    ("src/a/list.cpp", "struct Part {\n" + members(7) + "};\nclass Whole {\n  std::vector<Part> parts_;\n" + members(6) + "};\n", None),
    ("src/a/shared.cpp", "struct Part {\n" + members(7) + "};\nclass Whole {\n  Part part_;\n" + members(6) + "};\nstruct More {\n  Part part;\n};\n", None),
    ("include/p/a/options.h", "struct RunOptions {\n" + members(8) + "};\n", "options RunOptions: 8 fields"),
    ("include/p/a/default.h", "struct Way {\n" + members(8) + "};\nint run(int x, const Way& way = {});\n", "options Way: 8 fields"),
    ("include/p/a/result.h", "struct Way {\n" + members(8) + "};\nWay run(int x, const std::vector<int>& y = {});\n", None),
    ("include/p/a/within.h", "struct AOptions {\n" + members(7) + "};\nstruct BOptions {\n  AOptions a;\n  int b = 0;\n};\n", "options BOptions: 8 fields"),
]


def faults_of_sample(name, code, exceptions):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / name
        path.parent.mkdir(parents=True)
        path.write_text(code, encoding="utf-8")
        return Tree(pathlib.Path(folder)).faults(exceptions)


def test_itself():
    """Each sample alone in a tree of its own: exactly the fault that is expected, or none."""
    for name, code, expected in SAMPLES:
        faults = faults_of_sample(name, code, {})
        if expected is None and faults:
            sys.exit(f"this test is broken: {name} is innocent, but it says {faults}")
        if expected is not None and not (len(faults) == 1 and faults[0].startswith(name + ":") and expected in faults[0]):
            sys.exit(f"this test is broken: {name} has one fault, {expected}, but it says {faults}")
    for size, allowed, fault in ((301, 301, None), (302, 301, "302 lines"), (300, 301, "not needed any more")):
        faults = faults_of_sample("src/a/long.cpp", "\n" * size, {("src/a/long.cpp", "file", ""): allowed})
        if (fault is None) != (not faults) or (fault and fault not in faults[0]):
            sys.exit(f"this test is broken: of {size} lines where {allowed} are excepted it says {faults}")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: sizes_test.py PROJECT_ROOT [--all]")
    test_itself()

    tree = Tree(pathlib.Path(sys.argv[1]))
    if sys.argv[2:] == ["--all"]:
        for (place, kind, name), (line, size) in sorted(tree.sizes.items(), key=lambda entry: (entry[0][1], -entry[1][1])):
            print(f"{size:5} {kind} {place}:{line} {name}")
    counts = collections.Counter(kind for _, kind, _ in tree.sizes)
    if counts["file"] < 100 or counts["function"] < 500 or counts["class"] < 100 or counts["options"] < 5:
        sys.exit(f"only {dict(counts)} in {sys.argv[1]}: that is not the project")
    faults = tree.faults(EXCEPTIONS)
    if faults:
        sys.exit("\n".join(faults + [f"{len(faults)} faults"]))
    print(f"{len(SAMPLES) + 3} samples judged right; of {dict(counts)} none is too large but {len(EXCEPTIONS)} exceptions")


if __name__ == "__main__":
    main()
