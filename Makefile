# Two commands on a fresh machine: `make demo` and `make test`. Set-up happens once, in .venv.
# With INSTALLER=uv, uv installs in pip's place: in seconds, but it reads nothing of pip's settings.
PYTHON ?= python3
INSTALLER ?=
VENV   ?= .venv
BIN    := $(VENV)/bin
STAMP  := $(VENV)/.installed

.PHONY: demo test full numeric check sizes lint types contracts docs matrix bench clean

$(STAMP): pyproject.toml
	@echo "Installing into $(VENV), once: some minutes on a new machine."
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade pip $(INSTALLER)
	$(BIN)/python -m $(INSTALLER) pip install --quiet --editable '.[ot2,lab,llm,fleet,dev]'
	touch $@

demo: $(STAMP)
	$(BIN)/aegis-ot demo

# Files side by side, in the order of tests/conftest.py: what a module's tests share is made once. Two
# processes a core, since tests wait as much as they work.
test: $(STAMP)
	$(BIN)/python -m pytest -n 4 --dist loadfile --no-loadscope-reorder

# The same with every protocol in each environment of the matrix; CI takes each third where an older
# and a newer release run them all.
full: export AEGIS_OT_FULL := 1
full: matrix test

# The tests of numbers once more as an older processor counts: its last digits are others.
NUMERIC := $(addprefix tests/vision/,column test_calibration.py \
	test_cascade.py scorers/test_pca.py test_signs.py test_tips.py test_tip_scale.py test_usual.py) \
	tests/audit/test_patterns.py tests/worldmodel/test_reach.py
FEATURES := import numpy.core as core; print(*core._multiarray_umath.__cpu_dispatch__)
numeric: $(STAMP)
	NPY_DISABLE_CPU_FEATURES="$$($(BIN)/python -W ignore -c '$(FEATURES)')" \
	OPENBLAS_CORETYPE=Prescott $(BIN)/python -m pytest $(NUMERIC)

lint: $(STAMP)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(STAMP)
	$(BIN)/mypy

contracts: $(STAMP)
	$(BIN)/lint-imports

# The documentation as a site, in out/site; what is generated is written anew.
docs: $(STAMP)
	$(BIN)/python -m scripts.compile_rules
	$(BIN)/aegis-ot rules docs
	$(BIN)/python -m scripts.cli_reference
	$(BIN)/mkdocs build --strict

# Size is printed, not guarded line by line: see tests/test_sizes.py.
check: lint types contracts sizes numeric test

sizes: $(STAMP)
	$(BIN)/python -m scripts.sizes

# Environments of the support matrix, as far as this machine has the interpreters.
matrix: $(STAMP)
	$(BIN)/python -m tests.compat.environments

bench: $(STAMP)
	$(BIN)/python -m benchmarks

clean:
	rm -rf $(VENV) .venvs out
