# Two commands do everything on a machine with Python 3.11 and make: `make demo` and `make test`.

PYTHON ?= python3.11
VENV := .venv
BIN := $(VENV)/bin
# The peers have one of their own: numba would import what they need in every process that is measured.
PEERS := .venv-peers
# What checks a release is none of what is released.
RELEASE := .venv-release
LOWEST := .venv-lowest

.PHONY: demo test quick lint unit examples claims worlds optimum tables arms methods fuzz faults figures bench release-check lowest clean

demo: $(VENV)/.demo
	$(BIN)/bbsd design specs/object_lifting.yaml --plot

test: lint unit

# For every save. The slowest tests are printed, so that one that is new and slow is seen, and marked with pytest.mark.slow.
quick: $(VENV)/.test
	$(BIN)/ruff check --quiet .
	$(BIN)/lint-imports --no-cache
	$(BIN)/pytest -q -n 2 --dist worksteal -m "not slow" --ignore tests/end_to_end \
	  --hypothesis-profile quick --durations 5 --durations-min 1

lint: $(VENV)/.test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache
	$(BIN)/codespell

unit: $(VENV)/.test
	$(BIN)/pytest -n 2 --dist worksteal

# Property tests with other examples each time: what they find becomes a test of its own.
examples: $(VENV)/.test
	$(BIN)/pytest -n 2 --dist worksteal -m hypothesis --hypothesis-profile new --hypothesis-seed $$(date +%s)

# What the method achieves: experiments/.
claims: $(VENV)/.demo
	$(BIN)/python -m experiments.claims

worlds: $(VENV)/.demo
	$(BIN)/python -m experiments.worlds $(WORLD)

optimum: $(VENV)/.demo
	$(BIN)/python -m experiments.optimum $(SPEC)

# Environments with a table of transitions, which need gymnasium.
tables: $(VENV)/.test
	$(BIN)/python -m experiments.tables $(SPEC)

arms: $(VENV)/.demo
	$(BIN)/python -m experiments.arms
	$(BIN)/python -m experiments.abstract_arms

# Hours with all seeds: make methods OPTIONS=--small takes minutes.
methods: $(VENV)/.demo
	$(BIN)/python -m experiments.methods $(OPTIONS)

# Damaged and heavy specs: fuzzing/.
fuzz: $(VENV)/.demo
	$(BIN)/python -m fuzzing --seconds $(or $(SECONDS),60)
	$(BIN)/python -m fuzzing.folders --seconds $(or $(SECONDS),60)

# Failing and ending calls, kills, damaged checkpoints, races: fuzzing/faults. All of it takes some two hours and a half.
faults: $(VENV)/.demo
	$(BIN)/python -m fuzzing.faults $(PART) $(OPTIONS)

# The pictures of episodes in README.md and docs/cookbook.md, and of a page where there is a browser.
QUIETLY := --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
  --disable-component-update --disable-sync --hide-scrollbars
figures: $(VENV)/.demo
	$(BIN)/bbsd design specs/object_lifting.yaml --quiet --out .cache/figures \
	  --plot-to docs/images/curves.png --plot-beside specs/object_lifting_hand.yaml
	$(BIN)/bbsd evaluate .cache/figures/architecture.yaml --plot docs/images/lifting.png
	rm -r .cache/figures
	for world in mobile_robot grid_world; do \
	  $(BIN)/bbsd evaluate specs/$${world}_hand.yaml --plot docs/images/$$world.png || exit 1; \
	done

	$(BIN)/bbsd report specs/pursuit_hand.yaml -o .cache/page.html
	-chromium $(QUIETLY) --window-size=1280,1330 --screenshot=docs/images/page.png \
	  "file://$(CURDIR)/.cache/page.html#episode=worst&robot=1&step=112" && \
	  $(BIN)/python -c "from PIL import Image; p = 'docs/images/page.png'; Image.open(p).convert('P', palette=1, colors=64).save(p, optimize=True)"

# How fast it is: benchmarks/, all of it or one PART.
bench: $(VENV)/.demo $(PEERS)/.bench
	$(PEERS)/bin/python -m benchmarks --python $(BIN)/python $(PART)

# What is handed out: release/. Wheel and source archive are built, checked, and used where no checkout is.
release-check: $(RELEASE)/.release
	$(RELEASE)/bin/python -m release

# The quick tests with the lowest versions of what pyproject.toml asks for.
lowest: $(LOWEST)/.lowest
	$(LOWEST)/bin/ruff check --quiet .
	$(LOWEST)/bin/mypy
	$(LOWEST)/bin/pytest -q -n 2 --dist worksteal -m "not slow" --ignore tests/end_to_end --hypothesis-profile quick

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

$(VENV)/.demo: $(BIN)/python pyproject.toml
	@echo "Installing bbsd and what it needs into $(VENV): about 450 MB, a minute. The command is $(BIN)/bbsd then."
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[plot]"
	touch $@

$(VENV)/.test: $(BIN)/python pyproject.toml
	@echo "Installing bbsd and all that its tests need into $(VENV): about a gigabyte, some minutes."
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[test]"
	touch $@ $(VENV)/.demo

# Peers that cannot be installed are reported as missing.
$(PEERS)/.bench: pyproject.toml
	$(PYTHON) -m venv $(PEERS)
	$(PEERS)/bin/python -m pip install --quiet --disable-pip-version-check --editable .
	-$(PEERS)/bin/python -m pip install --quiet --disable-pip-version-check --editable ".[bench]"
	touch $@

$(RELEASE)/.release: pyproject.toml
	$(PYTHON) -m venv $(RELEASE)
	$(RELEASE)/bin/python -m pip install --quiet --disable-pip-version-check --editable ".[release]"
	touch $@

$(LOWEST)/.lowest: pyproject.toml
	rm -rf $(LOWEST)
	$(PYTHON) -m venv $(LOWEST)
	$(PYTHON) -m release.lowest > $(LOWEST)/constraints.txt
	$(LOWEST)/bin/python -m pip install --quiet --disable-pip-version-check \
	  --constraint $(LOWEST)/constraints.txt --editable ".[test]"
	touch $@

clean:
	rm -rf $(VENV) $(PEERS) $(RELEASE) $(LOWEST) .cache .mypy_cache .pytest_cache .ruff_cache .hypothesis build *.egg-info
