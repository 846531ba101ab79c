# Two commands do everything on a machine with Python 3.11 and make: `make demo` and `make test`.

PYTHON ?= python3.11
VENV := .venv
BIN := $(VENV)/bin
# The peers have one of their own: what they need, numba would import in every process that is measured.
PEERS := .venv-peers

.PHONY: demo test lint unit claims worlds arms figures bench clean

demo: $(VENV)/.demo
	$(BIN)/bbsd design specs/object_lifting.yaml --plot

test: lint unit

lint: $(VENV)/.test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache

unit: $(VENV)/.test
	$(BIN)/pytest -n 2 --dist worksteal

claims: $(VENV)/.demo
	$(BIN)/python experiments/claims.py

worlds: $(VENV)/.demo
	$(BIN)/python experiments/worlds.py

arms: $(VENV)/.demo
	$(BIN)/python experiments/arms.py

# The pictures of episodes in README.md and docs/cookbook.md.
figures: $(VENV)/.demo
	$(BIN)/bbsd design specs/object_lifting.yaml --quiet --plot --out .cache/figures
	$(BIN)/bbsd evaluate .cache/figures/architecture.yaml --plot docs/images/lifting.png
	cp .cache/figures/curves.png docs/images/curves.png
	rm -r .cache/figures
	for world in mobile_robot grid_world; do \
	  $(BIN)/bbsd evaluate specs/$${world}_hand.yaml --plot docs/images/$$world.png || exit 1; \
	done

bench: $(VENV)/.demo $(PEERS)/.bench
	$(PEERS)/bin/python -m benchmarks --python $(BIN)/python $(PART)

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

$(VENV)/.demo: $(BIN)/python pyproject.toml
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[plot]"
	touch $@

$(VENV)/.test: $(BIN)/python pyproject.toml
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[test]"
	touch $@ $(VENV)/.demo

# Peers that cannot be installed are reported as missing.
$(PEERS)/.bench: pyproject.toml
	$(PYTHON) -m venv $(PEERS)
	$(PEERS)/bin/python -m pip install --quiet --disable-pip-version-check --editable .
	-$(PEERS)/bin/python -m pip install --quiet --disable-pip-version-check --editable ".[bench]"
	touch $@

clean:
	rm -rf $(VENV) $(PEERS) .cache .mypy_cache .pytest_cache .ruff_cache .hypothesis build *.egg-info
