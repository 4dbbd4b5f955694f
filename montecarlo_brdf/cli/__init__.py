"""brdf-check: one file per command; this one only gathers them and turns errors into exit codes.

Exit codes: 0 all claims held, 1 a claim was refuted, 2 usage, 3 inconclusive, 4 the model could not
be loaded, compiled or raised, 5 output could not be written, 70 internal error, 130 interrupted.
"""
from __future__ import annotations

import contextlib
import functools
import importlib
import io
import os
import pkgutil
import sys
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

import click

from montecarlo_brdf import __version__
from montecarlo_brdf.errors import ModelError, OutputError, UserError, unknown
from montecarlo_brdf.files import forget_inputs, is_input

INTERNAL_ERROR = 70
INTERRUPTED = 130
GUARDED = "BRDF_CHECK_GUARDED"  # set where the process that watches is another one

EPILOG = """\b
Examples:
  brdf-check furnace --model lambert
  brdf-check furnace --model my_brdf.py -p albedo=0.5 --theta-o 0:85:6 --plot albedo.png
  brdf-check show lambert
\b
Exit codes: 0 all claims held, 1 a claim was refuted, 2 usage, 3 inconclusive,
4 the model could not be run, 5 output could not be written, 70 internal error, 130 interrupted.
\b
Shell completion: eval "$(_BRDF_CHECK_COMPLETE=bash_source brdf-check)"
(or zsh_source, fish_source)
"""


class Commands(click.Group):
    """Every module of this folder that does not start with an underscore is a command."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of all commands."""
        return sorted(m.name for m in pkgutil.iter_modules(__path__) if not m.name.startswith("_"))

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """The command `name`, imported when it is asked for."""
        if name not in self.list_commands(ctx):
            raise UserError(unknown("command", name, self.list_commands(ctx)))
        module = importlib.import_module(f"{__name__}.{name}")
        command: click.Command = module.command
        command.callback = _speaking_alone(command.callback)
        for option in command.params:
            if isinstance(option, click.Option):
                option.envvar = environment_name(name, option)
        return command


def _speaking_alone(callback: Callable[..., Any] | None) -> Callable[..., Any]:
    """A command whose models print to stderr."""
    assert callback is not None
    if getattr(callback, "alone", False):
        return callback

    @functools.wraps(callback)
    def call(*arguments: Any, **options: Any) -> Any:
        from montecarlo_brdf.cli._terminal import answers_alone

        with answers_alone():
            return callback(*arguments, **options)

    vars(call)["alone"] = True
    return call


def environment_name(command: str, option: click.Option) -> str:
    """BRDF_CHECK_FURNACE_THETA_O for --theta-o of furnace."""
    longest = max(option.opts, key=len).lstrip("-")
    return f"BRDF_CHECK_{command}_{longest}".replace("-", "_").upper()


@click.group(cls=Commands, epilog=EPILOG, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, "--version", prog_name="brdf-check")
def commands() -> None:
    """Monte Carlo verification of BRDFs: estimates with error bars, verdicts with stated error
    rates."""


def main() -> NoReturn:
    """The console script."""
    sys.stdout = sys.stdout or open(os.devnull, "w")  # noqa: SIM115  closed by `>&-`
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a locale without the degree sign is no error
            stream.reconfigure(errors="replace")
    if not os.environ.get("BRDF_CHECK_DEBUG"):  # what matters of NaN and infinity is in a verdict
        warnings.simplefilter("ignore", RuntimeWarning)
    os._exit = _ended_by_a_model  # type: ignore[assignment]
    guarded = _runs_foreign_code(sys.argv[1:]) and not os.environ.get(GUARDED)
    code = (_guarded if guarded else execute)(sys.argv[1:])
    if os.environ.get("BRDF_CHECK_DEBUG"):  # profilers want to see the end
        sys.exit(code)
    _leave_at_once(code)


_exit, _ours = os._exit, os.getpid()


