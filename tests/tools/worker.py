# SPDX-License-Identifier: MIT
"""Runs tests over a copied tree, each time in a fork of a process that has the heavy libraries already.

``worker.py TREE`` answers jobs, one JSON object a line. It knows nothing of foparq: only its forks import that.
"""

import contextlib
import importlib
import json
import os
import resource
import signal
import sys
import time
from pathlib import Path
from typing import Any

import pytest

#: imported once; pytest's plugins are not among them, as their assertions are rewritten on import
_HEAVY = (
    "numpy", "scipy.special", "scipy.spatial", "scipy.sparse.csgraph", "shapely", "ezdxf", "ezdxf.recover", "pyogrio",
    "pyproj", "lxml.etree", "jinja2", "pydantic", "click", "rich.console", "jsonschema",
)  # fmt: skip
_MEMORY = 8_000_000_000  #: bytes that a mutant may use


class Selected:
    """Plugin: runs the chosen tests in the chosen order, each within its time, and tells how it went."""

    def __init__(self, order: dict[str, float] | None, say: int) -> None:
        self.order, self.say, self.spent = order, say, dict[str, float]()
        self._rank = {test: rank for rank, test in enumerate(order or {})}

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        if self.order is not None:
            items[:] = sorted((i for i in items if i.nodeid in self._rank), key=lambda item: self._rank[item.nodeid])

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        if resume := getattr(sys.modules.get("sitecustomize"), "resume", None):
            resume()
        # The default action of the signal ends the process wherever it hangs.
        signal.setitimer(signal.ITIMER_REAL, (self.order or {}).get(nodeid, 600.0))

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.spent[report.nodeid] = self.spent.get(report.nodeid, 0.0) + report.duration
        if report.failed:
            self._tell(failed=report.nodeid)
        elif report.when == "teardown":
            self._tell(passed=report.nodeid, seconds=self.spent[report.nodeid])

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed:
            self._tell(failed=f"{report.nodeid} (collection)")

    def _tell(self, **said: object) -> None:
        os.write(self.say, json.dumps(said).encode() + b"\n")


def run(tree: Path, job: dict[str, Any], say: int) -> int:
    """Exit code of pytest over the tests of a job."""
    os.chdir(tree)
    sys.path.insert(0, str(tree / "src"))
    os.environ["PYTHONPATH"] = os.pathsep.join([str(tree / "src"), os.environ.get("FOPARQ_TRACE", "")]).rstrip(":")
    options = ["-q", "-p", "no:cacheprovider", "--hypothesis-seed=0", "-m", "not browser"]
    options += [
        f"--deselect=tests/test_house.py::test_{tool}" for tool in ("floors", "strict_typing", "lint", "format")
    ]
    options += ["-x"] if job["stop"] else []
    return int(pytest.main([*options, *job["files"]], plugins=[Selected(job["order"], say)]))


def answer(tree: Path, job: dict[str, Any], log: Path) -> dict[str, Any]:
    """How a fork fared with a job."""
    out, into = os.pipe()
    child = os.fork()
    if child == 0:
        code = 99
        try:
            os.setsid()
            os.close(out)
            nothing, words = os.open(os.devnull, os.O_RDONLY), os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            for target, source in ((0, nothing), (1, words), (2, words)):
                os.dup2(source, target)
            resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, resource.RLIM_INFINITY))
            signal.setitimer(signal.ITIMER_REAL, 90.0)
            code = run(tree, job, into)
        finally:
            os._exit(code)
    os.close(into)
    began, said = time.monotonic(), b""
    while piece := os.read(out, 1 << 16):
        said += piece
    os.close(out)
    _, status = os.waitpid(child, 0)
    with contextlib.suppress(ProcessLookupError):
        # Whatever the tests started and left behind.
        os.killpg(child, signal.SIGKILL)
    rows = [json.loads(line) for line in said.splitlines()]
    return {
        "code": os.waitstatus_to_exitcode(status),
        "failed": [row["failed"] for row in rows if "failed" in row],
        "passed": {row["passed"]: row["seconds"] for row in rows if "passed" in row},
        "seconds": time.monotonic() - began,
    }


def main() -> None:
    """Answer jobs until there are no more."""
    tree = Path(sys.argv[1])
    os.nice(5)
    for name in _HEAVY:
        importlib.import_module(name)
    sys.dont_write_bytecode = True
    for line in sys.stdin:
        job = json.loads(line)
        print(json.dumps(answer(tree, job, tree.parent / f"{tree.name}.log")), flush=True)


if __name__ == "__main__":
    main()
