# SPDX-License-Identifier: MIT
"""The command group. Subcommands are loaded when they are called, so that ``--help`` answers at once."""

import contextlib
import errno
import gettext
import importlib
import os
import sys
from collections.abc import Sequence
from pathlib import Path

import click

from foparq import __version__
from foparq.errors import FoparqError
from foparq.exits import Exit, exit_of_error
from foparq.report.harmless import log_text
from foparq.report.words import LANGUAGES, Words, language_of
from foparq.resources import shipped

#: subcommands in the order of the help
COMMANDS = ("audit", "check", "init", "rules", "explain", "doctor")


class Commands(click.Group):
    """Subcommands from ``foparq.cli.<name>_command``, each made by its ``command(say)``."""

    def __init__(self, say: Words, **options: object) -> None:
        super().__init__(**options)  # type: ignore[arg-type]
        self.say = say

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """Names in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002 - click's signature
        """The subcommand, loaded now."""
        if cmd_name not in COMMANDS:
            return None
        module = importlib.import_module(f"foparq.cli.{cmd_name}_command")
        made: click.Command = module.command(self.say)
        return made


def command_line(say: Words) -> click.Group:
    """The whole command in one language."""
    group = Commands(
        say, name="foparq", help=say("cli.foparq"), context_settings={"help_option_names": ["-h", "--help"]}
    )
    group.params.append(
        click.Option(["--lang"], type=click.Choice(LANGUAGES), expose_value=False, help=say("cli.option.lang"))
    )
    version = f"foparq {__version__}"
    return click.version_option(message=version, version=__version__, help=say("cli.option.version"))(group)


def run(arguments: Sequence[str]) -> int:
    """Run the command.

    Parameters
    ----------
    arguments : sequence of str
        Without the program's name.

    Returns
    -------
    int
        Exit code, see :class:`foparq.exits.Exit`.
    """
    _open_streams()
    asked = _asked_language(arguments)
    language = language_of(asked)
    _speak(language)
    say = Words(language)
    try:
        code = command_line(say).main(list(arguments), prog_name="foparq", standalone_mode=False, obj=asked)
        sys.stdout.flush()
    except SystemExit:
        return Exit.PIPE  # the reader of a pipe left early, as `head` does: click ends so
    except BaseException as error:  # noqa: BLE001 - no traceback reaches a user
        return _last_word(error, say)
    return int(code or 0)


def _last_word(error: BaseException, say: Words) -> Exit:
    """Tell what ended the command; returns the exit code."""
    code, text = Exit.CRASHED, ""
    if isinstance(error, click.ClickException):
        error.show()
        return Exit.USAGE
    if isinstance(error, click.Abort | KeyboardInterrupt):
        code, text = Exit.STOPPED, say("cli.aborted")
    elif isinstance(error, FoparqError):
        code, text = exit_of_error(error), f"{say('cli.error')}: {say.error(error)}"
    elif isinstance(error, OSError) and error.filename is None:  # standard output is full or gone
        _give_up_output()
        if error.errno == errno.EPIPE:
            return Exit.PIPE
        why = say("cli.no-output", value=error.strerror or str(error))
        code, text = Exit.USAGE, f"{say('cli.error')}: {why}"
    else:
        text = f"{say('cli.error')}: {say('cli.crashed', file=_kept_traceback())}"
    click.echo(text, err=True)
    return code


def _open_streams() -> None:
    """Streams that can always be written to: closed ones lead nowhere, letters a terminal lacks become escapes."""
    if sys.stdout is None:
        sys.stdout = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115 - lives as long as the process
    if sys.stderr is None:
        sys.stderr = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")


def _give_up_output() -> None:
    """Lead standard output nowhere: what it still holds would be written, and fail again, at the very end."""
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


def _kept_traceback() -> str:
    """File that holds the traceback of the error being handled."""
    import tempfile  # noqa: PLC0415 - only when something went wrong
    import traceback  # noqa: PLC0415

    with tempfile.NamedTemporaryFile(
        "w", prefix="foparq-crash-", suffix=".log", delete=False, encoding="utf-8"
    ) as stream:
        stream.write(log_text([traceback.format_exc()]))
    return stream.name


def _asked_language(arguments: Sequence[str]) -> str | None:
    """The language asked for anywhere on the line: help texts need it before the line is understood."""
    for n, argument in enumerate(arguments):
        if argument.startswith("--lang="):
            return argument.partition("=")[2]
        if argument == "--lang" and n + 1 < len(arguments):
            return arguments[n + 1]
    return None


def _speak(language: str) -> None:
    """Make click's own messages speak the language too: it asks gettext's default domain."""
    gettext.bindtextdomain("messages", str(shipped("templates") / "locale"))
    gettext.textdomain("messages")
    os.environ["LANGUAGE"] = language.replace("-", "_")
