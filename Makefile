# Everything this project does, by name; `make help` lists it.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
MAKEFLAGS += --no-print-directory

VENV := .venv
BIN := $(VENV)/bin
PY := $(BIN)/python
CORES := $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)

export PYTHONHASHSEED := 0
export RERUN_ANALYTICS := 0
export PIP_DISABLE_PIP_VERSION_CHECK := 1
# Images of containers often set it; every process would then compile all modules that it imports.
unexport PYTHONDONTWRITEBYTECODE

# Each core begins with a contiguous part of the tests: files, and papers, are shared by few of them, so that
# what their tests have in common is made once.
PARALLEL := $(if $(filter-out 1,$(CORES)),-n $(CORES) --dist worksteal)

# A venv is good for one lock and one pyproject: their checksum is the stamp's name.
stamp = $(VENV)/.installed-$(1)-$(firstword $(shell cat requirements.lock $(2) pyproject.toml | cksum))
READY := $(call stamp,base,)
EXTRA := $(call stamp,extra,requirements-extra.lock)

.PHONY: help
help: ## this list
	@echo "pontryagin: optimal spacecraft control from four papers, derived, solved and certified"
	@echo
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## (.*)/  make \1|\2/' | \
	  while IFS='|' read -r name text; do printf '%-18s %s\n' "$$name" "$$text"; done
	@echo
	@echo "The first use installs what is pinned in requirements.lock into .venv; later ones need no network."

.PHONY: report
report: $(READY) ## the whole report: build/report/index.html, pontryagin.pdf and the players
	@$(PY) -m pontryagin.report

.PHONY: test
test: $(READY) ## the tests and the examples in the docstrings; slow tests of what did not change only with ALL=1
	@echo "== tests on $(CORES) core(s)"
	@OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(PY) -m pytest -p tests.house.kept $(if $(ALL),,--kept) \
	  $(PARALLEL)

.PHONY: notebooks
notebooks: $(READY) ## execute the notebooks that changed, into build/notebooks
	@$(PY) -m pontryagin.report notebooks

.PHONY: figures
figures: $(READY) ## bring figures/ (SVG and CSV) up to date
	@$(PY) -m pontryagin.report figures

.PHONY: lab
lab: $(EXTRA) ## open the notebooks in JupyterLab
	@$(BIN)/jupyter lab --notebook-dir=notebooks $(if $(filter 0,$(shell id -u)),--allow-root)

.PHONY: kernels
kernels: $(READY) ## generate the solvers' kernels from the derivations
	@echo "== kernels from the derivations"
	@modules=$$($(PY) -c 'from pontryagin import papers; print(*papers.having("generate"))'); \
	  for module in $$modules; do $(PY) -m $$module; done

.PHONY: bench
bench: $(EXTRA) ## measure the solvers side by side with others'
	@echo "== benchmarks"
	@$(PY) -m benchmarks

.PHONY: soak
soak: $(EXTRA) ## random problems against certificates and foreign solvers, a minute: make soak SECONDS=7200
	@$(PY) -m studies soak --seconds $(or $(SECONDS),60)

.PHONY: study
study: $(EXTRA) ## run a study on, an hour unless SECONDS says otherwise, and keep its table: make study NAME=soak
	@$(PY) -m studies $(NAME) --seconds $(or $(SECONDS),3600) --keep

.PHONY: judge
judge: $(EXTRA) ## solve the rendezvous directly, from cold starts, for comparison
	@echo "== rendezvous by collocation"
	@$(PY) -m pontryagin.rendezvous.judge

.PHONY: lint
lint: $(READY) ## style, contracts between imports, and types
	@echo "== ruff"
	@$(BIN)/ruff check
	@$(BIN)/ruff format --check
	@echo "== contracts"
	@$(PY) -m tests.house.contracts
	@echo "== mypy"
	@$(BIN)/mypy

.PHONY: types
types: $(READY) ## types on every interpreter from 3.11 to 3.13 that can be had
	@$(PY) -m tests.house.interpreters

.PHONY: check
check: lint ## lint and the quick tests of the core, or of one paper: make check PAPER=rendezvous
	@echo "== quick tests of $(or $(PAPER),the core)"
	@folders=$$($(PY) -m tests.house.selection $(PAPER)); \
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(PY) -m pytest -m "not slow" \
	  $(PARALLEL) $$folders

.PHONY: mutation
mutation: $(READY) ## change the modules that decide, and see whether tests notice: make mutation SECONDS=3600
	@$(PY) -m studies mutation --seconds $(or $(SECONDS),3600) --keep

.PHONY: wheel
wheel: $(READY) ## the wheel passes its tests on Python 3.11 to 3.13: VERSION= EXTRA= PAPER= LOWEST=1
	@$(PY) -m tests.house.wheel $(if $(VERSION),--version $(VERSION)) $(if $(EXTRA),--extra $(EXTRA)) \
	  $(if $(PAPER),--paper $(PAPER)) $(if $(LOWEST),--lowest)

.PHONY: coverage
coverage: $(READY) ## which statements the tests reach, into build/coverage
	@OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(PY) -m pytest $(PARALLEL) \
	  --cov=pontryagin --cov-report=term:skip-covered --cov-report=html:build/coverage

.PHONY: play
play: $(READY) ## replay the recordings in the browser
	@$(PY) -m pontryagin.report recordings
	@$(PY) -m pontryagin.report.play

.PHONY: clean
clean: ## remove what was built; .venv and figures/ stay
	@rm -rf build .pytest_cache .mypy_cache .ruff_cache .hypothesis
	@find src tests benchmarks studies -name __pycache__ -type d -prune -exec rm -rf {} + 2>/dev/null || true
	@echo "removed build/ and the caches"

# --- the environment -------------------------------------------------------------------------------

.PRECIOUS: $(VENV)/.installed-%

$(READY): | $(VENV)/bin/python
	@$(PY) -m pip --version >/dev/null 2>&1 || python3 -m venv --clear $(VENV)
	@echo "== installing what requirements.lock pins into $(VENV) (a minute or so, once)"
	@$(call install,requirements.lock)
	@$(call finish,$@,base)

$(EXTRA): $(READY)
	@echo "== adding what requirements-extra.lock pins (JupyterLab and the benchmarks' peers)"
	@$(call install,requirements-extra.lock)
	@$(call finish,$@,extra)

$(VENV)/bin/python:
	@command -v python3 >/dev/null || { echo "python3 was not found: install Python 3.11 or later" >&2; exit 1; }
	@python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "python3 is $$(python3 -V 2>&1 | cut -d" " -f2): pontryagin needs Python 3.11 or later" >&2; exit 1; }
	@echo "== creating $(VENV) with $$(python3 -V)"
	@python3 -m venv $(VENV) || { rm -rf $(VENV); \
	  echo "python3 cannot create a virtual environment: install its venv module (python3-venv)" >&2; exit 1; }

# uv where it can be had, pip where it cannot; both check every hash of the lock.
define install
{ [ -x $(BIN)/uv ] || $(PY) -m pip install -q uv 2>/dev/null || echo "   uv cannot be had here: pip does it, more slowly" >&2; }; \
if [ -x $(BIN)/uv ]; then \
  $(BIN)/uv pip install -q --python $(PY) --require-hashes -r $(1); \
  $(BIN)/uv pip install -q --python $(PY) --no-deps --no-build-isolation --offline -e .; \
else \
  $(PY) -m pip install -q --require-hashes -r $(1); \
  $(PY) -m pip install -q --no-deps --no-build-isolation --no-index -e .; \
fi
endef

define finish
rm -f $(VENV)/.installed-$(2)-*; touch $(1)
endef
