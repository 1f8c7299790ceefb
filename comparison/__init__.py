"""Theory and simulations, compared: the questions of the command line, asked from Python.

>>> from comparison import predict
>>> found = predict("cases/tube.toml", 1e-3, theory_only=True)
>>> found.theory.regime
'continuous'

``predict``, ``bounce``, ``sweep`` and ``match`` return objects that print themselves, with ``.plot()`` and
``.to_dict()``. From a question to what is printed, module by module::

    question   questions.py: a beam, a method, until when; it names the run and one more for each cause of error
    runs       runs.py: simulates them or finds them in the store (store.py), each reduced by a reading
    reading    instants_reading (predicting.py), whole_reading (bouncing.py): a history to plain numbers by name
    answer     numbers with bars (runs.py), in PredictedCase, Bounce (bounced.py), Simulated, rows of a SweepTable;
               predict_case (predicting.py) and bounce (bouncing.py) ask the questions and put it together
    printers   to_dict: JSON; texts.py: the same for readers, by readable.py; figures/

doors.py has the functions of Python; the commands call the same drivers. ``match`` (matching.py) holds methods, not a
beam, against the theory: MatchQuestion (rows.py), runs from the same store, bent_beam.measure.estimators, MatchRow.
"""

from typing import Any

__all__ = ["bounce", "match", "predict", "sweep"]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module 'comparison' has no attribute {name!r}")
    from importlib import import_module  # nothing heavy is imported before it is asked for

    return getattr(import_module("comparison.doors"), name)
