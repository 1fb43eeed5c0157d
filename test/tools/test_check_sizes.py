#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/check_sizes on small made-up trees: what is too long is found, with its first line, nothing else."""

import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "check_sizes"
MAX_FILE, MAX_FUNCTION = 300, 60


def long(text, lines, filler="  f();\n"):
    """Returns `text` with as many fillers in place of its line ... that it has this many lines."""
    head, tail = text.split("...\n")
    return head + (lines - head.count("\n") - tail.count("\n")) * filler + tail


class Case(unittest.TestCase):
    def run_on(self, files):
        """files: {path: text}. Returns exit code and lines of output."""
        with tempfile.TemporaryDirectory() as folder:
            for path, text in files.items():
                file = Path(folder, path)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text)
            done = subprocess.run([str(SCRIPT), folder], stdout=subprocess.PIPE, check=False)
            return done.returncode, done.stdout.decode().splitlines()

    def assert_accepted(self, path, text):
        self.assertEqual(self.run_on({path: text}), (0, ["check_sizes: 0 violations in 1 files"]))

    def assert_found(self, path, text, *violations):
        count = f"check_sizes: {len(violations)} violations in 1 files"
        self.assertEqual(self.run_on({path: text}), (1, [*(f"{path}:{each}" for each in violations), count]))

    def assert_limited(self, path, text, name, before="", after=""):
        """A function `text` may have 60 lines, but not 61; before, after: the rest of the file."""
        filler = "  f();\n" if path.endswith((".cpp", ".h")) else "        f\n"
        self.assert_accepted(path, before + long(text, MAX_FUNCTION, filler) + after)
        self.assert_found(path, before + long(text, MAX_FUNCTION + 1, filler) + after,
                          f"{before.count(chr(10)) + 1}: {name} has 61 lines, limit 60")  # fmt: skip


