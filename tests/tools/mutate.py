# SPDX-License-Identifier: MIT
"""Whether the tests would notice: small changes of the source, each against the tests that reach it.

``python -m tests.tools.mutate --count 90`` from the root of the checkout. The first run learns which functions every
test calls (one run of the suite); later ones reuse that. Nothing of the checkout is changed: mutants live in copies.
A mutant is *killed* by a failing test, a crash, or a hang; *survivors* are a missing test or change nothing that can be
told, which ``mutants.toml`` then says under ``[[equivalent]]``.
"""

import argparse
import ast
import hashlib
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import tomllib
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path
from queue import Queue
from typing import Any

from tests.tools.mutants import ROOMS, Mutant, by_chance, by_hand

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).parent
DATA = HERE / "mutants.toml"
#: tests about how the code is written, not about what it does
_HOUSE = ("tests/test_contributing.py", "tests/test_packaging.py", "tests/test_ci.py")
_LEFT = shutil.ignore_patterns(
    ".git", ".venv", "__pycache__", "audit", ".hypothesis", "data", "*.log", ".*_cache", "dist", "node_modules"
)
#: where doctests lie
_DOCTESTS = "src"
#: tests that reach no room that is mutated, or everything at once and say nothing of its own: not learnt, never run
_LEFT_OUT = (
    *_HOUSE, "tests/mesh/", "tests/test_metamorphic_meshes.py", "tests/test_metamorphic_random.py",
    "tests/attacks/test_meshes.py", "tests/attacks/test_mesh_statements.py", "tests/attacks/test_sound_meshes.py",
)  # fmt: skip
_LONG = ("tests/attacks/", "tests/test_", "src")  #: learnt first, so that no worker waits for them in the end
_PATIENCE, _SLOWER = 20.0, 10.0  #: seconds that every test may take, and how much slower than without a mutant
_FIRST = 60  #: tests of the first step
_CONFIGURE = ""  #: the test that functions belong to which run before any test


