"""Scenes: a surface under a sky and lights, its reflected radiance, and its picture.

Reading order: colour, surface, standard (the standard lighting equation), texels and skies (what
shines), scene (the record); images, table, environment and read (the file); plan (what is
evaluated, how, and what is skipped), integrands, radiance (the estimates), truth (what they must
be), claims; pixels, angle_table and render (the sphere).
"""
