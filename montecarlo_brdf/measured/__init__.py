"""Reflectance that was measured: a file of numbers as a model, its tables read by address."""
