"""Run time against error: our methods beside what one could use instead, on the same work.

Peers get more than a user would give them: the model's f compiled to the same machine code, half
the azimuth, as the models are isotropic, and of all their settings the fastest one whose true error
meets the target. Ours must find its setting itself. `python scripts/benchmark.py` runs everything.
"""