class Files(Case):
    def test_a_file_may_have_300_lines(self):
        for path in ("src/a.cpp", "include/a.h", "tools/a.py", "cmake/a.cmake", "CMakeLists.txt", "scripts/a.sh"):
            filler = "#\n" if path.endswith(("py", "cmake", "txt", "sh")) else "\n"
            self.assert_accepted(path, filler * MAX_FILE)
            self.assert_found(path, filler * (MAX_FILE + 1), "301: the file has 301 lines, limit 300")

    def test_programs_are_known_by_their_first_line(self):
        for program in ("/usr/bin/python3", "/usr/bin/env bash", "/bin/sh"):
            self.assert_found("scripts/a", f"#!{program}\n" + "#\n" * MAX_FILE, "301: the file has 301 lines, limit 300")

    def test_documents_and_data_are_not_checked(self):
        code, lines = self.run_on({"src/a.cpp": "", "tools/b": "#!/usr/bin/awk -f\n" + "\n" * 400, **dict.fromkeys(
            ("scripts/packages.txt", "test/a.md", "doc/a.py", "tools/a", "test/a.yaml", "build/a.cpp"), "\n" * 400)})  # fmt: skip
        self.assertEqual((code, lines), (0, ["check_sizes: 0 violations in 1 files"]))

    def test_a_tree_without_sources_is_no_success(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([str(SCRIPT), folder], stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"no sources in {folder}", done.stderr.decode())


class OtherLanguages(Case):
    def test_python(self):
        self.assert_limited("tools/a.py", "def a():\n...\n", "a", "import b\n\n")
        self.assert_limited("tools/a.py", "    async def a(self,\n          b):\n...\n", "a", "class C:\n", "X = 1\n")
        self.assert_accepted("tools/a.py", "class C:\n" + "    X = 1\n" * 100)
        self.assert_found("tools/a.py", "def a(:\n", "1: cannot find the functions: invalid syntax")

    def test_bash(self):
        self.assert_limited("scripts/a.sh", "a() {\n...\n}\n", "a", "b() { c; }\n", "d\n" * 70)
        self.assert_limited("scripts/a.sh", "  a() (\n...\n  )\n", "a", "{\n", "}\n")
        self.assert_found("scripts/a.sh", "\na() {\n", "2: cannot find the functions: a without its end")

    def test_cmake(self):
        self.assert_limited("cmake/a.cmake", "function(a b)\n...\nendfunction()\n", "a", "c()\n", "d()\n" * 70)
        self.assert_limited("test/CMakeLists.txt", "macro(a)\n...\nendmacro()\n", "a")


class Cpp(Case):
    def limited(self, text, name, before="", after=""):
        self.assert_limited("src/a.cpp", text, name, before, after)

    def test_functions_in_namespaces_and_types(self):
        self.limited("int a(int b = g({1}),\n      int c = 2) {\n...\n}\n", "a", "namespace n {\n\n", "}  // namespace n\n")
        self.limited("  void a() const override {\n...\n  }\n", "a",
                     'extern "C" {\nclass E C : public D {\n  C() = default;\n\n public:\n', " private:\n  int x_{0};\n};\n}\n")  # fmt: skip
        self.limited("C::~C() noexcept {\n...\n}\n", "C::~C")
        self.limited("static struct A a(struct B b) {\n...\n}\n", "a")
        self.limited("auto a() -> std::vector<int> {\n...\n}\n", "a")

    def test_templates(self):
        self.limited("template <class T, class = std::enable_if_t<(sizeof(T) > 1)>>\nT a(T b) {\n...\n}\n", "a")
        self.limited("template <>\nstruct A<int>::B a() {\n...\n}\n", "a", "template <class T>\nstruct C {\n};\n")

    def test_operators(self):
        self.limited("bool C::operator()(int b) const {\n...\n}\n", "C::operator()")
        self.limited("bool operator==(const C& a, const C& b) {\n...\n}\n", "operator==")

    def test_constructors_with_initializers(self):
        self.limited("A::A(int b)\n    : B<int>{b}, c_{b}, d_(e([] { return 1; })) {\n...\n}\n", "A::A")
        self.limited("A::A(int b) : c_{b} {\n...\n}\n", "A::A")

    def test_lambdas_and_tests_of_macros(self):
        self.limited("const auto a = [](int b) {\n...\n};\n", "a")
        self.limited("TEST(Suite, Name) {\n...\n}\n", "TEST(Suite, Name)", "namespace {\nint x;\n}\n")

    def test_what_hides_braces(self):
        hidden = ("// {\n", "/* {\n{ */\n", 'x = "{\\"{";\n', "x = '{' + '\\'' + '{';\n", 'x = R"({\n" ) {)";\n', "#define X {\n",
                  "#define X \\\n  {\n", 'x = R"a({)")a";\n', "x = 1'000 + f('{');\n")  # fmt: skip
        for each in hidden:
            self.limited(f"void a() {{\n{each}...\n}}\n", "a", "int x;\n" + each.replace("x =", "int x ="), "void b() {}\n")

    def test_what_is_no_function(self):
        for begin in ("namespace n {", "class C final : public D<int> {", "enum class E : int {", "const int x[] = {", "S x{",
                      "std::vector<int> x({", "struct alignas(8) S {", "union U {", "template <class T>\nstruct S {"):  # fmt: skip
            self.assert_accepted("src/a.cpp", f"{begin}\n" + "\n" * 100 + ("});\n" if "(" in begin[-2:] else "};\n"))

    def test_braces_that_do_not_match(self):
        self.assert_found("src/a.cpp", "\nvoid a() {\n", "2: cannot find the functions: { without its }")
        self.assert_found("src/a.cpp", "namespace n {\nint x;\n", "1: cannot find the functions: { without its }")
        self.assert_found("src/a.cpp", "int x;\n}\n", "2: cannot find the functions: } without its {")


if __name__ == "__main__":
    unittest.main()
