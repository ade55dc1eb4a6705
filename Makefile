# Everything a machine needs beyond Python 3.11 and make is installed from PyPI into .venv by these targets: the very
# versions and files of the lock file, which `make lock` renews.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
LOCK := locks/development.txt
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check
# Bytecode is kept, or every process would compile every test anew.
PYTEST := PYTHONDONTWRITEBYTECODE= $(BIN)/python -m pytest -q
# Long runs: tests of a module stay in one process, which keeps what they share.
LONG := $(PYTEST) -n auto --maxprocesses 4 --dist loadfile

.PHONY: demo test test-core test-rest test-least test-newest test-elsewhere check check-full format lint types lock docs site
.PHONY: bench bench-guard stress clean

# VERSIONS: other ones than those of the lock file, as pip takes them.
ifdef VERSIONS
define INSTALL
	$(PIP) --editable '.[dev]' $(VERSIONS)
endef
else
define INSTALL
	$(PIP) --require-hashes --requirement $(LOCK)
	$(PIP) --no-deps --no-build-isolation --editable .
endef
endif

$(READY): pyproject.toml $(LOCK)
	$(PYTHON) -c 'import sys; sys.exit("gearlink needs Python 3.11 or newer" if sys.version_info < (3, 11) else 0)'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip uninstall --quiet --yes gearlink 2>/dev/null  # as it was called in older checkouts
	$(INSTALL)
	mkdir -p .types/gearlink
	ln -sfn ../../cli/door/__init__.py .types/gearlink/__init__.py
	ln -sfn ../../cli/door/py.typed .types/gearlink/py.typed
	ln -sfn ../../core .types/gearlink/core
	ln -sfn ../../cli .types/gearlink/cli
	ln -sfn ../../designs .types/gearlink/designs
	$(BIN)/python -m compileall -q core cli designs
	touch $(READY)

# Two results, each short enough for a screen; without --quantity a command shows all of its results and checks.
demo: $(READY)
	@echo 'A feed that dwells within +-0.5 deg over 70 deg of the crank (designs/standing_feed.yaml):'
	$(BIN)/gearlink synth dwell designs/standing_feed.yaml $(patsubst %,--quantity %,$(DEMO_DWELL))
	@echo; echo 'The cams of a flatbed press (designs/ty460.yaml):'
	$(BIN)/gearlink cam designs/ty460.yaml --plot $(patsubst %,--quantity %,$(DEMO_CAM))
	@echo 'The figure is $(CURDIR)/TY-460-cam.png'

DEMO_DWELL := idler_teeth crank_length coupler_length frame_length tolerance_dwell_angle frame_length_interval gear_gap
DEMO_CAM := follower_stroke max_pressure_angle min_curvature_radius min_radius max_radius

# Two processes, each with its half of the tests: nothing is collected twice, and no test waits to be handed out, which
# took a tenth of the time. A test that waits for ever ends its half with the stacks of all threads.
test: $(READY)
	@echo 'Two halves, each shown when it has ended.'
	@$(MAKE) --no-print-directory --keep-going --jobs=$(shell getconf _NPROCESSORS_ONLN) \
	$(if $(filter output-sync,$(.FEATURES)),--output-sync) test-core test-rest

test-core: TESTS = tests/core
test-rest: TESTS = tests --ignore=tests/core
test-core test-rest: $(READY)
	$(PYTEST) -p no:logging $(TESTS) --patience 200 $(OPTIONS)

# The same tests with the least versions of the libraries that pyproject.toml promises, in an environment of their own.
# Old libraries use names that the newer ones beside them will drop one day: their deprecations are not ours.
test-least:
	@exactly=$$($(PYTHON) tests/least_versions.py) && echo "With $$exactly:" && \
	$(MAKE) --no-print-directory test VENV=.venv-least VERSIONS="$$exactly" OPTIONS='-W ignore::DeprecationWarning'

# With the newest versions that pyproject.toml allows, looked up anew each time.
NEWEST := --no-print-directory VENV=.venv-newest VERSIONS='--upgrade --upgrade-strategy eager'
test-newest:
	rm -f .venv-newest/.ready
	@$(MAKE) $(NEWEST) .venv-newest/.ready
	.venv-newest/bin/python -m pip freeze --exclude-editable
	@$(MAKE) $(NEWEST) test

# The same tests where little is as usual: the folder, the locale, the time zone, the processor, their order.
test-elsewhere: $(READY)
	$(BIN)/python tests/elsewhere.py

check: lint types test site

check-full: lint types $(READY)
	GEARLINK_EXAMPLES=all $(LONG) -m 'not stress'
	$(MAKE) test-elsewhere
	$(MAKE) bench-guard

lint: $(READY)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .

types: $(READY)
	$(BIN)/mypy

format: $(READY)
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

# The peers stand in an environment of their own: they need other versions, and numba.
bench/.venv/.ready: Makefile
	$(PYTHON) -m venv bench/.venv
	bench/.venv/bin/python -m pip install --quiet --disable-pip-version-check pylinkage mechanism numba mpmath
	touch $@

bench: $(READY) bench/.venv/.ready
	$(BIN)/python -m bench.write_page

# What is slower than on docs/benchmarks.json, as ratios to the floors of the same run.
bench-guard: $(READY)
	$(BIN)/python -m bench.guard

# Tests that share nothing: each goes to the next free process.
stress: $(READY)
	$(PYTEST) -n auto --maxprocesses 4 --dist worksteal -m stress -rP

# The newest versions that pyproject.toml allows, for every Python and platform that it names, with the hashes of their
# files: of all that the Makefile installs, and of what the program alone needs (action.yml).
COMPILE := .venv-lock/bin/uv pip compile --quiet --upgrade --universal --python-version 3.11 --generate-hashes \
--custom-compile-command 'make lock' --group build pyproject.toml
lock: .venv-lock/bin/uv
	$(COMPILE) --extra dev --output-file $(LOCK)
	$(COMPILE) --constraint $(LOCK) --output-file locks/program.txt

.venv-lock/bin/uv:
	$(PYTHON) -m venv .venv-lock
	.venv-lock/bin/python -m pip install --quiet --disable-pip-version-check uv

# The generated files, the figures of the README, the output of commands in README and docs, and the manual in
# build/manual/site, with every result of this state of the program.
docs: $(READY)
	$(BIN)/python docs/generate.py
	$(BIN)/python docs/pictures.py
	$(BIN)/python -m docs.manual --refresh

# The manual, strictly: pages, links, equations; results that are there are taken, whatever state gave them.
site: $(READY)
	$(BIN)/python -m docs.manual --last

clean:
	rm -rf $(VENV) .venv-least .venv-newest .venv-lock bench/.venv .types build *.egg-info .pytest_cache .mypy_cache .ruff_cache .hypothesis
