"""A pytest plugin: collects brdf-check.toml, and pyproject.toml where it has [tool.brdf-check].

One test per model, parameter set and check. Everything heavy is imported when such a file is found.
"""
from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from montecarlo_brdf.cli._requests import Project, Request

FILE = "brdf-check.toml"
PYPROJECT = "pyproject.toml"


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """pytest's hook: the collector for a file, if it is ours."""
    if file_path.name not in (FILE, PYPROJECT):
        return None
    from montecarlo_brdf.cli._requests import speaks

    ours = file_path.name == FILE or speaks(file_path)
    return ProjectFile.from_parent(parent, path=file_path) if ours else None


class ProjectFile(pytest.File):
    """A file that says what to check."""

    def collect(self) -> Iterable[pytest.Item]:
        """One item per model, parameter set and check."""
        from montecarlo_brdf.checks import names
        from montecarlo_brdf.cli._requests import read
        from montecarlo_brdf.errors import UserError

        try:
            project = read(self.path)
        except UserError as error:
            raise self.CollectError(str(error)) from error
        for request in project.requests:
            for one in request.single():
                for check in one.terms.names or names():
                    name = f"{one.title()} {check}"
                    yield CheckItem.from_parent(
                        self, name=name, request=one.only(check), project=project
                    )


class CheckItem(pytest.Item):
    """One check of one model with one parameter set."""

    def __init__(self, *, request: Request, project: Project, **rest: Any) -> None:
        super().__init__(**rest)
        self.request, self.project = request, project

    def runtest(self) -> None:
        """Fail if a claim is refuted, or undecided unless the file says that this passes."""
        from montecarlo_brdf.judge.finding import Policy, Verdict
        from montecarlo_brdf.testing import require
        from montecarlo_brdf.verify.supervision import Deadline

        limit = self.project.max_time
        report = self.request.run(deadline=Deadline(limit) if limit else None)
        if report.measured["interrupted"]:
            raise KeyboardInterrupt
        require(report, self.project.inconclusive or Policy.FAIL)
        if all(f.verdict == Verdict.SKIPPED for r in report.results for f in r.findings):
            notes = dict.fromkeys(f.note for r in report.results for f in r.findings if f.note)
            pytest.skip("; ".join(notes) or "nothing to check")

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Sentences instead of a traceback through this package."""
        from montecarlo_brdf.errors import UserError

        if isinstance(excinfo.value, (AssertionError, UserError)):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Where the test is from."""
        return self.path, None, f"check {self.name}"
