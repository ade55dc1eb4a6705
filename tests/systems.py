"""Marks of tests that need what not every system of the CI has."""

from __future__ import annotations

import sys

import pytest

UNIX = pytest.mark.skipif(sys.platform == "win32", reason="a shell, a signal, a device or a name of Unix")
LINUX = pytest.mark.skipif(sys.platform != "linux", reason="a device, a limit or a shell as Linux has them")
