"""Scenes: a surface under a sky and lights, its reflected radiance, and its picture.

Reading order: skies (what shines), surface, lights, scene and read (the file), plan (what is
evaluated and what is skipped), radiance (the estimates), truth (what they must be), standard (the
standard lighting equation), render and picture (the sphere).
"""
