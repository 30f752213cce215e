# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

# The two commands of the README: `make quick` and `make test`. Each creates the environment and
# builds what it needs.
PYTHON ?= $(shell command -v python3.11 || command -v python3)
BIN := .venv/bin
INSTALL = $(BIN)/pip install --quiet --disable-pip-version-check
RUN ?= results/runs/quick
PRESET ?= quick
NATIVE := CMakeLists.txt pyproject.toml \
	$(shell find ofg experiments/truth -name '*.[hc]pp' -o -name CMakeLists.txt)

SOURCES = $(shell git ls-files '*.[hc]pp')
PAGE := experiments/publish/report/page
REUSE := REUSE_ENCODING_MODULE=charset_normalizer $(BIN)/reuse

.PHONY: help env build quick test lint style types layers lines format licences \
	lock stub engines browser native \
	native-v3 bench-truth crosscheck attack drill fuzz fuzz-verified fuzz-sweep fuzz-boundary \
	reproduce clean
help:
	@echo "make quick        set up, build, run the main job in a few minutes, print its tables"
	@echo "make test         set up, build, run every test"
	@echo "make lint         check style, types, layers and the length of files"
	@echo "make format       write the style that make lint checks"
	@echo "make lock         make the requirements files anew; versions stay"
	@echo "make engines      install the further engines too: coal, rapier, parry, ipctk, drake"
	@echo "make browser      install what the report's tests drive a Chromium with"
	@echo "make native       time OFG and the engines as C++ libraries (ofg-bench native)"
	@echo "make native-v3    build FCL, libccd and Bullet for x86-64-v3, for make native"
	@echo "make reproduce    run every experiment and the standard preset (under an hour)"
	@echo "make bench-truth  certified labels a second on the standard mix"
	@echo "make crosscheck   ask CGAL's exact kernel and dense sampling about the labels"
	@echo "make attack       corrupt thousands of certificates: the checker must refuse them"
	@echo "make drill        kill, stop and starve runs, and run faulty methods (an hour or more)"
	@echo "make fuzz         a million random queries under the address and UB sanitizers"
	@echo "make fuzz-verified  verified OFG without sanitizers: QUERIES, SECONDS, SEED, FROM (a pair)"
	@echo "make fuzz-sweep   its sweeps: 100000 under the sanitizers, then QUERIES without"
	@echo "make fuzz-boundary  a million calls with garbage into both native modules"
	@echo "make clean        remove the environment and the build (never a run)"

env: .venv/.ready
.venv/.ready: requirements.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' || { \
		echo "ofg needs Python 3.11, the newest for which every engine has a wheel." \
			"Install it and say: make PYTHON=/path/to/python3.11 $(MAKECMDGOALS)"; exit 1; }
	$(PYTHON) -m venv .venv
	$(INSTALL) --require-hashes -r requirements.txt
	@touch $@

build: .venv/.built
.venv/.built: .venv/.ready $(NATIVE)
	$(INSTALL) --no-build-isolation --no-deps -e .
	@touch $@

quick: build
	$(BIN)/ofg-bench run $(PRESET) --out $(RUN)

test: build
	$(BIN)/pytest -n 2

.venv/.lint: .venv/.ready requirements-lint.txt
	$(INSTALL) --require-hashes -r requirements-lint.txt
	@touch $@

lint: style types layers lines

style: .venv/.lint
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/clang-format --dry-run --Werror $(SOURCES)
	$(BIN)/biome ci --colors=off $(PAGE)
	$(REUSE) lint --lines

types: .venv/.lint
	$(BIN)/mypy

layers: .venv/.lint
	$(BIN)/lint-imports --no-logo

lines: .venv/.ready
	$(BIN)/pytest tests/test_lines.py

# A licence for each file of ours that has none in its own lines.
COMMENTED := '*.py' '*.[hc]pp' '*.rs' '$(PAGE)/*.js' '$(PAGE)/*.css' Makefile '*CMakeLists.txt'
licences: .venv/.lint
	$(REUSE) annotate --license MIT --copyright "The ofg authors" --year 2026 --skip-existing \
		$(shell git ls-files $(COMMENTED))

