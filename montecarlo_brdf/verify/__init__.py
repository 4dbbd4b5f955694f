"""From a question to a report: the calls behind the commands, one per file.

Nothing is imported here: a command loads the one question that it asks.
"""
