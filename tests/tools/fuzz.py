# SPDX-License-Identifier: MIT
"""Whether mildly damaged deliveries are handled: seeded changes of small sound ones, each audited and looked at.

``python -m tests.tools.fuzz --count 20000`` from the root of the checkout. Every case has a number and is the same in
every run. With ``--out`` a line of JSON is kept of each, and cases that are there already are not run again. One that
went wrong is written for a closer look by ``--start N --count 1 --keep FOLDER``.

Whatever was changed, foparq ends with an answer or an error of its own, crashes nowhere, writes nothing beside its
input, says the same twice, and concludes nothing clean from what it did not see.
"""

import argparse
import contextlib
import io
import json
import os
import resource
import signal
import sys
import tempfile
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from functools import cache
from pathlib import Path
from typing import Any
from unittest import mock

import jsonschema
import numpy as np
from lxml import etree
from tests.tools.fuzz_edits import Files, Rng, chance, mutant, pick
from tests.tools.fuzz_seeds import KINDS, Seed, seeds

from foparq.audit import Audit, audit, check_files
from foparq.cli.main import run
from foparq.cli.show import show
from foparq.errors import FoparqError, InputError, UsageError, WriteError
from foparq.evaluate.exit_of import exit_of
from foparq.evaluate.quality import Verdict
from foparq.exits import exit_of_error
from foparq.findings.because import Because
from foparq.findings.outcome import Status
from foparq.model.delivery import LOST
from foparq.model.drawing import SkippedReason
from foparq.profile.load import load_profile
from foparq.report.words import LANGUAGES, Words
from foparq.resources import shipped

SEED = 20_260
#: every how many cases of a kind one is audited by the command, twice, with all reports
FULL = 40
#: exit codes that say something about the input
ANSWERS = frozenset({0, 1, 2, 3, 4})
_MEMORY = 4_000_000_000  #: bytes of a process that runs cases
_SECONDS = 60  #: of the processor, for one case
_CHUNK = 100  #: cases of one process
_FORMS = ("text", "concise", "json", "jsonl", "csv")


@dataclass(slots=True)
class Result:
    """How one case went."""

    case: int
    kind: str
    seed: str
    edits: list[str]
    full: bool
    exit: int = -1
    read: bool = False  #: a drawing was taken in
    reached: bool = False  #: a rule looked at items
    said: str = ""  #: what was refused, and why
    wrong: list[str] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Case:
    """One input and how it is audited."""

    seed: Seed
    files: Files
    plane: str | None
    unit: str | None
    form: str
    language: str

    @property
    def areas(self) -> tuple[str, ...]:
        """Patterns of layers that bound areas; one that no drawing has would be a finding."""
        return ("pisos",) if self.seed.main == "a.gpkg" else ()

    def write(self, folder: Path) -> Path:
        """The file or folder to audit."""
        for name, data in self.files.items():
            (folder / name).write_bytes(data)
        return folder / self.seed.main if self.seed.command == "check" else folder


