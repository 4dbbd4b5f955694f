"""Numbers with error bars, and whether they may be believed; never a verdict."""
