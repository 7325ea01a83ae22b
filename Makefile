# Every target sets up .venv first; after that nothing here needs the network.
#   make run      the wheel-flat passage: out/passage.nc and out/passage.png
#   make test     format, lint, types and the quick tests, those in other tools included
#   make check    the same with the slow tests
#   make fuzz     a million random calls of each version of FMI under every sanitizer; minutes
#   make bench    the benchmarks, one table each
#   make hosts    other co-simulation tools, into .venv-hosts (`make test` and `make bench` do it, too)
#   make test-hosts  the passage in all of them; fails if one is missing
#   make fmus     the FMUs, into dist/
#   make docs     the documentation, into site/
# PYTHON=/path/to/python3 chooses the interpreter that makes .venv.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
INSTALLED := $(VENV)/installed-pyproject.toml

HOSTS := .venv-hosts
HOSTS_NEEDED := benchmarks/host_tools/scripts/requirements.txt

# The matrices are small: BLAS threads cost more than they bring, most of all beside `pytest -n`.
export OPENBLAS_NUM_THREADS := 1

.PHONY: run test check fuzz bench hosts try-hosts test-hosts fmus docs lint
.DELETE_ON_ERROR:

run: $(INSTALLED)
	@mkdir -p out
	$(BIN)/railcosim run --output out/passage.nc --plot out/passage.png
	@echo "written: out/passage.nc and out/passage.png"

test: lint try-hosts
	$(BIN)/python -m pytest -n 2 --dist loadgroup

check: lint try-hosts
	$(BIN)/python -m pytest -n 2 --dist loadgroup -m "slow or not slow"

# FUZZ_SEEDS="7 8 9" begins elsewhere; a failure names the seed and the call.
fuzz: export FUZZ_CALLS ?= 125000
fuzz: export FUZZ_SEEDS ?= 1 2
fuzz: $(INSTALLED)
	$(BIN)/python -m pytest -n 2 -rA --log-level=INFO -m "slow or not slow" tests/native/test_sanitised.py

lint: $(INSTALLED)
	$(BIN)/ruff format --check
	$(BIN)/ruff check
	$(BIN)/mypy --strict

bench: $(INSTALLED) try-hosts
	@set -e; for script in benchmarks/*.py; do echo "$$script"; $(BIN)/python "$$script"; done

try-hosts:
	@$(MAKE) --no-print-directory hosts || echo "going on without other tools" >&2

test-hosts: $(INSTALLED) hosts
	RAILCOSIM_HOSTS=required $(BIN)/python -m pytest -m host tests/hosts

hosts: $(HOSTS)/installed-requirements.txt

docs: $(INSTALLED)
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet
	@echo "written: site/index.html"

fmus: $(INSTALLED)
	$(BIN)/railcosim build
	$(BIN)/railcosim build --kind native

# The stamp is the pyproject.toml that was installed: a checkout that only touches the file's date installs nothing.
$(INSTALLED): pyproject.toml
	@if ! cmp -s pyproject.toml $@; then \
	  $(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
	    { echo "railcosim needs Python 3.11 or newer, and '$(PYTHON)' is not: install it or run make PYTHON=/path/to/python3.11" >&2; exit 1; }; \
	  $(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
	    { echo "'$(PYTHON)' cannot make a virtual environment: install its venv package (on Debian: apt install python3-venv)" >&2; exit 1; }; \
	  echo "setting up $(VENV), once; this takes a minute or two" && \
	  $(PYTHON) -m venv $(VENV) && \
	  $(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[dev]'; \
	fi
	@cp pyproject.toml $@

$(HOSTS)/installed-requirements.txt: $(HOSTS_NEEDED)
	@echo "setting up $(HOSTS), once; this takes a minute"
	@$(PYTHON) -m venv $(HOSTS)
	@$(HOSTS)/bin/python -m pip install --quiet --disable-pip-version-check -r $(HOSTS_NEEDED)
	@$(HOSTS)/bin/python -m pip install --quiet --disable-pip-version-check --no-deps cofmupy==1.0.0
	@cp $(HOSTS_NEEDED) $@
