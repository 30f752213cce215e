# The two commands of the README: `make quick` and `make test`. Each creates the environment and builds what it needs.
PYTHON ?= $(shell command -v python3.11 || command -v python3)
BIN := .venv/bin
RUN ?= results/runs/quick
PRESET ?= quick
NATIVE := CMakeLists.txt pyproject.toml $(shell find ofg experiments/truth -name '*.[hc]pp' -o -name CMakeLists.txt)

.PHONY: help env build quick test engines native native-v3 bench-truth crosscheck attack drill fuzz fuzz-boundary reproduce clean
help:
	@echo "make quick        set up, build, run the main job in a few minutes, print its tables"
	@echo "make test         set up, build, run every test"
	@echo "make engines      install the further engines too: coal, rapier, parry, ipctk, drake"
	@echo "make native       time OFG and the engines as C++ libraries, with what is found here (ofg-bench native)"
	@echo "make native-v3    build FCL, libccd and Bullet for x86-64-v3 from their packages' sources, for make native"
	@echo "make reproduce    run every experiment and the standard preset into results/, and write the findings (under an hour)"
	@echo "make bench-truth  certified labels a second on the standard mix"
	@echo "make crosscheck   ask CGAL's exact kernel and dense sampling about the labels"
	@echo "make attack       corrupt thousands of certificates: the checker must refuse them"
	@echo "make drill        kill, stop and starve runs, and run faulty methods: nothing of it may become data (an hour or more)"
	@echo "make fuzz         a million random queries under the address and undefined-behaviour sanitizers"
	@echo "make fuzz-boundary  a million calls with garbage into both native modules under the same sanitizers"
	@echo "make clean        remove the environment and the build (never a run)"

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

engines: build
	$(BIN)/pip install --disable-pip-version-check coal rapier3d ipctk py-parry3d drake==1.51.1

native: build
	$(BIN)/ofg-bench native

native-v3: build
	PATH="$(CURDIR)/$(BIN):$$PATH" baselines/native/sources.sh

bench-truth: build
	$(BIN)/python -m experiments.truth.bench

crosscheck: build
	$(BIN)/python -m experiments.truth.crosscheck

attack: build
	$(BIN)/python -m experiments.truth.attack

TRIES ?= 50
drill: build
	$(BIN)/python -m experiments.drill --tries $(TRIES) $(if $(ONLY),--only '$(ONLY)')

QUERIES ?= 1000000
SECONDS ?= 600
fuzz: build
	$(BIN)/cmake -S tests/ofg/native -B build/fuzz -DCMAKE_BUILD_TYPE=Release
	$(BIN)/cmake --build build/fuzz --target fuzz
	build/fuzz/fuzz $(QUERIES) $(SECONDS)

CALLS ?= 1000000
fuzz-boundary: build
	$(BIN)/cmake -S tests/ofg/native/boundary -B build/boundary -DPython_EXECUTABLE=$(CURDIR)/$(BIN)/python -DCMAKE_BUILD_TYPE=RelWithDebInfo
	$(BIN)/cmake --build build/boundary
	ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 LD_PRELOAD="$$($${CXX:-c++} -print-file-name=libasan.so) $$($${CXX:-c++} -print-file-name=libstdc++.so)" \
		$(BIN)/python tests/ofg/native/boundary.py build/boundary $(CALLS) $(SECONDS)

reproduce: build
	$(BIN)/ofg-bench reproduce

clean:
	rm -rf .venv build
