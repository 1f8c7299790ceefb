"""The open benchmark of dynamic beam contact: any code, two files, held against exact solutions.

A *problem* (a TOML file, physics only) goes in, a *result* (an NPZ file, or CSV and JSON) comes out of an *adapter*, a
program in any language that imports nothing of this project. Here results are validated, scored and diagnosed, and
adapters are run under limits. docs/benchmark.md describes both files.
"""

from bent_beam_programs.open_benchmark.judgement import Score
from bent_beam_programs.open_benchmark.problem import Problem, problem, shipped_ids
from bent_beam_programs.open_benchmark.reading import load_result
from bent_beam_programs.open_benchmark.result import Result, ResultError
from bent_beam_programs.open_benchmark.score import score

__all__ = ["Problem", "Result", "ResultError", "Score", "load_result", "problem", "score", "shipped_ids"]
