"""Shaders as models: GLSL, HLSL, Slang and BRDF Explorer files become plain Python functions.

A shader goes through the compilers of a wheel to SPIR-V, and from there to the source of functions
of numbers, which are loaded and compiled like those of any model file: `translation` asks for that
text and keeps it, `translate` makes it in a process of its own. How to describe a shader:
docs/shaders.md.
"""
