"""The package as a whole: its command, its documents, its notebooks."""

import ast
import json
import os
import re
from pathlib import Path

import pytest

import liouville as lv

HOME = Path(os.environ.get("LIOUVILLE_PYTHON", Path(__file__).parent.parent))
NOTEBOOKS = sorted((HOME / "notebooks").glob("*.ipynb"))
DOCUMENTS = [HOME / "README.md", HOME.parent / "docs" / "python.md", HOME.parent / "README.md"]


def test_the_command(command):
    assert command("--version").split() == ["liouville", lv.__version__]
    assert "0 against expectation" in command("check", "plane/balanced-ball", "-q")
    command("check", "no/such/case", code=2)


def test_the_catalogue_is_inside():
    names = lv.catalogue("plane/*")
    assert "plane/balanced-ball" in names and len(lv.catalogue()) > 800


def test_every_public_name_is_documented():
    for name in lv.__all__:
        if not name.startswith("__") and name != "CLASSES":
            assert getattr(lv, name).__doc__, name
    assert (Path(lv.__file__).parent / "py.typed").exists()


def run(code: str, names: dict) -> None:
    """Runs a cell, and shows its last value as a notebook does."""
    tree = ast.parse(code)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    if last:
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
        assert getattr(value, "_repr_html_", value.__repr__)()


def test_there_are_notebooks():
    assert len(NOTEBOOKS) == 2


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks(path):
    names: dict = {}
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            run("".join(cell["source"]), names)


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_documents(path):
    """Every block of Python runs after those before it."""
    blocks = re.findall(r"```python\n(.*?)```", path.read_text(encoding="utf-8"), re.DOTALL)
    assert blocks
    names: dict = {}
    for block in blocks:
        run(block, names)
