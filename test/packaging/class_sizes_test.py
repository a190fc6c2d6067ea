"""scripts/lint classes must count every way to declare a member, and nothing else; and its list of exceptions may only shrink."""

import io
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "lib"))
import class_gate  # noqa: E402
import class_sizes  # noqa: E402
from cpp_tokens import Unreadable  # noqa: E402


def sizes(text):
    return {size.name: (size.functions, size.members) for size in class_sizes.sizes_of_text(text)}


def size_of(body):
    """Functions and members of a class with this body."""
    return sizes("class C {\n" + body + "\n};")["C"]


@pytest.mark.parametrize("body, functions", [
    ("C();", 1),
    ("C(const C&) = default; C& operator=(const C&) = delete; C(C&&) noexcept;", 3),
    ("explicit C(int a, std::map<int, int> b = {}) : a_(a), b_{std::move(b)}, c_(f(1, 2)) { use(); }", 1),
    ("C(int a) : Base<int, 2>(a), Other{a} {} void f();", 2),
    ("template <class... T> C(T... t) : T(t)... {} void f();", 2),
    ("C() try : a_(1) { f(); } catch (...) { g(); } void f();", 2),
    ("~C() override; virtual ~C() = default;", 2),
    ("int f(); double g() const { return 1; } virtual void h() = 0;", 3),
    ("void f() const noexcept(noexcept(g())) override final;", 1),
    ("auto f() const -> std::map<int, int>; auto g() -> decltype(x) { return x; }", 2),
    ("std::function<void(int)> f(std::function<int(int, int)> g);", 1),
    ("static int f(); static constexpr double g() { return 0; } inline static void h() {}", 3),
    ("[[nodiscard]] int f(); [[nodiscard]] static int g();", 2),
    ("template <class T, int N = (3 > 2)> T f(T (&array)[N]); template <> void g<int>();", 2),
    ("template <class T = std::vector<int>, template <class> class U> void f();", 1),
    ("bool operator()(int) const; bool operator<(const C&) const; C& operator<<(int); C operator->*(int);", 4),
    ("int operator[](int i) { return i; } C* operator->() { return this; } C operator,(C);", 3),
    ("explicit operator bool() const { return x > 1; } operator std::map<int, std::function<void(int)>>() const;", 2),
    ("void* operator new(std::size_t); void operator delete[](void*); C operator\"\"_x(int);", 3),
    ("void (*f(int))(double);", 1),
    ("int f(), g();", 2),
    ("void f() { struct Local { int a; }; auto g = [](int) { return 1; }; if (a < b) { c > d; } }", 1),
    ("decltype(x) f(); decltype(auto) g();", 2),
    ("struct Other f(struct Another a); enum Kind g();", 2),
    ("const char* f() { return \"};\"; } // int g();\n /* int h(); */ char k() { return '{'; }", 2),
    ("const char* f() { return R\"x(} )\" { )x\"; } void g();", 2),
    ("C() = default;;; public: void f(); protected: private: void g() {};", 3),
])
def test_functions(body, functions):
    assert size_of(body) == (functions, 0)


@pytest.mark.parametrize("body, members", [
    ("int a; double b_ = 1.0; bool c{true};", 3),
    ("int a, *b, &c = d, e[3] = {1, 2}, f{4};", 5),
    ("std::map<int, std::vector<int>> a; std::array<int, (3 < 4)> b; std::array<int, N> c;", 3),
    ("std::function<void(int)> f_; std::function<int(int, int)> g_ = [](int a, int b) { return a < b; };", 2),
    ("std::map<int, int> a = std::map<int, int>{}, b;", 2),
    ("bool a = 1 < 2; bool b = x < 2, c = y > 3; int d = sizeof(std::pair<int, int>);", 4),
    ("int shift = 1 << 4, other = 1'000 >> 2;", 2),
    ("void (*f)(int); int (&array)[3]; int (C::*member)(int) = nullptr; int A::B::* p;", 4),
    ("unsigned a : 3; unsigned b : 1 << 2, c : 2; unsigned : 0; std::uint8_t d : 4; std::uint8_t : 4; unsigned long : 1;", 4),
    ("mutable std::mutex mutex_; const int a; volatile int b; unsigned long long c; typename T::type d;", 5),
    ("alignas(16) double a[4]; [[maybe_unused]] int b; decltype(f()) c;", 3),
    ("::std::string a; class Other* b; struct Other c, d; enum Kind e = Kind::A;", 5),
    ("static int a; static constexpr int b = 3, c = 4; inline static std::string d; constexpr static int e{1}; const static int f = 2;", 0),
    ("enum Kind { A, B = 3 } kind; enum { X, Y }; enum class Z : std::uint8_t { U }; enum class W : int;", 1),
    ("struct { int x; int y; } point; ", 1),
    ("union { int x; float y; }; int z;", 3),
])
def test_data_members(body, members):
    assert size_of(body) == (0, members)


@pytest.mark.parametrize("body", [
    "friend class Other; friend struct Another;",
    "friend bool operator==(const C& a, const C& b) { return &a == &b; }",
    "template <class T> friend void f(T);",
    "friend std::ostream& operator<<(std::ostream& s, const C& c);",
    "using Base::Base; using Text = std::string; template <class T> using List = std::vector<T>; using Zero = decltype(Other{});",
    "typedef int (*Function)(int);",
    'static_assert(sizeof(int) == 4, "four; or more");',
    "struct Forward; class Nested; enum class Kind : int; template <class T> struct Later;",
])
def test_what_is_no_member(body):
    assert size_of(body + " int last;") == (0, 1)


