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
from foparq.cli.common import Spoken, language_option
from foparq.errors import FoparqError
from foparq.exits import Exit, exit_of_error
from foparq.names import nearest
from foparq.report.error_json import error_json
from foparq.report.harmless import log_text
from foparq.report.words import Words, language_named, language_of
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

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The subcommand of the first word; an unknown one is answered with the nearest."""
        if args and args[0] not in COMMANDS and not args[0].startswith("-"):
            near = nearest(args[0], COMMANDS)
            ctx.fail(self.say("cli.unknown-command", value=args[0], example=near[0], known=near))
        return super().resolve_command(ctx, args)

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
    group.params.append(language_option(say))
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
    asked = language_named(_option(arguments, "--lang") or "")
    language = language_of(asked)
    _speak(language)
    spoken = Spoken(asked, Words(language))
    try:
        code = command_line(spoken.say).main(list(arguments), prog_name="foparq", standalone_mode=False, obj=spoken)
        sys.stdout.flush()
    except SystemExit:
        return Exit.PIPE  # the reader of a pipe left early, as `head` does: click ends so
    except BaseException as error:  # noqa: BLE001 - no traceback reaches a user
        return _last_word(error, spoken.say, as_json=_option(arguments, "--format") == "json")
    return int(code or 0)


def _last_word(error: BaseException, say: Words, *, as_json: bool) -> Exit:
    """Tell what ended the command, on standard output too if that is to be JSON; returns the exit code."""
    code, text = Exit.CRASHED, ""
    if isinstance(error, click.ClickException):
        error.show()
        if as_json:
            _as_json(error_json("usage", error.format_message(), {}, Exit.USAGE))
        return Exit.USAGE
    if isinstance(error, click.Abort | KeyboardInterrupt):
        code, text = Exit.STOPPED, say("cli.aborted")
    elif isinstance(error, FoparqError):
        code, text = exit_of_error(error), f"{say('cli.error')}: {say.error(error)}"
        if as_json:
            _as_json(error_json(error.message, say.error(error), error.fields, code))
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


def _as_json(lines: Sequence[str]) -> None:
    with contextlib.suppress(OSError):  # told on standard error already
        click.echo("\n".join(lines))
        sys.stdout.flush()


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


def _option(arguments: Sequence[str], name: str) -> str | None:
    """Value of an option anywhere on the line, needed before the line is understood, or where it is not."""
    for n, argument in enumerate(arguments):
        if argument.startswith(f"{name}="):
            return argument.partition("=")[2]
        if argument == name and n + 1 < len(arguments):
            return arguments[n + 1]
    return None


def _speak(language: str) -> None:
    """Make click's own messages speak the language too: it asks gettext's default domain."""
    gettext.bindtextdomain("messages", str(shipped("templates") / "locale"))
    gettext.textdomain("messages")
    os.environ["LANGUAGE"] = language.replace("-", "_")
