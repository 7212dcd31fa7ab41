# SPDX-License-Identifier: MIT
"""Tests that are known to fail, with the line that is the reason: ``open.toml``."""

import tomllib
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import pytest

OPEN = tomllib.loads(Path(__file__).with_name("open.toml").read_text("utf-8"))["open"]


def marks(name: str) -> list[Any]:
    """What is known to fail must fail: once it does not, its line in ``open.toml`` goes."""
    reasons = [one["because"] for one in OPEN for pattern in one["tests"] if fnmatchcase(name, pattern)]
    return [pytest.mark.xfail(reason=reasons[0], strict=True)] if reasons else []
