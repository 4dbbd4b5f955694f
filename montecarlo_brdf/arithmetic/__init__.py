"""Arrays that stand for numbers: of any precision, and such that tell how they were compared."""
