"""One question of many models and parameter sets, as tasks that any process on any machine can
answer: plain data and the text of a model, never a function."""
