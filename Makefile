# `make report` and `make test` work by themselves on a fresh machine with Python >= 3.11.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
# Linear algebra here is small and banded: threads inside a process only get in each other's way.
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1
# Bytecode is kept: every process would compile its libraries anew, at about a fifth of the tests' processor time.
unexport PYTHONDONTWRITEBYTECODE
JOBS ?= 2

.PHONY: help report test verify lint bench coverage stored faults fuzz docs gallery update wheel lowest newest clean

help:
	@echo "make report   match the simulations with the theory and write out/report/index.html"
	@echo "make test     the test suite (about three minutes on two cores)"
	@echo "make verify   longer checks; make fuzz: random input and kills; make bench: speed, as ratios"
	@echo "make coverage do the error bars hold? random methods and beams; balances of default runs (SEED=N draws the same again)"
	@echo "make faults   do the quick tests see broken lines? faults drawn at random, one at a time (SEED=N; hours)"
	@echo "make stored   confirm stored numbers, or make them anew (RENEW=1: all of them)"
	@echo "make lint     ruff and mypy; make docs: the guide in site/; make gallery: every figure of the thesis"
	@echo "make update   renew the locked versions; make lowest, make newest: a quick suite on either end of the ranges"

# An environment of an older Python, or a broken one, is made anew.
RECENT := 'import sys; sys.exit(sys.version_info < (3, 11))'
ABLE := 'import sys, pip; sys.exit(sys.version_info < (3, 11))'

# Versions and hashes are locked; where the packages come from is the machine's own business (no index is named).
PIP := $(BIN)/python -m pip --quiet --disable-pip-version-check
$(STAMP): pyproject.toml requirements.lock
	@$(BIN)/python -c $(ABLE) 2>/dev/null || { $(PYTHON) -c $(RECENT) && $(PYTHON) -m venv --clear $(VENV); } || \
		{ echo "needs Python 3.11 or newer, $(PYTHON) is $$($(PYTHON) --version 2>&1): make PYTHON=python3.11 ..." >&2; exit 2; }
	$(PIP) install --no-compile --require-hashes --requirement requirements.lock
	rm -rf build *.egg-info  # left by another build, they would hide new commands
	$(PIP) install --no-deps --no-build-isolation --editable .
	@touch $@

report: $(STAMP)
	$(BIN)/bentbeam report --out out/report --overwrite --jobs $(JOBS)

test: $(STAMP)
	$(BIN)/python -m pytest -n $(JOBS) --dist worksteal -m "not verify"

verify: $(STAMP)
	$(PIP) install --require-hashes --requirement requirements-docs.lock
	$(BIN)/python -m pytest -n $(JOBS) --dist worksteal -m verify

fuzz: $(STAMP)
	FUZZ=1 $(BIN)/python -m pytest -n $(JOBS) --dist worksteal tests/reliability tests/comparison/test_twins.py tests/theory/test_theory_twins.py

bench: $(STAMP)
	$(BIN)/python -m benchmarks

coverage: $(STAMP)
	$(BIN)/python -m benchmarks.coverage --jobs $(JOBS) $(if $(SEED),--seed $(SEED))
	$(BIN)/python -m benchmarks.beams --jobs $(JOBS) $(if $(SEED),--seed $(SEED))
	$(BIN)/python -m benchmarks.balances $(if $(SEED),--seed $(SEED))

stored: $(STAMP)
	$(BIN)/python -m benchmarks.stored --jobs $(JOBS) $(if $(RENEW),--renew)

faults: $(STAMP)
	$(BIN)/python -m benchmarks.faults $(if $(SEED),--seed $(SEED))

lint: $(STAMP)
	$(BIN)/ruff check .
	$(BIN)/mypy

docs: $(STAMP)
	$(PIP) install --require-hashes --requirement requirements-docs.lock
	$(BIN)/mkdocs build --strict

gallery: $(STAMP)
	$(BIN)/bentbeam gallery --out out/gallery --jobs $(JOBS)

# One lock for every platform and Python that pyproject.toml allows.
COMPILE = $(BIN)/uv pip compile --quiet --upgrade --universal --python-version 3.11 --generate-hashes --no-emit-index-url \
	--no-annotate --no-header pyproject.toml
update: $(BIN)/uv
	$(COMPILE) --extra test --extra lint --output-file requirements.lock
	$(COMPILE) --extra docs --output-file requirements-docs.lock

# Either end of the ranges that pyproject.toml declares, in an environment of its own: what it takes to install, start,
# compile and answer on both paths there (AT=3.13: on another Python). The lowest versions are those of what is asked
# for here; what those ask for in turn is the newest.
AT ?= $(BIN)/python
QUICK := tests/test_package.py tests/bent_beam tests/theory/test_theory_contact.py tests/theory/test_theory_fields.py \
	tests/hermite_fe/test_hermite_compiled.py
$(BIN)/uv: $(STAMP)
	$(PIP) install uv
	@touch $@
wheel: $(BIN)/uv
	rm -rf build .venv-wheel && $(BIN)/uv build --quiet --wheel --out-dir .venv-wheel
lowest newest: wheel
	$(BIN)/uv venv --quiet --clear --python $(AT) .venv-$@
	$(BIN)/uv pip install --quiet --python .venv-$@/bin/python --resolution $(if $(filter lowest,$@),lowest-direct,highest) "$$(ls .venv-wheel/*.whl)[quick]"
	BENTBEAM_STORE=.venv-$@/store .venv-$@/bin/bentbeam match --kappa-over-nu 2
	.venv-$@/bin/python -m pytest -m "not verify" $(QUICK)

clean:
	rm -rf $(VENV) .venv-wheel .venv-lowest .venv-newest out site .pytest_cache .mypy_cache .ruff_cache
