"""Every built-in model by all checks of `run`: what `brdf-check run --model all` promises."""
from __future__ import annotations

from collections.abc import Callable

import pytest
from conftest import Outcome

from montecarlo_brdf import loading

Command = Callable[..., Outcome]


@pytest.mark.slow
@pytest.mark.parametrize("name", loading.names())
def test_a_built_in_model_passes_all_checks(cli: Command, name: str) -> None:
    outcome = cli("run", "--model", name)
    assert outcome.code == 0, outcome.out