format: .venv/.lint
	$(BIN)/ruff check --fix --exit-zero --quiet .
	$(BIN)/ruff format .
	$(BIN)/clang-format -i $(SOURCES)
	$(BIN)/biome check --write $(PAGE)

# Versions in the files stay. To move one: make lock UPGRADE='--upgrade-package NAME'.
COMPILE = $(BIN)/uv pip compile --quiet --no-header --generate-hashes --python-version 3.11 \
	$(UPGRADE)
EXTRAS := import sys, tomllib; \
	extras = tomllib.load(sys.stdin.buffer)["project"]["optional-dependencies"]; \
	print(*extras[sys.argv[1]], sep="\n")
lock: .venv/.lint
	$(COMPILE) pyproject.toml --extra test --extra build -o requirements.txt
	set -e; for extra in lint engines browser; do \
		$(BIN)/python -c '$(EXTRAS)' $$extra < pyproject.toml | \
			$(COMPILE) - -c requirements.txt -o requirements-$$extra.txt; done

# The types of the native core; a test says when they are no longer those of the core.
stub: build
	$(BIN)/python -m nanobind.stubgen --quiet -m ofg._core -o ofg/_core.pyi

engines: build
	$(INSTALL) --require-hashes -r requirements-engines.txt

browser: build
	$(INSTALL) --require-hashes -r requirements-browser.txt

native: build
	$(BIN)/ofg-bench native

native-v3: build
	PATH="$(CURDIR)/$(BIN):$$PATH" baselines/native/sources.sh

bench-truth: build
	$(BIN)/python -m experiments.truth.audit.bench

crosscheck: build
	$(BIN)/python -m experiments.truth.audit.crosscheck

attack: build
	$(BIN)/python -m experiments.truth.audit.attack

TRIES ?= 50
drill: build
	$(BIN)/python -m experiments.drill --tries $(TRIES) $(if $(ONLY),--only '$(ONLY)')

QUERIES ?= 1000000
SECONDS ?= 600
fuzz: build
	$(BIN)/cmake -S tests/ofg/native -B build/fuzz -DCMAKE_BUILD_TYPE=Release
	$(BIN)/cmake --build build/fuzz --target fuzz fuzz_verified fuzz_solid
	build/fuzz/fuzz $(QUERIES) $(SECONDS)
	for name in fuzz_verified fuzz_solid; do \
		ASAN_OPTIONS=malloc_context_size=0 build/fuzz/$$name $(QUERIES) $(SECONDS) || exit 1; done

SEED ?= 1
FROM ?= 0
fuzz-verified: build
	$(BIN)/cmake -S tests/ofg/native -B build/fuzz -DCMAKE_BUILD_TYPE=Release
	$(BIN)/cmake --build build/fuzz --target fuzz_verified_plain
	build/fuzz/fuzz_verified_plain $(QUERIES) $(SECONDS) $(SEED) $(FROM)

fuzz-sweep: build
	$(BIN)/cmake -S tests/ofg/native -B build/fuzz -DCMAKE_BUILD_TYPE=Release
	$(BIN)/cmake --build build/fuzz --target fuzz_sweep fuzz_sweep_plain
	build/fuzz/fuzz_sweep 100000 $(SECONDS) $(SEED)
	build/fuzz/fuzz_sweep_plain $(QUERIES) $(SECONDS) $(SEED)

CALLS ?= 1000000
fuzz-boundary: build
	$(BIN)/cmake -S tests/ofg/native/boundary -B build/boundary \
		-DPython_EXECUTABLE=$(CURDIR)/$(BIN)/python -DCMAKE_BUILD_TYPE=RelWithDebInfo
	$(BIN)/cmake --build build/boundary
	asan=$$($${CXX:-c++} -print-file-name=libasan.so); \
	std=$$($${CXX:-c++} -print-file-name=libstdc++.so); \
	ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 LD_PRELOAD="$$asan $$std" \
		$(BIN)/python tests/ofg/native/boundary.py build/boundary $(CALLS) $(SECONDS)

reproduce: build
	$(BIN)/ofg-bench reproduce

clean:
	rm -rf .venv build
