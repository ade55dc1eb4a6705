"""The examples in docstrings give what they say."""

import doctest
import math
import re
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
MODULES = [
    path.relative_to(ROOT).with_suffix("").as_posix().replace("/", ".").removesuffix(".__init__")
    for top in ("core", "cli")
    for path in sorted((ROOT / top).rglob("*.py"))
    if ">>> " in path.read_text(encoding="utf-8")
]


_NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.\d*(?:e[-+]?\d+)?(?![\w.])")


class _Rounding(doctest.OutputChecker):
    """Takes numbers with a point for equal within 1e-13 of their magnitude: another processor rounds otherwise."""

    def check_output(self, want: str, got: str, optionflags: int) -> bool:
        if super().check_output(want, got, optionflags):
            return True
        if not super().check_output(_NUMBER.sub("#", want), _NUMBER.sub("#", got), optionflags):
            return False
        pairs = zip(map(float, _NUMBER.findall(want)), map(float, _NUMBER.findall(got)), strict=True)
        return all(math.isclose(one, other, rel_tol=1e-13, abs_tol=1e-15) for one, other in pairs)


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_docstrings(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # Each docstring's debugger looks at the times of all files that were ever quoted: half of the time.
    monkeypatch.setattr("linecache.checkcache", lambda _=None: None)
    module = import_module(f"gearlink.{name}")
    runner = doctest.DocTestRunner(checker=_Rounding())
    for example in doctest.DocTestFinder().find(module, module.__name__):
        runner.run(example)
    assert runner.tries > 0
    assert runner.failures == 0


def test_rounding_is_no_difference_and_more_is() -> None:
    same = _Rounding().check_output
    assert same("(1.0, 3.0)\n", "(1.0, 2.9999999999999996)\n", 0)
    assert not same("(1.0, 3.0)\n", "(1.0, 3.000000000001)\n", 0)
    assert not same("(1.0, 3.0)\n", "[1.0, 3.0]\n", 0)
    assert not same("3\n", "4\n", 0)
