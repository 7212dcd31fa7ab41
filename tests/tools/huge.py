# SPDX-License-Identifier: MIT
"""Run foparq on inputs that are large, slow or mean harm, and print what each cost.

``python tests/tools/huge.py [NAME ...]``: all of them, or those whose name contains one of the words. Each input is
made in a temporary folder, checked by a process of its own, and removed. Exit code 1 if one of them took too long, took
too much memory, or ended in a way that is not right for it.
"""

import argparse
import multiprocessing
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

import drawings  # noqa: F401 - registers
import hostile  # noqa: F401 - registers
from inputs import INPUTS, Job

MOST_MEGABYTES = 2_048


@dataclass(frozen=True, slots=True)
class Cost:
    """What one run cost."""

    exit: int | None  #: ``None`` if it was stopped
    seconds: float
    processor: float  #: seconds of all its processes: says more than the clock on a machine that others use
    megabytes: float  #: of its largest process
    words: str  #: last line that it wrote


def run(command: list[str], timeout: float) -> Cost:
    """Run a process and measure it, with everything it starts."""
    with tempfile.TemporaryFile() as words:
        begun = time.monotonic()
        process = subprocess.Popen(command, stdout=words, stderr=subprocess.STDOUT, start_new_session=True)
        late = threading.Event()

        def stop() -> None:
            late.set()
            os.killpg(process.pid, signal.SIGKILL)

        timer = threading.Timer(timeout, stop)
        timer.start()
        _, status, used = os.wait4(process.pid, 0)
        timer.cancel()
        seconds = time.monotonic() - begun
        process.returncode = os.waitstatus_to_exitcode(status)
        words.seek(0)
        lines = words.read().decode("utf-8", "replace").strip().splitlines()
    code = None if late.is_set() else process.returncode
    return Cost(code, seconds, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, lines[-1] if lines else "")


def made(name: str, folder: Path) -> Job:
    """Make an input in a process of its own, whose memory does not count as that of the run."""
    context = multiprocessing.get_context("fork")
    with context.Pool(1) as pool:
        return pool.apply(make, (name, folder))


def make(name: str, folder: Path) -> Job:
    """Make an input."""
    return INPUTS[name](folder)


def verdict(job: Job, cost: Cost) -> str:
    """What is wrong with a run; ``""`` if nothing is."""
    wrong = []
    if cost.exit is None:
        wrong.append("stopped")
    elif cost.exit not in job.exits:
        wrong.append("exit")
    if cost.seconds > job.seconds:
        wrong.append("slow")
    if cost.megabytes > MOST_MEGABYTES:
        wrong.append("memory")
    return ", ".join(wrong)


def say(line: str) -> None:
    """Write a line at once."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def main() -> int:
    """Run the inputs that are asked for."""
    parser = argparse.ArgumentParser(description="Run foparq on inputs that are large, slow or mean harm.")
    parser.add_argument("names", nargs="*", help="parts of names; all if left out")
    parser.add_argument("--foparq", default=str(Path(sys.executable).with_name("foparq")), help="the command")
    parser.add_argument("--timeout", type=float, default=120.0, help="seconds after which a run is stopped")
    parser.add_argument("--list", action="store_true", help="only name the inputs")
    options = parser.parse_args()
    chosen = [name for name in INPUTS if not options.names or any(part in name for part in options.names)]
    if options.list:
        say("\n".join(chosen))
        return 0
    failed = False
    say("| input | exit | seconds | processor | MB | wrong | last words |\n|---|---|---|---|---|---|---|")
    for name in chosen:
        with tempfile.TemporaryDirectory(prefix="huge-") as folder:
            job = made(name, Path(folder))
            cost = run([options.foparq, *job.arguments()], options.timeout)
        wrong = verdict(job, cost)
        failed |= bool(wrong)
        shown = "".join(letter if letter.isprintable() else "?" for letter in cost.words)[:100].replace("|", "/")
        figures = f"{cost.seconds:.1f} | {cost.processor:.1f} | {cost.megabytes:.0f}"
        say(f"| {name} | {cost.exit} | {figures} | {wrong} | {shown} |")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
