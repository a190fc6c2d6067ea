class BadInput(Exception):
    """A file that cannot be drawn, with a sentence why."""
