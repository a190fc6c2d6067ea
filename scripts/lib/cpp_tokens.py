"""The tokens of a C++ source, as far as finding declarations needs them.

Comments and preprocessor lines are gone (of #if ... #else only the first branch is kept, and nothing of #if 0), a literal is one token.
Brackets are matched here once: a `(`, `[` or `{` knows its partner.
"""

import re
from bisect import bisect_right

IDENTIFIER, LITERAL, SYMBOL = "identifier", "literal", "symbol"

_CODE = re.compile(
    r"""(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)
      | (?P<directive>(?:(?<=\n)|\A)[ \t]*\#(?:\\\n|//[^\n]*|/\*.*?\*/|[^\n])*)
      | (?P<raw>(?:u8|[uUL])?R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"\w*)
      | (?P<literal>(?:u8|[uUL])?(?:"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')\w*
                  | \.?\d(?:[eEpP][+-]|'\w|[\w.])*)
      | (?P<identifier>[A-Za-z_]\w*)
      | (?P<symbol>::|->|\.\.\.|\S)""",
    re.DOTALL | re.VERBOSE)
_PARTNER = {")": "(", "]": "[", "}": "{"}


class Unreadable(Exception):
    """What the reader of declarations does not understand: (line, reason)."""

    def __init__(self, line, reason):
        super().__init__(reason)
        self.line = line


class Tokens:
    """Parallel lists: text and kind of each token, its line, and the index of a bracket's partner."""

    def __init__(self, source):
        self.text, self.kind, self.line, self.partner = [], [], [], []
        self._read(source)
        self._match_brackets()

    def __len__(self):
        return len(self.text)

    def _read(self, source):
        starts = [0] + [match.end() for match in re.finditer("\n", source)]
        branches = _Branches()
        for match in _CODE.finditer(source):
            kind = match.lastgroup if match.lastgroup != "mark" else "raw"
            if kind == "directive":
                branches.see(match.group(0))
            elif kind != "comment" and branches.kept():
                self.text.append(match.group(0))
                self.kind.append({"identifier": IDENTIFIER, "symbol": SYMBOL}.get(kind, LITERAL))
                self.line.append(bisect_right(starts, match.start()))

    def _match_brackets(self):
        self.partner = [None] * len(self)
        open_ones = []
        for i, text in enumerate(self.text):
            if self.kind[i] != SYMBOL:
                continue
            if text in "([{":
                open_ones.append(i)
            elif text in ")]}":
                if not open_ones or self.text[open_ones[-1]] != _PARTNER[text]:
                    raise Unreadable(self.line[i], f"'{text}' closes nothing")
                self.partner[i] = open_ones[-1]
                self.partner[open_ones.pop()] = i
        if open_ones:
            raise Unreadable(self.line[open_ones[-1]], f"'{self.text[open_ones[-1]]}' is never closed")

    def after_angle(self, start, end):
        """Index behind the template arguments whose `<` is at `start`, or None where that `<` is no such bracket."""
        depth, i = 0, start
        while i < end:
            text = self.text[i] if self.kind[i] == SYMBOL else ""
            if text == "<":
                depth += 1
            elif text == ">":
                depth -= 1
                if depth == 0:
                    return i + 1
            elif text in (";", "{", "}", ")", "]"):
                return None
            elif text in ("(", "["):
                i = self.partner[i]
            i += 1
        return None


class _Branches:
    """Which branches of conditional directives are kept: the first one, or the second of #if 0."""

    def __init__(self):
        self.open_ones = []  # [kept, one of them has been kept]

    def kept(self):
        return all(kept for kept, _ in self.open_ones)

    def see(self, directive):
        words = directive.replace("#", " ", 1).split()
        name = words[0] if words else ""
        if name in ("if", "ifdef", "ifndef"):
            kept = not (name == "if" and words[1:2] == ["0"])
            self.open_ones.append([kept, kept])
        elif name in ("else", "elif") and self.open_ones:
            one = self.open_ones[-1]
            one[0] = not one[1]
            one[1] = True
        elif name == "endif" and self.open_ones:
            self.open_ones.pop()
