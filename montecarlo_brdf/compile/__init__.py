"""From Python functions to machine code: the only home of numba and llvmlite."""
