"""Write the generated blocks of README.md and docs/tutorial.md, or check them with --check (exit
code 1 if one is old).

A block stands between `<!-- run: COMMAND -->` or `<!-- commands -->` and `<!-- end -->`. Commands
run in an empty folder with the files that a page itself shows (`<!-- file: NAME -->`) or has copied
from the repository (`<!-- copy: PATH -->`); `<!-- run on a terminal: COMMAND -->` at 80 columns.
"""
from __future__ import annotations

import contextlib
import fcntl
import os
import pty
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
from collections.abc import Callable
from pathlib import Path

from montecarlo_brdf.foreign import translation, wheel

ROOT = Path(__file__).parent.parent
PAGES = tuple(ROOT / n for n in ("README.md", "docs/tutorial.md", "docs/own_model.md",
                                "docs/diagnosis.md"))
HEAD = r"(<!-- (run on a terminal|run|commands):? ?(.*?) ?-->\n)"
BLOCK = re.compile(HEAD + r"(.*?)(<!-- end -->)", re.DOTALL)
FILE = re.compile(r"<!-- file: (\S+) -->\n```\w*\n(.*?)```", re.DOTALL)
COPY = re.compile(r"<!-- copy: (\S+) -->")
#: An estimate and the spaces after it: the last digits are those of the machine.
ESTIMATE = re.compile(r"(\d\.\d{12})\d*\(\d+\) *")
PLAIN = {"BRDF_CHECK_QUIET": "1", "COLUMNS": "80", "NO_COLOR": "1", "PYTHONUTF8": "1"}

Run = Callable[[list[str], str], subprocess.CompletedProcess[str]]


def updated(text: str) -> str:
    """The text with every block written anew."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in FILE.findall(text):
            Path(folder, name).write_text(content, encoding="utf-8")
        for path in COPY.findall(text):
            shutil.copy(ROOT / path, folder)

        def block(match: re.Match[str]) -> str:
            head, kind, command, _, end = match.groups()
            if wheel.folder() is None and any(map(translation.is_shader, command.split())):
                return match[0]  # what this environment cannot run stays as it is
            if kind == "commands":
                body = table_of_commands()
            else:
                body = shown(command, folder, terminal if kind.endswith("terminal") else run)
            return f"{head}{body}{end}"

        return BLOCK.sub(block, text)


def shown(command: str, folder: str, run: Run) -> str:
    """A command with its output and, unless it is 0, its exit code, as a terminal would show it."""
    done = run(shlex.split(command)[1:], folder)
    lines = [f"$ {command}", *done.stdout.splitlines(), *done.stderr.splitlines()]
    lines += ["$ echo $?", str(done.returncode)] if done.returncode else []
    return "```console\n" + "".join(f"{line.rstrip()}\n" for line in lines) + "```\n"


def run(arguments: list[str], folder: str) -> subprocess.CompletedProcess[str]:
    """brdf-check in a process of its own, not at a terminal."""
    return subprocess.run(
        [sys.executable, "-m", "montecarlo_brdf", *arguments],
        cwd=folder,
        env={**os.environ, **PLAIN},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )


def terminal(arguments: list[str], folder: str) -> subprocess.CompletedProcess[str]:
    """The same at a terminal of 80 columns, where tables are as narrow as that."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("4H", 24, 80, 0, 0))
    command = [sys.executable, "-m", "montecarlo_brdf", *arguments]
    environment = {**os.environ, **PLAIN, "TERM": "dumb"}
    with subprocess.Popen(command, cwd=folder, env=environment, stdout=theirs) as process:
        os.close(theirs)
        sent = b""
        with contextlib.suppress(OSError):  # how a terminal ends
            while part := os.read(ours, 4096):
                sent += part
    os.close(ours)
    text = sent.decode().replace("\r\n", "\n")
    return subprocess.CompletedProcess(command, process.returncode, text, "")


def table_of_commands() -> str:
    """One row per command with its short help."""
    import click

    from montecarlo_brdf.cli import commands

    context = click.Context(commands)
    rows = ["| command | does |", "|---|---|"]
    for name in commands.list_commands(context):
        command = commands.get_command(context, name)
        assert command is not None
        rows.append(f"| `brdf-check {name}` | {command.get_short_help_str(120)} |")
    return "\n".join(rows) + "\n"


def same(old: str, new: str) -> bool:
    """Whether two texts say the same, up to the rounding of estimates."""
    return ESTIMATE.sub(r"\1 ", old) == ESTIMATE.sub(r"\1 ", new)


def main(arguments: list[str]) -> int:
    """Write or check the pages."""
    code = 0
    for page in PAGES:
        old = page.read_text(encoding="utf-8")
        new = updated(old)
        if "--check" in arguments:
            code |= not same(old, new)
        else:
            page.write_text(new, encoding="utf-8")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
