"""The open benchmark of dynamic beam contact: any code, two files, held against exact solutions.

A *problem* (a TOML file, physics only) goes in, a *result* (an NPZ file, or CSV and JSON) comes out of an *adapter*, a
program in any language that imports nothing of this project. Here results are validated, scored and diagnosed, and
adapters are run under limits. docs/benchmark.md describes both files.
"""