def test_a_nested_class_is_one_of_its_own():
    assert sizes("struct A { struct B { int x; void f(); struct C { int y; }; } b; void g(); template <class T> class D { T t; }; };") == {
        "A": (1, 1), "A::B": (1, 1), "A::B::C": (0, 1), "A::D": (0, 1)}


def test_a_class_within_a_function_or_a_lambda_is_found():
    text = "void f() { struct Local { int a, b; }; } struct A { void g() { class Inner { void h(); }; } int x = [] { struct B { int c; }; return 1; }(); };"
    assert sizes(text) == {"Local": (0, 2), "A": (1, 1), "A::Inner": (1, 0), "A::B": (0, 1)}


def test_names_carry_their_namespace():
    text = """namespace a::b { namespace { class C final : public D<int, 3>, private E { int x; }; } struct Outer::Implementation { int y; }; }
    inline namespace v { template <> struct hash<std::vector<int>> { int z; }; } namespace alias = a::b; using namespace a; extern "C" { struct F { int a, b; }; }"""
    assert sizes(text) == {"a::b::C": (0, 1), "a::b::Outer::Implementation": (0, 1), "v::hash<std::vector<int>>": (0, 1), "F": (0, 2)}


def test_what_only_looks_like_a_class_is_none():
    text = "template <class T, class U = int> void f(struct tm value); enum class E { A }; struct tm g() { return {}; } class Forward; struct X* p;"
    assert sizes(text) == {}


def test_preprocessor_lines_and_further_branches_are_passed_over():
    assert size_of("#define MANY int a; \\\n int b;\n#if A\nint a;\n#elif B\nint a; int b;\n#else\n}\n#endif\n#if 0\n{\n#else\nint c;\n#endif") == (0, 2)


@pytest.mark.parametrize("text, line", [
    ("class C {\n int a;\n", 1),
    ("class C {\n int a; };\n}", 3),
    ("class C {\n int a\n};", 3),
    ("class C {\n A_MACRO_OF_ITS_OWN;\n};", 2),
])
def test_what_is_not_understood_is_told_with_its_line(text, line):
    with pytest.raises(Unreadable) as told:
        sizes(text)
    assert told.value.line == line


# The gate and its list.


def of(functions, members, name="a::C"):
    return class_sizes.ClassSize(name, 7, functions, members, "src/a/c.h")


def test_the_gate_is_40_functions_and_20_members():
    assert class_gate.complaints_about([of(40, 20)], {}) == []
    assert len(class_gate.complaints_about([of(41, 0)], {})) == 1
    assert class_gate.complaints_about([of(0, 21)], {}) == [
        "src/a/c.h:7: a::C has 0 functions and 21 data members; at most 40 and 20 are allowed: cut it"]


def test_a_listed_class_may_be_as_large_as_its_line_says_and_no_larger():
    assert class_gate.complaints_about([of(50, 10)], {"a::C": (50, 10)}) == []
    assert len(class_gate.complaints_about([of(51, 10)], {"a::C": (50, 10)})) == 1
    assert len(class_gate.complaints_about([of(50, 21)], {"a::C": (50, 10)})) == 1


@pytest.mark.parametrize("now, word", [
    ([of(49, 25)], "lower 50 25 to 49 25"),
    ([of(50, 24)], "lower 50 25 to 50 24"),
    ([of(30, 24)], "lower 50 25 to 30 24"),
    ([of(40, 20)], "is within the gate now (40 20): remove"),
    ([], "is gone: remove"),
    ([of(60, 30, "b::C")], "is gone: remove"),
])
def test_a_line_larger_than_its_class_is_an_error(now, word):
    assert any(word in complaint for complaint in class_gate.complaints_about(now, {"a::C": (50, 25)}))


def test_the_list_is_read_without_its_comments():
    assert class_gate.read_exceptions("# all\n\na::C 50 10  # why\nb::D::E 1 30\n") == {"a::C": (50, 10), "b::D::E": (1, 30)}


def make_tree(tmp_path, text, exceptions=""):
    (tmp_path / "src" / "a").mkdir(parents=True)
    (tmp_path / "src" / "a" / "c.cpp").write_text(text)
    (tmp_path / "scripts" / "lib").mkdir(parents=True)
    (tmp_path / "scripts" / "lib" / "large_classes.txt").write_text(exceptions)
    return tmp_path


def test_the_check_prints_the_largest_classes_and_passes_a_clean_tree(tmp_path):
    tree = make_tree(tmp_path, "namespace interpolated_motion::a { struct C { int x; void f(); }; struct D { int y, z; }; }")
    out = io.StringIO()
    assert class_gate.check(tree, out)
    assert out.getvalue().splitlines()[1:3] == ["        0       2  a::D  (src/a/c.cpp:1)", "        1       1  a::C  (src/a/c.cpp:1)"]


@pytest.mark.parametrize("text, exceptions", [
    ("struct C { int x" + ", x".join(map(str, range(21))) + "; };", ""),
    ("struct C { int x; };", "C 50 10\n"),
    ("struct C { int x; ", ""),
    ("", ""),
])
def test_the_check_fails_a_tree_with_a_large_class_a_stale_line_an_unreadable_file_or_nothing(tmp_path, text, exceptions):
    assert not class_gate.check(make_tree(tmp_path, text, exceptions), io.StringIO())


def test_scripts_lint_runs_it():
    result = subprocess.run([ROOT / "scripts" / "lint", "classes"], stdout=subprocess.PIPE, text=True)
    assert "functions members  class" in result.stdout
    assert result.returncode == 0, result.stdout
