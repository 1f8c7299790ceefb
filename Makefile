# `make report` and `make test` work by themselves on a fresh machine with Python >= 3.11.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
# Linear algebra here is small and banded: threads inside a process only get in each other's way.
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1
JOBS ?= 2

.PHONY: help report test verify lint bench fuzz docs gallery clean

help:
	@echo "make report   match both simulations with the theory and write report/index.html"
	@echo "make test     the test suite (under four minutes on two cores)"
	@echo "make verify   longer checks; make fuzz: random input and kills; make bench: speed, as ratios"
	@echo "make lint     ruff and mypy; make docs: the guide in site/; make gallery: every figure of the thesis"

$(STAMP): pyproject.toml
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --upgrade pip
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[test,lint]'
	@touch $@

report: $(STAMP)
	$(BIN)/bentbeam report --out report --overwrite --jobs $(JOBS)

test: $(STAMP)
	$(BIN)/python -m pytest -n $(JOBS) --dist worksteal -m "not verify"

verify: $(STAMP)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[docs]'
	$(BIN)/python -m pytest -n $(JOBS) --dist worksteal -m verify

fuzz: $(STAMP)
	FUZZ=1 $(BIN)/python -m pytest -n $(JOBS) --dist worksteal tests/reliability

bench: $(STAMP)
	$(BIN)/python -m benchmarks.steps
	$(BIN)/python -m pytest benchmarks -o python_files='bench_*.py' -o python_functions='bench_*' -s --benchmark-columns=median,iqr,rounds

lint: $(STAMP)
	$(BIN)/ruff check .
	$(BIN)/mypy

docs: $(STAMP)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[docs]'
	$(BIN)/mkdocs build --strict

gallery: $(STAMP)
	$(BIN)/bentbeam gallery --out gallery --jobs $(JOBS)

clean:
	rm -rf $(VENV) report gallery site .pytest_cache .mypy_cache .ruff_cache
