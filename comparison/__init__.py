"""Theory and simulations, compared: the questions of the command line, asked from Python.

>>> from comparison import predict
>>> found = predict("cases/tube.toml", 1e-3, theory_only=True)
>>> found.theory.regime
'continuous'

``predict``, ``bounce``, ``sweep`` and ``match`` return objects that print themselves, with ``.plot()`` and
``.to_dict()``.
"""

from typing import Any

__all__ = ["bounce", "match", "predict", "sweep"]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module 'comparison' has no attribute {name!r}")
    from importlib import import_module  # nothing heavy is imported before it is asked for

    return getattr(import_module("comparison.doors"), name)
