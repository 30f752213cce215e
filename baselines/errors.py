"""What a method raises where it cannot be asked."""


class Unsupported(Exception):
    """Raised by `prepare` with the reason why a method cannot be asked a query. Never a miss."""


class MissingEngine(ImportError):
    """The engine's package is not installed; the message says how to install it."""
