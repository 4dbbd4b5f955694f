"""What is asked about: a model, parameters, directions, and where the worst of a quantity lies."""
