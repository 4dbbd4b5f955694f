"""brdf-check docs"""

from __future__ import annotations

import re

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.errors import UserError, unknown

EPILOG = """\b
Examples:
  brdf-check docs
  brdf-check docs tutorial
"""


#: what only the site of the pages makes something of
OF_THE_SITE = re.compile(r"```\{toctree\}\n.*?```\n\n?|<!-- .*? -->\n", re.DOTALL)


def page_names() -> list[str]:
    """The pages there are."""
    return sorted(path.stem for path in _options.shipped("docs").glob("*.md"))


@click.command("docs", epilog=EPILOG, short_help="The pages of the manual.")
@click.argument("page", required=False, shell_complete=_options.one_of(page_names))
def command(page: str | None) -> int:
    """Lists the pages of the manual, or prints one as Markdown."""
    from montecarlo_brdf.cli._terminal import tell

    folder = _options.shipped("docs")
    if page is None:
        texts = {name: (folder / f"{name}.md").read_text(encoding="utf-8") for name in page_names()}
        heads = {name: text.splitlines()[0].lstrip("# ") for name, text in texts.items()}
        tell("\n".join(f"{name:24} {head}" for name, head in heads.items()))
        return 0
    if page not in page_names():
        raise UserError(unknown("page", page, page_names()))
    tell(OF_THE_SITE.sub("", (folder / f"{page}.md").read_text(encoding="utf-8")).rstrip())
    return 0
