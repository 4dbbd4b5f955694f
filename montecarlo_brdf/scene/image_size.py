"""How large an image may be."""

from __future__ import annotations

import os
from pathlib import Path

from montecarlo_brdf.errors import UserError

MOST_TEXELS = 1 << 26  # 8192 x 8192: 1.6 GB of doubles in RGB


def check_size(path: Path, width: int, height: int) -> None:
    """Refuse what would not fit before it is read."""
    available = (
        os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        if hasattr(os, "sysconf")
        else 1 << 33
    )
    need = width * height * 3 * 8 * 3  # doubles, their tables, one copy
    if width * height > MOST_TEXELS or need > available // 2:
        raise UserError(
            f"image {path} is too large: {width} x {height} texels need {need / 1e9:.3g} GB"
        )
