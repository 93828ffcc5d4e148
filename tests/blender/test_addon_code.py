# SPDX-License-Identifier: Apache-2.0
"""How the add-on and the package throng_io are written: imports go one way, between files and between folders,
functions are simple, lines short. They are parsed, not run."""
import ast
import functools
import graphlib
import pathlib

import pytest

from conftest import ROOT

ADDON = ROOT / "blender_addon" / "throng"
TESTS = ROOT / "tests" / "blender"
PACKAGE, ITS_TESTS = ROOT / "python" / "src" / "throng_io", ROOT / "tests" / "python"
MOST_COMPLEX, LONGEST = 15, 120
# (file, module) of imports inside functions, and why they are there.
INNER_IMPORTS = {("blender/builds.py", "_cycles"): "a Blender may be built without Cycles"}
# Files whose lines are still to be wrapped.
LONG_LINES = {"authoring/codecs.py", "authoring/fields.py"}
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)


@functools.cache
def sources(root):
    """{path from the root: tree} of all files."""
    return {path.relative_to(root).as_posix(): ast.parse(path.read_text(encoding="utf-8"))
            for path in sorted(root.rglob("*.py"))}


def walk(tree, inside=False):
    """(node, whether it is inside a function) of everything."""
    for child in ast.iter_child_nodes(tree):
        yield child, inside
        yield from walk(child, inside or isinstance(child, FUNCTIONS))


def import_statements(tree):
    return [(node, inside) for node, inside in walk(tree) if isinstance(node, (ast.Import, ast.ImportFrom))]


def targets(node, file, name):
    """Dotted names, from the root, of what a statement in a file of a package imports; of its own only."""
    if isinstance(node, ast.Import):
        found = [alias.name.split(".") for alias in node.names]
    elif node.level == 0:
        found = [node.module.split(".") + [alias.name] for alias in node.names]
    else:
        folder = [name, *pathlib.PurePosixPath(file).parent.parts]
        base = folder[:len(folder) + 1 - node.level] + (node.module.split(".") if node.module else [])
        found = [base + [alias.name] for alias in node.names]
    return [parts[1:] for parts in found if parts[0] == name]


def file_of(parts, files):
    """The file that a dotted name is, or is in."""
    for many in (len(parts), len(parts) - 1):
        for file in ("/".join(parts[:many]) + ".py", "/".join([*parts[:many], "__init__.py"])):
            if file in files:
                return file
    raise AssertionError(f"{'.'.join(parts)} is imported, and not there")


def import_graph(files, name):
    """{file: the files that it imports}, wherever in it."""
    return {file: {file_of(parts, files) for node, _ in import_statements(tree) for parts in targets(node, file, name)}
            for file, tree in files.items()}


def folder_graph(graph):
    """{folder: the other folders that its files import from}."""
    folders = {}
    for file, imported in graph.items():
        folder = str(pathlib.PurePosixPath(file).parent)
        others = {str(pathlib.PurePosixPath(each).parent) for each in imported}
        folders.setdefault(folder, set()).update(others - {folder})
    return folders


def circle(graph):
    """Names that import each other in turn, or nothing."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return error.args[1]
    return []


def inner_imports(files):
    """{(file, module)} of the imports inside functions."""
    return {(file, alias.name if isinstance(node, ast.Import) else node.module or alias.name)
            for file, tree in files.items() for node, inside in import_statements(tree) if inside
            for alias in node.names}


def complexity(node):
    """Ways through a function: one, and one for each branch, loop, condition, handler and assertion."""
    if isinstance(node, ast.Assert):
        return 1
    own = 0
    if isinstance(node, (ast.If, ast.IfExp)):
        own = 1
    elif isinstance(node, (ast.For, ast.AsyncFor, ast.While)):
        own = 1 + bool(node.orelse)
    elif isinstance(node, ast.comprehension):
        own = 1 + len(node.ifs)
    elif isinstance(node, ast.BoolOp):
        own = len(node.values) - 1
    elif isinstance(node, ast.Try):
        own = len(node.handlers) + bool(node.orelse)
    return own + sum(complexity(child) for child in ast.iter_child_nodes(node))


def too_complex(files):
    return [(file, node.name, 1 + complexity(node)) for file, tree in files.items() for node in ast.walk(tree)
            if isinstance(node, FUNCTIONS[:2]) and 1 + complexity(node) > MOST_COMPLEX]


def too_long(root):
    return [(path.relative_to(root).as_posix(), number) for path in sorted(root.rglob("*.py"))
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1) if len(line) > LONGEST]


@pytest.mark.parametrize("root", [ADDON, PACKAGE], ids=["addon", "package"])
def test_no_files_import_each_other(root):
    assert not circle(import_graph(sources(root), root.name))


@pytest.mark.parametrize("root", [ADDON, PACKAGE], ids=["addon", "package"])
def test_imports_between_folders_go_one_way(root):
    assert not circle(folder_graph(import_graph(sources(root), root.name)))


def test_imports_are_at_the_top_of_files():
    assert inner_imports(sources(ADDON)) == set(INNER_IMPORTS)
    assert inner_imports(sources(PACKAGE)) == set()


ALL = pytest.mark.parametrize("root", [ADDON, TESTS, PACKAGE, ITS_TESTS],
                              ids=["addon", "tests", "package", "its tests"])


@ALL
def test_functions_are_simple(root):
    assert too_complex(sources(root)) == []


@ALL
def test_lines_are_short(root):
    assert [(file, number) for file, number in too_long(root) if file not in LONG_LINES] == []


def test_what_is_wrong_is_found(tmp_path):
    """A package that does everything wrong: two circles, one of them hidden in functions."""
    root = tmp_path / "wrong"
    for file, text in {"__init__.py": "from .low import a\n",
                       "low/__init__.py": "",
                       "low/a.py": "from . import b\n\n\ndef f():\n    from ..high.c import g\n\n    g()\n",
                       "low/b.py": "def f():\n    import wrong.low.a\n",
                       "high/__init__.py": "",
                       "high/c.py": "from ..low import d\n\n\ndef g(x):\n" + "    if x and x:\n        x += 1\n" * 8,
                       "low/d.py": f"x = {'1' * LONGEST}\n"}.items():
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        (root / file).write_text(text)
    files = sources(root)
    graph = import_graph(files, "wrong")
    assert graph["high/c.py"] == {"low/d.py"} and graph["low/a.py"] == {"low/b.py", "high/c.py"}
    assert set(circle(graph)) == {"low/a.py", "low/b.py"} and set(circle(folder_graph(graph))) == {"low", "high"}
    assert inner_imports(files) == {("low/a.py", "high.c"), ("low/b.py", "wrong.low.a")}
    assert too_complex(files) == [("high/c.py", "g", 17)] and too_long(root) == [("low/d.py", 1)]
    (root / "high" / "c.py").write_text("from ..low import away\n")
    with pytest.raises(AssertionError, match="away"):
        import_graph({**files, "high/c.py": ast.parse("import wrong.away.there\n")}, "wrong")
