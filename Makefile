# The two commands of the README: `make quick` and `make test`. Each creates the environment and builds what it needs.
PYTHON ?= $(shell command -v python3.11 || command -v python3)
BIN := .venv/bin
RUN ?= results/runs/quick
PRESET ?= quick
NATIVE := CMakeLists.txt pyproject.toml $(shell find ofg experiments/truth -name '*.[hc]pp' -o -name CMakeLists.txt)

.PHONY: help env build quick test clean
help:
	@echo "make quick   set up, build, run the main job in a few minutes, print its tables"
	@echo "make test    set up, build, run every test"
	@echo "make clean   remove the environment and the build (never a run)"

env: .venv/.ready
.venv/.ready: requirements.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' || { echo "ofg needs Python 3.11, the newest for which every engine has a wheel. Install it and say: make PYTHON=/path/to/python3.11 $(MAKECMDGOALS)"; exit 1; }
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet --disable-pip-version-check --require-hashes -r requirements.txt
	@touch $@

build: .venv/.built
.venv/.built: .venv/.ready $(NATIVE)
	$(BIN)/pip install --quiet --disable-pip-version-check --no-build-isolation --no-deps -e .
	@touch $@

quick: build
	$(BIN)/ofg-bench run $(PRESET) --out $(RUN)

test: build
	$(BIN)/pytest -n 2

clean:
	rm -rf .venv build