def made(number: int, base: int = SEED) -> tuple[Case, Result]:
    """A case, and a result that is yet to be filled in."""
    rng = np.random.default_rng([base, number])
    kind = KINDS[number % len(KINDS)]
    seed = pick(rng, seeds(kind))
    files, edits = mutant(kind, seed, rng)
    case = Case(seed, files, *_asked(rng))
    return case, Result(number, kind, seed.name, edits, full=number // len(KINDS) % FULL == 0)


def _asked(rng: Rng) -> tuple[str | None, str | None, str, str]:
    plane = "xy" if chance(rng, 0.8) else pick(rng, (None, "xz", "fit"))
    unit = "m" if chance(rng, 0.8) else pick(rng, (None, "cm"))
    return plane, unit, pick(rng, _FORMS), pick(rng, LANGUAGES)


def outcome(number: int, base: int = SEED, keep: Path | None = None) -> Result:
    """Run one case."""
    case, result = made(number, base)
    look = by_command if result.full else in_process
    with tempfile.TemporaryDirectory(prefix="fuzz-") as name:
        folder = keep or Path(name) / "entrega"
        folder.mkdir(parents=True, exist_ok=True)
        place = case.write(folder)
        before = contents(folder)
        try:
            look(case, place, Path(name) / "out", result)
        except Exception:  # noqa: BLE001 - whatever reaches the caller is what is looked for
            result.wrong.append(traceback.format_exc())
        if contents(folder) != before:
            result.wrong.append("something was written beside the input")
    return result


def contents(folder: Path) -> dict[str, bytes]:
    """Every file below a folder."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


# --- in this process, without bounds ----------------------------------------------------------------------------------


def _called(function: Callable[..., Any], *args: Any, **_: Any) -> Any:
    """As a child process would answer: what is no error of foparq's own is a crash."""
    try:
        return function(*args)
    except FoparqError:
        raise
    except Exception:  # noqa: BLE001 - as above
        raise RuntimeError(traceback.format_exc()) from None


def _streamed(function: Callable[..., Iterator[object]], args: tuple[Any, ...], **_: Any) -> Iterator[object]:
    return function(*args)


@contextlib.contextmanager
def unguarded() -> Iterator[None]:
    """Reading and checking in this process: child processes cost more than small drawings."""
    with (
        mock.patch("foparq.read.delivery.guarded", _called),
        mock.patch("foparq.bounded.streamed", _streamed),
        warnings.catch_warnings(),
    ):
        warnings.simplefilter("ignore")
        yield


@cache
def _profile() -> Any:
    return load_profile("et-doc-foparq-a", Path())


def in_process(case: Case, place: Path, _out: Path, result: Result) -> None:
    """Audit within this process, and show what was found."""
    words = Words(case.language)
    try:
        with unguarded():
            if case.seed.command == "audit":
                done = audit(place, language=case.language)
            else:
                done = check_files(
                    [place], profile=_profile(), scale=50.0, unit=case.unit, plane=case.plane, areas=case.areas,
                    language=case.language,
                )  # fmt: skip
    except (UsageError, InputError, WriteError) as error:
        result.exit, result.said = exit_of_error(error), error.message
        if not words.error(error):
            result.wrong.append(f"no sentence for {error}")
        return
    result.exit = exit_of(done.record.quality)
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        show(done.record, case.form, words, ())
    _look(done, result)


def _look(done: Audit, result: Result) -> None:
    record = done.record
    result.wrong.extend(f"crashed: {trace}" for trace in done.log)
    result.read = bool(record.delivery.parts)
    result.reached = any(one.checked and not one.about_file for one in record.outcomes)
    result.said = " ".join(source.error for source in record.delivery.sources if source.error)
    result.wrong.extend(f"{one.name} crashed" for one in record.outcomes if one.status is Status.CRASHED)
    if record.quality.verdict is Verdict.ACCEPTED:
        result.wrong.extend(f"accepted, but {why}" for why in _doubts(done))


def _doubts(done: Audit) -> Iterator[str]:
    """What leaves open whether the input is clean."""
    record = done.record
    for source in record.delivery.sources:
        if source.status in LOST:
            yield f"{source.path} is {source.status}"
        yield from (f"{one.kind} was skipped: {one.reason}" for one in source.skipped if one.reason.opens)
    counted = {name for element in record.quality.elements if element.required for name, *_ in element.details}
    for one in record.outcomes:
        if one.because.opens and (record.loose or (one.name in counted and not one.preview)):
            yield f"{one.name} did not run: {one.because}"
        if record.loose and any(item.open for item in one.aside):
            yield f"{one.name} could not judge {one.aside}"


# --- by the command, with all reports ---------------------------------------------------------------------------------


@cache
def _schema() -> jsonschema.Draft202012Validator:
    path = shipped("templates") / "schema" / "foparq-audit-1.schema.json"
    return jsonschema.Draft202012Validator(json.loads(path.read_text(encoding="utf-8")))


def by_command(case: Case, place: Path, out: Path, result: Result) -> None:
    """Audit twice by the command, and read the reports."""
    options = [f"--lang={case.language}", f"--format={case.form}"]
    if case.seed.command == "check":
        options += ["--scale=1:50", *(f"--areas={pattern}" for pattern in case.areas)]
        options += [f"--unit={case.unit}"] * (case.unit is not None)
        options += [f"--plane={case.plane}"] * (case.plane is not None)
    runs = []
    for turn in ("once", "twice"):
        words = io.StringIO()
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(words):
            code = run([case.seed.command, str(place), f"--out={out / turn}", *options])
        runs.append((code, _found(out / turn)))
        if code not in ANSWERS:
            result.wrong.append(f"exit code {code}: {words.getvalue()}")
        if "Traceback" in words.getvalue():
            result.wrong.append(words.getvalue())
    result.exit = runs[0][0]
    if runs[0] != runs[1]:
        result.wrong.append(f"the second run differs: {runs}")
    if (out / "once" / "crash.log").exists():
        result.wrong.append((out / "once" / "crash.log").read_text(encoding="utf-8"))
    if (out / "once" / "audit.json").exists():
        _read_reports(out / "once", result)


def _found(out: Path) -> list[str]:
    path = out / "findings.jsonl"
    return [json.loads(line)["key"] for line in path.read_text("utf-8").splitlines()] if path.exists() else []


def _read_reports(out: Path, result: Result) -> None:
    etree.parse(out / "quality.xml")
    told = json.loads((out / "audit.json").read_text(encoding="utf-8"))
    result.wrong.extend(f"audit.json: {error.message[:300]}" for error in _schema().iter_errors(told))
    drawings = [one for one in told["inputs"] if one["role"] == "drawing"]
    result.read = any(one["status"] in {"read", "recovered"} for one in drawings)
    result.reached = any(one["checked"] and not one["rule"].startswith(("FIL", "DOM")) for one in told["checks"])
    if result.exit:
        return
    lost = [one["path"] for one in told["inputs"] if one["status"] in {"refused", "missing"}]
    unseen = [one for given in told["inputs"] for one in given["skipped"] if SkippedReason(one["reason"]).opens]
    broken = [one["name"] for one in told["checks"] if one["status"] == "crashed"]
    if told["verdict"] is None:
        broken += [one["name"] for one in told["checks"] if Because(one["because"] or "").opens]
    result.wrong.extend(f"clean, but {why}" for why in (*lost, *unseen, *broken))


# --- many cases -------------------------------------------------------------------------------------------------------


def _bounded(numbers: Sequence[int], base: int, keep: Path | None) -> Iterator[Result]:
    """Results of cases, run by a process that may die of one."""
    left = list(numbers)
    while left:
        out, into = os.pipe()
        child = os.fork()
        if child == 0:
            code = 1
            try:
                os.close(out)
                resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, resource.RLIM_INFINITY))
                with os.fdopen(into, "w", encoding="utf-8") as pipe:
                    for number in left:
                        signal.setitimer(signal.ITIMER_PROF, _SECONDS)  # ends the process wherever it hangs
                        print(json.dumps(asdict(outcome(number, base, keep))), file=pipe, flush=True)
                code = 0
            finally:
                os._exit(code)
        os.close(into)
        with os.fdopen(out, encoding="utf-8") as pipe:
            for line in pipe:
                yield Result(**json.loads(line))
                left.pop(0)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        if left:
            result = made(left.pop(0), base)[1]
            result.wrong.append(f"the process ended with {status}")
            yield result


