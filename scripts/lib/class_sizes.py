"""How many functions and data members each class of a C++ source text declares.

Counted are all member functions that a class declares (constructors, destructors, operators, static ones, defaulted and deleted ones,
overrides, those of one line), and all its non-static data members; those of an anonymous union or struct are its own. Not counted are
friends, aliases, types, and whatever a base or a nested class declares: a nested class is one of its own, Outer::Inner.
"""

from dataclasses import dataclass

from cpp_tokens import IDENTIFIER, LITERAL, Tokens, Unreadable

CLASS_KEYS = ("class", "struct", "union")
NO_MEMBER = ("friend", "using", "typedef", "static_assert")
SPECIFIERS = ("static", "constexpr", "inline", "virtual", "explicit", "mutable", "const", "volatile", "thread_local", "typename")
BUILT_IN = ("unsigned", "signed", "short", "long", "int", "char", "double", "float", "bool")


@dataclass
class ClassSize:
    name: str
    line: int
    functions: int = 0
    members: int = 0
    path: str = ""


class Reader:
    """Finds the classes in a source text."""

    def __init__(self, source):
        self.tokens = Tokens(source)
        self.text = self.tokens.text
        self.classes = []
        self._scan(0, len(self.tokens), ())

    # Where classes may be: namespaces, function bodies, expressions.

    def _scan(self, start, end, scope):
        i = start
        while i < end:
            if self._is(i, "namespace"):
                i = self._namespace(i, end, scope)
            elif self._is(i, "template") and self._is(i + 1, "<"):
                i = self._after_template_head(i)
            elif self._is(i, *CLASS_KEYS) and not self._is(i - 1, "enum"):
                i = self._class_or_next(i, end, scope)
            else:
                i += 1

    def _namespace(self, i, end, scope):
        """Reads a namespace with its content; an alias or a using directive has none."""
        name, at = [], i + 1
        while at < end and self._is_identifier(at) or self._is(at, "::"):
            name.append(self.text[at])
            at += 1
        if not self._is(at, "{"):
            return at
        close = self.tokens.partner[at]
        self._scan(at + 1, close, scope + (("".join(name),) if name else ()))
        return close + 1

    def _class_or_next(self, i, end, scope):
        head = self._class_head(i, end)
        if head is None:
            return i + 1
        name, body = head
        self._class_body(i, body, scope + (name or "(anonymous)",))
        return self.tokens.partner[body] + 1

    def _class_head(self, i, end):
        """(name, index of its `{`) if a class is defined at token i, else None."""
        name, at = [], i + 1
        at = self._after_attributes(at)
        while at < end and (self._is_identifier(at) or self._is(at, "::", "<")):
            if self._is(at, "<"):
                after = self.tokens.after_angle(at, end)
                if after is None:
                    return None
                name.append("".join(self.text[at:after]))
                at = after
                continue
            if name and name[-1] != "::" and self._is_identifier(at):
                break
            name.append(self.text[at])
            at += 1
        if self._is(at, "final"):
            at += 1
        if self._is(at, ":"):
            at = self._find_body(at, end)
        return ("".join(name), at) if at is not None and self._is(at, "{") else None

    def _find_body(self, i, end):
        """The `{` behind a list of bases."""
        while i < end and not self._is(i, "{", ";", ")"):
            i = self.tokens.partner[i] + 1 if self._is(i, "(", "[") else i + 1
        return i

    # Inside of a class.

    def _class_body(self, key, body, scope):
        size = ClassSize("::".join(scope), self.tokens.line[key])
        self.classes.append(size)
        self._members(body + 1, self.tokens.partner[body], scope, size)

    def _members(self, start, end, scope, size):
        i = start
        while i < end:
            i = self._member(i, end, scope, size)

    def _member(self, i, end, scope, size):
        """Reads what begins at token i, and returns the index behind it."""
        if self._is(i, ";"):
            return i + 1
        if self._is(i, "public", "protected", "private") and self._is(i + 1, ":"):
            return i + 2
        if self._is(i, "template") and self._is(i + 1, "<"):
            return self._after_template_head(i)
        if self._is(i, *NO_MEMBER):
            return self._after_declaration(i, end, scope)
        return self._declaration(i, end, scope, size)

    def _declaration(self, i, end, scope, size):
        """Specifiers, then declarators: functions or data."""
        is_static, typed = False, False
        while True:
            i = self._after_attributes(i)
            if self._is(i, "decltype", "explicit") and self._is(i + 1, "("):
                typed = typed or self._is(i, "decltype")
                i = self.tokens.partner[i + 1] + 1
            elif self._is(i, *SPECIFIERS):
                is_static = is_static or self._is(i, "static")
                i += 1
            elif self._is(i, "enum"):
                body = self._enum_body(i, end)
                if body is None:
                    return self._declarators(i, end, scope, size, is_static, typed)
                i, typed = self.tokens.partner[body] + 1, True
            elif self._is(i, *CLASS_KEYS) and self._class_head(i, end):
                i, typed = self._nested_class(i, end, scope, size), True
            else:
                return self._declarators(i, end, scope, size, is_static, typed)

    def _enum_body(self, i, end):
        """The `{` of the enumerators if an enum is defined at token i, else None."""
        i = self._after_attributes(i + 2 if self._is(i + 1, *CLASS_KEYS) else i + 1)
        while i < end and not self._is(i, "{", ";", "=", "(", ","):
            if self._is_identifier(i) and self._is_identifier(i + 1):
                return None
            i += 1
        return i if self._is(i, "{") else None

    def _nested_class(self, i, end, scope, size):
        name, body = self._class_head(i, end)
        close = self.tokens.partner[body]
        if name or not self._is(close + 1, ";"):
            self._class_body(i, body, scope + (name or "(anonymous)",))
        else:
            self._members(body + 1, close, scope, size)  # an anonymous union: its members are the class's own
        return close + 1

    def _declarators(self, i, end, scope, size, is_static, typed):
        """The declarators from token i on, with their initialisers and bodies; `typed`: a whole type stands before i."""
        more = True
        while more:
            shape, i = self._declarator(i, end, typed)
            if shape == "function":
                size.functions += 1
                i = self._after_function(i, end, scope)
                if self._is(i - 1, "}"):
                    return i
            elif shape == "data" and not is_static:
                size.members += 1
            i = self._after_initialiser(i, end, scope)
            if not self._is(i, ",", ";"):
                self._fail(i, "a declaration that does not end")
            more, typed = self._is(i, ","), True
            i += 1
        return i

    def _declarator(self, i, end, typed):
        """("function", index of its parameters), ("data", index behind its name) or ("nothing", index): passes over a type before it.
        Of the names that follow each other the last one is the member's: `struct Name;` and the width of a bit field may have none."""
        names, only_type = int(typed), False
        while i < end and not self._is(i, ";", ",", "=", "{", ":", "["):
            if self._is(i, "operator"):
                return "function", self._parameters_of_operator(i, end)
            if self._is(i, "("):
                return self._round_bracket(i)
            if self._is(i, "<"):
                i = self._after_type_arguments(i, end)
                continue
            if self._is(i, "enum", *CLASS_KEYS):
                only_type = True
            elif self._is_identifier(i) and not self._is(i, *SPECIFIERS) and not self._continues_name(i):
                names += 1
            i += 1
        if names < 2 and not (only_type or typed or self._is(i, ":")):
            self._fail(i, "neither a function nor a data member")
        return ("data" if names >= 2 else "nothing"), i

    def _continues_name(self, i):
        """The further parts of a qualified name and of `unsigned long`."""
        if self._is(i - 1, "::"):
            return self._is_identifier(i - 2) or self._is(i - 2, ">")
        return self._is(i, *BUILT_IN) and self._is(i - 1, *BUILT_IN)

    def _after_type_arguments(self, i, end):
        after = self.tokens.after_angle(i, end)
        if after is None:
            self._fail(i, "'<' that opens no template arguments")
        return after

    def _round_bracket(self, i):
        """`(` at token i: the parameters of a function, or a declarator in brackets such as (*pointer)(int)."""
        close = self.tokens.partner[i]
        inner = self.text[i + 1:close]
        is_bracketed = inner[:1] in (["*"], ["&"]) or ("::", "*") in zip(inner, inner[1:])
        if not (is_bracketed and self._is(close + 1, "(", "[")):
            return "function", i
        if "(" in inner:  # a function that returns a pointer to a function
            return "function", close + 1
        at = close + 1
        while self._is(at, "(", "["):
            at = self.tokens.partner[at] + 1
        return "data", at

    def _parameters_of_operator(self, i, end):
        if self._is(i + 1, "(") and self.tokens.partner[i + 1] == i + 2:
            return i + 3
        is_conversion = self._is_identifier(i + 1) and not self._is(i + 1, "new", "delete")
        i += 1
        while i < end and not self._is(i, "("):
            after = self.tokens.after_angle(i, end) if is_conversion and self._is(i, "<") else None
            i = i + 1 if after is None else after
        return i

    def _after_function(self, i, end, scope):
        """Behind the parameters at token i and all that belongs to the function, its body included."""
        i = self.tokens.partner[i] + 1
        while i < end and not self._is(i, ";", ",", "{", "=", ":"):
            i = self._after_type_token(i, end)
        if self._is(i, ":"):
            i = self._after_constructor_initialisers(i, end, scope)
        if self._is(i, "{"):
            return self._after_body(i, end, scope)
        return i + 2 if self._is(i, "=") else i  # = 0, = default, = delete

    def _after_body(self, i, end, scope):
        """Behind the body at token i and the handlers of a function that is one try block."""
        close = self.tokens.partner[i]
        self._scan(i + 1, close, scope)
        while self._is(close + 1, "catch"):
            close = self.tokens.partner[self.tokens.partner[close + 2] + 1]
        return close + 1

    def _after_type_token(self, i, end):
        if self._is(i, "(", "["):
            return self.tokens.partner[i] + 1
        if self._is(i, "<"):
            return self.tokens.after_angle(i, end) or i + 1
        return i + 1

    def _after_constructor_initialisers(self, i, end, scope):
        """The `{` of the body behind `: a(1), b{2}`."""
        while self._is(i, ":", ","):
            i += 1
            while i < end and not self._is(i, "(", "{"):
                i = self._after_type_token(i, end)
            close = self.tokens.partner[i]
            self._scan(i + 1, close, scope)
            i = close + 1
            if self._is(i, "..."):
                i += 1
        return i

    def _after_initialiser(self, i, end, scope):
        """The `,` or `;` behind array bounds, the width of a bit field and an initialiser."""
        while i < end and not self._is(i, ",", ";"):
            if self.tokens.partner[i] is not None:
                close = self.tokens.partner[i]
                self._scan(i + 1, close, scope)
                i = close + 1
            elif self._is(i, "<"):
                i = self._after_template_arguments(i, end)
            else:
                i += 1
        return i

    def _after_template_arguments(self, i, end):
        """In an expression `<` may be less-than: template arguments are what a bracket, `::` or another end of arguments follows."""
        after = self.tokens.after_angle(i, end) if self._is_identifier(i - 1) else None
        return after if after is not None and self._is(after, "(", "{", "::", ";", ",") else i + 1

    def _after_declaration(self, i, end, scope):
        """Behind the `;` of what declares no member, or the body of a friend."""
        is_friend = self._is(i, "friend")
        while i < end and not self._is(i, ";"):
            if self._is(i, "{") and is_friend:
                return self._after_body(i, end, scope)
            i = self.tokens.partner[i] + 1 if self._is(i, "(", "[", "{") else i + 1
        return i + 1

    # Small things.

    def _after_template_head(self, i):
        after = self.tokens.after_angle(i + 1, len(self.tokens))
        if after is None:
            self._fail(i, "template parameters without an end")
        return after

    def _after_attributes(self, i):
        while self._is(i, "[") and self._is(i + 1, "[") or self._is(i, "alignas", "__attribute__") and self._is(i + 1, "("):
            i = self.tokens.partner[i if self._is(i, "[") else i + 1] + 1
        return i

    def _is(self, i, *texts):
        return 0 <= i < len(self.tokens) and self.tokens.kind[i] != LITERAL and self.text[i] in texts

    def _is_identifier(self, i):
        return 0 <= i < len(self.tokens) and self.tokens.kind[i] == IDENTIFIER

    def _fail(self, i, reason):
        raise Unreadable(self.tokens.line[min(i, len(self.tokens) - 1)], reason)


def sizes_of_text(source):
    return Reader(source).classes
