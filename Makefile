# Everything runs in an environment that is made here on first use; only Python and make are needed.
.DEFAULT_GOAL := help
BIN := .venv/bin
# The first interpreter that the dependencies support (3.11 has ready pybullet wheels).
PYTHON ?= $(shell for python in python3.11 python3.12 python3 python; do \
	"$$python" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 13))' 2>/dev/null \
	&& echo "$$python" && break; done)

.PHONY: help run test fuzz soak lint types bench learn robots clean

help:  ## Show the targets
	@grep -E '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:[^#]*## /\t/' | expand -t 8

PIP := $(BIN)/python -m pip --disable-pip-version-check install --quiet

.venv/run: pyproject.toml
	@test -n "$(PYTHON)" || { echo "cowalk needs Python 3.11 or 3.12; set PYTHON=..." >&2; exit 2; }
	$(PYTHON) -m venv .venv
	$(PIP) --editable .
	@touch $@

# What developing takes on top; running does without it.
.venv/develop: .venv/run
	$(PIP) --editable '.[dev]'
	@touch $@

run: .venv/run  ## Run the closed-loop scenario and draw its picture
	$(BIN)/cowalk run puddle --out runs/puddle

test: .venv/develop  ## Run all tests
	$(BIN)/python -m pytest -n auto --dist loadfile

# Each kind of mutation gets its share; a failure is printed with the line that repeats it.
fuzz: .venv/develop  ## Answer 10,000 mutations of files, commands and formulas, and hostile robots
	COWALK_FUZZ=10000 $(BIN)/python -m pytest -n auto tests/fuzz/test_mutations.py
	$(BIN)/python -m pytest -m fuzz tests

soak: .venv/develop  ## Run a thousand adversarial scenarios on PyBullet, and look for leaks
	$(BIN)/python -m pytest -m soak tests

lint: .venv/develop  ## Check style, formatting, and who imports whom
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports --no-cache

types: .venv/develop  ## Check the types of what is shipped
	rm -rf build
	$(PIP) --no-deps --target build/types .
	MYPYPATH=build/types $(BIN)/mypy

bench: .venv/run  ## Measure speed, as ratios within one run
	$(BIN)/python -m benchmarks

# Learning brings gigabytes that nothing else needs.
.venv/learn: .venv/develop
	$(PIP) --editable '.[learn]'
	@touch $@

learn: .venv/learn  ## Check the single seat with stable-baselines3, and let PPO learn one for 2,000 steps
	$(BIN)/python -m pytest -m learn
	$(BIN)/python docs/examples/learned-seat/ppo.py

# Models that makers publish, which nothing else needs.
.venv/robots: .venv/develop
	$(PIP) --editable '.[robots]'
	@touch $@

robots: .venv/robots  ## Walk with robots as their makers publish them
	$(BIN)/python -m pytest -m robots

clean:  ## Remove everything that was made here
	rm -rf .venv build dist runs *.egg-info .mypy_cache .pytest_cache .ruff_cache .hypothesis