def summary(results: Sequence[Result]) -> str:
    """Table of kinds."""
    lines = ["| kind | cases | read | reached rules | exits | wrong |", "|---|---|---|---|---|---|"]
    for kind in (*KINDS, "all"):
        mine = [one for one in results if kind in {one.kind, "all"}]
        if mine:
            read, reached = sum(one.read for one in mine), sum(one.reached for one in mine)
            exits = ", ".join(f"{code}: {n}" for code, n in sorted(Counter(one.exit for one in mine).items()))
            wrong = sum(bool(one.wrong) for one in mine)
            lines.append(f"| {kind} | {len(mine)} | {read} | {reached} | {exits} | {wrong} |")
    return "\n".join(lines)


def _kept(path: Path | None) -> list[Result]:
    if path is None or not path.exists():
        return []
    return [Result(**json.loads(line)) for line in path.read_text(encoding="utf-8").splitlines()]


def main() -> int:
    """Run the cases that are asked for."""
    parser = argparse.ArgumentParser(description="Audit mildly damaged deliveries.")
    parser.add_argument("--count", type=int, default=1_000, help="number of cases")
    parser.add_argument("--start", type=int, default=0, help="number of the first case")
    parser.add_argument("--seed", type=int, default=SEED, help="other changes")
    parser.add_argument("--out", type=Path, help="file that keeps a line of JSON a case")
    parser.add_argument("--keep", type=Path, help="folder that keeps the files of the case")
    options = parser.parse_args()
    results = _kept(options.out)
    done = {one.case for one in results}
    numbers = [number for number in range(options.start, options.start + options.count) if number not in done]
    for kind in KINDS:
        seeds(kind)  # made once, before the processes part
    for at in range(0, len(numbers), _CHUNK):
        for one in _bounded(numbers[at : at + _CHUNK], options.seed, options.keep):
            results.append(one)
            if one.wrong:
                print(f"{one.case} {one.kind} {one.seed} {one.edits}", *one.wrong, sep="\n", flush=True)
            if options.out:
                with options.out.open("a", encoding="utf-8") as stream:
                    print(json.dumps(asdict(one)), file=stream)
    print(summary(results))
    return int(any(one.wrong for one in results))


if __name__ == "__main__":
    sys.exit(main())
