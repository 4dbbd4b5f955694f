"""The commands with their options and examples, as click has them."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator

import click

from montecarlo_brdf.cli import commands

EXAMPLE = re.compile(r"\[(-[^]]*)\]")  # `[--theta-o 0:85:18]` in the help of an option
OPTION = re.compile(r"(?<![\w`-])(--?[a-z][a-z-]*)(?![\w`])")
CODE = re.compile(r"(`[^`]*`)")


def made() -> str:
    """A section for each command."""
    context = click.Context(commands, info_name="brdf-check")
    names = commands.list_commands(context)
    found = ((name, commands.get_command(context, name)) for name in names)
    return "\n".join(line for name, one in found if one for line in _section(name, one, context))


def _section(name: str, command: click.Command, above: click.Context) -> Iterator[str]:
    context = click.Context(command, info_name=name, parent=above)
    usage = " ".join(["brdf-check", name, *command.collect_usage_pieces(context)])
    yield from (f"## {name}", "", f"```text\n{usage}\n```", "")
    yield from (told(inspect.cleandoc(command.help or "")), "")
    options = [p for p in command.params if isinstance(p, click.Option)]
    records = [record for p in options if (record := p.get_help_record(context))]
    if records:
        yield from ("| option | |", "|---|---|")
        yield from (f"| `{names}` | {told(help)} |" for names, help in map(_cells, records))
    yield from ("", "```sh", *examples(command.epilog or ""), "```", "")


def _cells(record: tuple[str, str]) -> tuple[str, str]:
    """A name in a table needs no other bar than the table's own."""
    names, help = record
    return names.replace("|", "\\|"), help.replace("|", "\\|")


def told(text: str) -> str:
    """Help as Markdown: examples in it are code, nothing else means more than it says."""
    marked = EXAMPLE.sub(r"`\1`", text.replace("\b", ""))
    return "".join(p if p.startswith("`") else _plain(p) for p in CODE.split(marked))


def _plain(text: str) -> str:
    return OPTION.sub(r"`\1`", re.sub(r"([*_<\[])", r"\\\1", text))


def examples(epilog: str) -> list[str]:
    """The command lines of a help text."""
    return [line.strip() for line in epilog.splitlines() if line.strip().startswith("brdf-check ")]