def _ended_by_a_model(code: int) -> NoReturn:
    """What a model's file gets for `os._exit`: its code, perhaps 0, would pass for a verdict."""
    if os.getpid() != _ours:  # a process of its own
        _exit(code)
    _say(f"Error: the model ended the process by os._exit({code})", ModelError.exit_code)
    _exit(ModelError.exit_code)


def _runs_foreign_code(arguments: list[str]) -> bool:
    """Whether a model is machine code of its author's, which may end the process."""
    from montecarlo_brdf.foreign import c_model

    return any(c_model.is_c(argument.rpartition("=")[2]) for argument in arguments)


def _guarded(arguments: list[str]) -> int:
    """Run the command in a process of its own, of which a signal is told in a sentence."""
    import subprocess

    command = [sys.executable, "-m", "montecarlo_brdf", *arguments]
    with subprocess.Popen(command, env={**os.environ, GUARDED: "1"}) as process:
        while process.poll() is None:
            with contextlib.suppress(KeyboardInterrupt):  # it hears of that itself
                process.wait()
    if process.returncode >= 0:
        return process.returncode
    import signal

    name = signal.Signals(-process.returncode).name
    return _say(f"Error: the model crashed with {name}", ModelError.exit_code)


def _leave_at_once(code: int) -> NoReturn:
    """End a process without taking it down: of a warm run that is a tenth of the time, of a
    compiler a second or two, and a model that nobody waits for may still run."""
    for stream in filter(None, (sys.stdout, sys.stderr)):
        with contextlib.suppress(OSError):
            stream.flush()
    _exit(code)


def execute(arguments: list[str]) -> int:
    """Exit code of a command line; every error becomes one sentence on stderr."""
    forget_inputs()
    try:
        code = commands.main(
            arguments, prog_name="brdf-check", standalone_mode=False, obj=[*arguments]
        )
        sys.stdout.flush()
    except (click.exceptions.Abort, KeyboardInterrupt):
        return _say("interrupted", INTERRUPTED)
    except click.exceptions.NoArgsIsHelpError as error:
        error.show()
        return error.exit_code
    except click.ClickException as error:
        return _say(f"Error: {_sentence(error)}", error.exit_code)
    except UserError as error:
        return _say(f"Error: {error}", error.exit_code)
    except OSError as error:  # files are written by files, so this is stdout
        _discard(sys.stdout)
        if isinstance(error, BrokenPipeError):  # `| head`: nobody reads an error message either
            return OutputError.exit_code
        return _say(f"Error: cannot write to stdout: {error.strerror}", OutputError.exit_code)
    except SystemExit as done:  # completion's: no verdict
        return OutputError.exit_code if done.code else 0
    except Exception as error:
        if sentence := of_a_model(error):
            return _say(f"Error: {sentence}", ModelError.exit_code)
        if os.environ.get("BRDF_CHECK_DEBUG"):
            raise
        text = " ".join(f"{type(error).__name__}: {error}".split())
        return _say(f"internal error: {text} (BRDF_CHECK_DEBUG=1 shows where)", INTERNAL_ERROR)
    return code if isinstance(code, int) else 0


def of_a_model(error: Exception) -> str | None:
    """'my_brdf.py raised KeyError (line 3)' if a user's file did, wherever it was called."""
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if is_input(Path(frame.filename)):
            from montecarlo_brdf.loading import raised

            return f"{frame.filename} {raised(error, frame.filename)}"
    return None


def _sentence(error: click.ClickException) -> str:
    """click's message, and for a wrong use where to read what is allowed."""
    context = getattr(error, "ctx", None)
    see = f" (see {context.command_path} --help)" if context else ""
    return " ".join(error.format_message().split()).removesuffix(".") + see


def _discard(stream: Any) -> None:
    """Send what is left in a stream's buffer nowhere, or the interpreter complains at its exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _say(sentence: str, code: int) -> int:
    click.echo(sentence, err=True)
    return code