@dataclass(slots=True)
class Reach:
    """Which tests call which functions, and how long they take."""

    called: dict[str, dict[str, list[str]]]  #: file, function, tests
    seconds: dict[str, float]  #: of every test that passes
    users: dict[str, set[str]] = field(default_factory=dict)  #: file, files that import it

    def of(self, mutant: Mutant) -> dict[str, float]:
        """Tests that may tell a mutant, in the order to run them, with the seconds each may take.

        First those that call the function; then their neighbours, which may share a cached result or a fixture. Files
        with quick tests come first.
        """
        functions = self.called.get(mutant.file, {})
        tests = set(functions.get(mutant.function, []))
        if not tests - {_CONFIGURE}:
            # Code outside of functions, and what runs when tests are collected: whoever uses the file.
            used = (mutant.file, *self.users.get(mutant.file, ()))
            tests = {test for file in used for group in self.called.get(file, {}).values() for test in group}
        files = {test.split("::")[0] for test in tests}
        order: dict[str, float] = {}
        groups = defaultdict(list)
        for test, spent in self.seconds.items():
            file = test.split("::")[0]
            if file in files:
                groups[(test not in tests, file)].append((spent, test))
        for _, group in sorted(groups.items(), key=lambda pair: (pair[0][0], sorted(pair[1])[len(pair[1]) // 2])):
            order |= {test: _PATIENCE + _SLOWER * spent for spent, test in sorted(group)}
        return order

    def forget(self, file: str) -> None:
        """Leave out the tests of a file."""
        gone = {test for test in self.seconds if test.split("::")[0] == file or _is_doctest(test, file)}
        self.seconds = {test: spent for test, spent in self.seconds.items() if test not in gone}
        for rows in self.called.values():
            for name, tests in rows.items():
                rows[name] = [test for test in tests if test not in gone]

    def add(self, seconds: Mapping[str, float], called: Mapping[str, Mapping[str, set[str]]]) -> None:
        """Take in the tests of a file."""
        self.seconds |= seconds
        for file, functions in called.items():
            rows = self.called.setdefault(file, {})
            for name, tests in functions.items():
                rows[name] = sorted({*rows.get(name, ()), *tests})

    def everything(self) -> dict[str, float]:
        """All tests."""
        return {test: _PATIENCE + _SLOWER * spent for test, spent in self.seconds.items()}


def _is_doctest(test: str, file: str) -> bool:
    return file == _DOCTESTS and test.startswith(f"{_DOCTESTS}/")


@dataclass(slots=True)
class Worker:
    """A copy of the tree and the process that runs tests over it."""

    tree: Path
    environment: dict[str, str] = field(default_factory=dict)
    process: Any = field(init=False)

    def __post_init__(self) -> None:
        shared = os.environ.get("FOPARQ_SHARED", str(ROOT.parent / "shared"))
        given = {"FOPARQ_SHARED": shared, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", **self.environment}
        self.process = subprocess.Popen(
            [sys.executable, str(HERE / "worker.py"), str(self.tree)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            text=True, env={**os.environ, **given}, cwd=self.tree,
        )  # fmt: skip

    def run(self, files: list[str], order: dict[str, float] | None, *, stop: bool) -> dict[str, Any]:
        """Result of the tests of some files: of those in ``order``, or of all."""
        self.process.stdin.write(json.dumps({"order": order, "files": files, "stop": stop}) + "\n")
        self.process.stdin.flush()
        found: dict[str, Any] = json.loads(self.process.stdout.readline())
        return found

    def try_out(self, mutant: Mutant, order: dict[str, float]) -> dict[str, Any]:
        """Result of tests over one mutant."""
        path = self.tree / "src" / "foparq" / mutant.file
        right, times = path.read_text(encoding="utf-8"), path.stat()
        try:
            path.write_text(mutant.applied(right), encoding="utf-8")
            return self.run(sorted({test.split("::")[0] for test in order}), order, stop=True)
        finally:
            path.write_text(right, encoding="utf-8")
            os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))

    def close(self) -> None:
        """End the process."""
        self.process.stdin.close()
        self.process.wait()


def copies(folder: Path, count: int) -> list[Path]:
    """Fresh copies of the tree."""
    made = []
    for number in range(count):
        tree = folder / f"tree-{number}"
        shutil.rmtree(tree, ignore_errors=True)
        shutil.copytree(ROOT, tree, ignore=_LEFT)
        made.append(tree)
    return made


def reach_of(trees: list[Path], folder: Path, *, fresh: bool) -> Reach:
    """What the tests reach, learnt once a folder; files of tests that are new or changed are learnt again.

    Every tree learns beside the others, one file of tests at a time; what is learnt is kept at once.
    """
    kept = folder / "reach.json"
    reach, known = Reach({}, {}), dict[str, str]()
    if kept.is_file() and not fresh:
        said = json.loads(kept.read_text(encoding="utf-8"))
        reach, known = Reach(said["called"], said["seconds"]), said["files"]
    now = {
        path.relative_to(trees[0]).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted((trees[0] / "tests").rglob("test_*.py"))
    } | {_DOCTESTS: ""}
    for file in sorted(set(known) - set(now)):
        reach.forget(file)
        del known[file]
    todo = [file for file in now if known.get(file) != now[file] and not file.startswith(_LEFT_OUT)]
    for number, (file, seconds, called) in enumerate(_learn(trees, folder, sorted(todo, key=_longest_first)), 1):
        reach.forget(file)
        reach.add(seconds, called)
        known[file] = now[file]
        said = {"called": reach.called, "seconds": reach.seconds, "files": known}
        kept.write_text(json.dumps(said), encoding="utf-8")
        print(f"learnt {number}/{len(todo)} {sum(seconds.values()):6.1f} s {file}", flush=True)
    return reach


def _longest_first(file: str) -> tuple[bool, str]:
    return not file.startswith(_LONG), file


def users_of(source: Path) -> dict[str, set[str]]:
    """Files that import each file, directly."""
    users: dict[str, set[str]] = defaultdict(set)
    for path in source.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("foparq."):
                named = "/".join((node.module or "").split(".")[1:])
                users[f"{named}.py"].add(path.relative_to(source).as_posix())
    return users


def _learn(
    trees: list[Path], folder: Path, files: list[str]
) -> Iterator[tuple[str, dict[str, float], dict[str, dict[str, set[str]]]]]:
    """Every file, the seconds of its tests, and which functions each calls."""
    free: Queue[Path] = Queue()
    for tree in trees:
        free.put(tree)

    def one(file: str) -> tuple[str, dict[str, float], dict[str, dict[str, set[str]]]]:
        tree = free.get()
        try:
            return file, *_learn_one(tree, folder / f"{tree.name}.pipe", file)
        finally:
            free.put(tree)

    with ThreadPoolExecutor(len(trees)) as pool:
        for task in as_completed([pool.submit(one, file) for file in files]):
            yield task.result()


def _learn_one(tree: Path, pipe: Path, file: str) -> tuple[dict[str, float], dict[str, dict[str, set[str]]]]:
    """Seconds of the tests of one file, and which functions each calls."""
    pipe.unlink(missing_ok=True)
    os.mkfifo(pipe)
    called: dict[str, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
    end = os.open(pipe, os.O_RDWR)
    listener = threading.Thread(target=_listen, args=(end, called))
    listener.start()
    trace = str(HERE / "trace")
    worker = Worker(tree, {"FOPARQ_REACH": str(pipe), "FOPARQ_TRACE": trace, "PYTHONPATH": trace})
    run = worker.run([file], None, stop=False)
    worker.close()
    os.write(end, b"\n")
    listener.join()
    if run["failed"]:
        print(f"these tests fail without any mutant and are left out: {run['failed']}", flush=True)
    return {test: spent for test, spent in run["passed"].items() if test not in run["failed"]}, called


def _listen(end: int, called: Mapping[str, Mapping[str, set[str]]]) -> None:
    with os.fdopen(end, "rb", closefd=True) as stream:
        for line in stream:
            if line == b"\n":
                return
            file, name, test = line.decode().rstrip("\n").split("\x1f")
            called[file][name.split(".<locals>")[0]].add(test.rpartition(" (")[0])


def outcome(found: Mapping[str, Any]) -> str:
    """``killed``, ``hung``, ``survived`` or ``unreached``."""
    if found["code"] == -14:
        return "hung"
    return {0: "survived", 5: "unreached"}.get(found["code"], "killed")


def _line(mutant: Mutant, row: Mapping[str, Any]) -> str:
    change = f"{mutant.file}: {mutant.old!r} -> {mutant.new!r}"
    return f"{row['outcome']:9} {row['seconds']:6.1f} s of {row['tests']:4} tests {change} {''.join(row['by'])}"


def rows_of(path: Path) -> dict[str, dict[str, Any]]:
    """Results of former runs by key."""
    if not path.is_file():
        return {}
    rows = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    return {row["key"]: row for row in rows}


def told_equivalent(mutants: Iterable[Mutant], text: Mapping[str, str]) -> dict[str, str]:
    """Why some mutants change nothing that can be told, by key."""
    rows = tomllib.loads(DATA.read_text(encoding="utf-8")).get("equivalent", [])
    told = {}
    for mutant in mutants:
        before = text[mutant.file].count("\n", 0, mutant.start)
        line = mutant.applied(text[mutant.file]).splitlines()[before].strip()
        why = [row["why"] for row in rows if row["file"] == mutant.file and row["mutant"].strip() == line]
        if why or mutant.equivalent:
            told[mutant.key] = mutant.equivalent or why[0]
    return told


def table(
    mutants: Iterable[Mutant],
    text: Mapping[str, str],
    results: Mapping[str, Mapping[str, Any]],
    told: Mapping[str, str],
) -> str:
    """Counts a room, and every survivor with its change."""
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    survivors = []
    for mutant in mutants:
        if mutant.key not in results:
            continue
        status = results[mutant.key]["outcome"]
        if status not in {"killed", "hung"}:
            status = "equivalent" if mutant.key in told else status
            said = told.get(mutant.key) or mutant.why
            survivors.append(
                f"{status} {mutant.key} {mutant.function or '(module)'}: {said}\n{mutant.diff(text[mutant.file])}"
            )
        counts[mutant.room][status] += 1
    heads = ("killed", "hung", "survived", "unreached", "equivalent")
    lines = ["| room | mutants | " + " | ".join(heads) + " |", "|---" * (len(heads) + 2) + "|"]
    total: Counter[str] = Counter()
    for room in ROOMS:
        if room in counts:
            lines.append(f"| {room} | {counts[room].total()} | {' | '.join(str(counts[room][h]) for h in heads)} |")
            total += counts[room]
    lines.append(f"| all | {total.total()} | {' | '.join(str(total[head]) for head in heads)} |")
    dead = total["killed"] + total["hung"]
    lines.append(f"\n{dead} of {total.total()} killed: {100 * dead / max(1, total.total()):.1f} %")
    return "\n".join(lines) + "\n\n" + "\n\n".join(survivors)


def _in_steps(order: dict[str, float], budget: float) -> Iterator[dict[str, float]]:
    """A few quick tests, which tell most mutants, and the others: fewer files of tests are imported for nothing."""
    tests = list(order)
    spent, rest = 0.0, []
    for test in tests[_FIRST:]:
        spent += (order[test] - _PATIENCE) / _SLOWER
        if spent <= budget:
            rest.append(test)
    for part in (tests[:_FIRST], rest):
        if part:
            yield {test: order[test] for test in part}


def work(
    mutants: Iterable[Mutant], workers: list[Worker], reach: Reach, *, whole: bool, budget: float
) -> Iterator[tuple[Mutant, dict[str, Any]]]:
    """Results as they come."""
    free: Queue[Worker] = Queue()
    for worker in workers:
        free.put(worker)

    def one(mutant: Mutant) -> tuple[Mutant, dict[str, Any]]:
        worker = free.get()
        try:
            order = reach.of(mutant)
            found = {"code": 5, "failed": [], "passed": {}, "seconds": 0.0}
            for some in _in_steps(order, budget):
                spent = found["seconds"]
                found = worker.try_out(mutant, some)
                found["seconds"] += spent
                if outcome(found) != "survived":
                    break
            if whole and outcome(found) in {"survived", "unreached"}:
                found = worker.try_out(mutant, reach.everything())
        finally:
            free.put(worker)
        return mutant, {
            "key": mutant.key, "outcome": outcome(found), "by": found["failed"][:1], "tests": len(order),
            "seconds": round(found["seconds"], 1), "code": found["code"], "file": mutant.file,
        }  # fmt: skip

    with ThreadPoolExecutor(len(workers)) as pool:
        yield from pool.map(one, mutants)


def main() -> None:
    """Make mutants, run tests over them, print the table."""
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("--count", type=int, default=90, help="random mutants")
    ask.add_argument("--seed", type=int, default=1)
    ask.add_argument("--no-hand", action="store_true", help="leave out those of mutants.toml")
    ask.add_argument("--only", default="", help="only files whose name contains this")
    ask.add_argument("--resume", action="store_true", help="keep former results; only what is new or survived is run")
    ask.add_argument("--keep-survivors", action="store_true", help="with --resume: run no survivors again")
    ask.add_argument(
        "--whole", action="store_true", help="run the whole suite over what survives the tests that reach it"
    )
    ask.add_argument("--budget", type=float, default=math.inf, help="seconds of tests beyond the first few, a mutant")
    ask.add_argument("--fresh", action="store_true", help="learn anew what the tests reach")
    ask.add_argument("--workers", type=int, default=2)
    ask.add_argument("--folder", type=Path, default=Path(tempfile.gettempdir()) / "foparq-mutation")
    given = ask.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    trees = copies(given.folder, given.workers)
    reach = reach_of(trees, given.folder, fresh=given.fresh)
    workers = [Worker(tree) for tree in trees]
    # The checkout may change meanwhile; the copies do not.
    source = workers[0].tree / "src" / "foparq"
    reach.users = users_of(source)
    made, stale = by_hand(DATA, source)
    made = ([] if given.no_hand else made) + by_chance(source, given.count, given.seed)
    made = [mutant for mutant in made if given.only in mutant.file]
    text = {mutant.file: (source / mutant.file).read_text(encoding="utf-8") for mutant in made}
    kept = given.folder / "results.jsonl"
    results = rows_of(kept) if given.resume else {}
    done = {key for key, row in results.items() if given.keep_survivors or row["outcome"] in {"killed", "hung"}}
    told = told_equivalent(made, text)
    todo = [
        mutant
        for mutant in made
        if mutant.key not in done and not (given.resume and mutant.key in told and mutant.key in results)
    ]
    with kept.open("a" if given.resume else "w", encoding="utf-8") as stream:
        for number, (mutant, row) in enumerate(work(todo, workers, reach, whole=given.whole, budget=given.budget), 1):
            results[mutant.key] = row
            stream.write(json.dumps(row) + "\n")
            stream.flush()
            print(f"{number}/{len(todo)} {_line(mutant, row)}", flush=True)
    for worker in workers:
        worker.close()
    print("\n" + table(made, text, results, told))
    for line in stale:
        print(f"stale: {line}")


if __name__ == "__main__":
    main()
