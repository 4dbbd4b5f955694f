"""python -m montecarlo_brdf is brdf-check."""
from montecarlo_brdf.cli import main

main()
