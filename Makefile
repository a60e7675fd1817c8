# `make help` lists the targets. Options of the program go through ARGS:
#     make chat ARGS="--scenario s2 --seed 3"

PYTHON ?= python3
ARGS ?=
RUNS ?= 200000
SEEDS ?= 1000
BIN := .venv/bin

export PYTHON
# Bytecode is kept in __pycache__ whatever the environment says: the tests alone take half a minute
# to compile, for each process that loads them, and start many programs of ours.
export PYTHONDONTWRITEBYTECODE :=

.DEFAULT_GOAL := help
.PHONY: help chat dashboard test drills storm planted mutants lint format schema diagram bench fuzz \
        clean runtime develop docs-tools browser test-browser screenshots docs

help: ## show this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-13s %s\n", $$1, $$2 }' Makefile

chat: runtime ## set up if need be, then ride and talk
	@$(BIN)/xavi chat $(ARGS)

dashboard: runtime ## set up if need be, then ride with a web page to look at
	@$(BIN)/xavi dashboard $(ARGS)

# The tests run even where lint finds fault, so that one run tells all; either failing fails it.
# Files are shared out in the order of tests/conftest.py, the longest first.
test: develop ## everything that must hold: lint, types, tests
	@status=0; \
	$(MAKE) --no-print-directory lint || status=1; \
	$(BIN)/python -m pytest -n 2 --dist loadfile --no-loadscope-reorder --ignore=tests/drills \
		--ignore=tests/programs --ignore=tests/browser $(ARGS) || status=1; \
	exit $$status

drills: develop ## programs as users start them, and what goes wrong between them (docs/drills.md)
	@$(BIN)/python -m pytest tests/programs tests/drills -n 2 --dist worksteal $(ARGS)

storm: develop ## SEEDS runs of the simulated world in which things go wrong (docs/simulated.md)
	@$(BIN)/python -m tests.simulated --seeds $(SEEDS) $(ARGS)

planted: develop ## plant faults that the simulated world has to notice (docs/simulated.md)
	@$(BIN)/python -m tests.simulated.planted $(ARGS)

# It takes half an hour or more; ARGS="--seed 7 --count 400" chooses other faults.
mutants: develop ## plant one-line faults and count those that tests notice (docs/mutants.md)
	@$(BIN)/python -m tests.mutants $(ARGS)

test-browser: browser ## the dashboard's page in a real browser
	@$(BIN)/python -m pytest tests/browser -n 2 --dist loadfile $(ARGS)

screenshots: browser ## take the pictures of the dashboard in docs/ anew
	@$(BIN)/python -m tests.browser.shots docs

lint: develop ## ruff and mypy
	@$(BIN)/python -m ruff check
	@$(BIN)/python -m ruff format --check
	@$(BIN)/python -m mypy

format: develop ## put the code in its standard form
	@$(BIN)/python -m ruff check --fix
	@$(BIN)/python -m ruff format

docs: docs-tools ## build the documentation site in build/site; runs the notebooks of examples/
	@$(BIN)/python -m sphinx -q -W --keep-going -b html -c docs/site . build/site $(ARGS)
	@echo "build/site/docs/index.html"

schema: develop ## write docs/plan_trace.schema.json, docs/messages/ and the page's types anew
	@$(BIN)/python -m xavi_dialogue.bus.schema docs
	@$(BIN)/python -m xavi_dialogue.dashboard.web.page_types

diagram: develop ## draw the conversation's states in ARCHITECTURE.md anew
	@$(BIN)/python -m xavi_dialogue.transcripts.state_diagram ARCHITECTURE.md

bench: runtime ## measure; ARGS="dialogue --json" chooses
	@$(BIN)/xavi bench $(or $(ARGS),plan)

fuzz: runtime ## try RUNS random texts on the parser
	@$(BIN)/xavi bench fuzz --runs $(RUNS) $(ARGS)

clean: ## remove the environment and every cache
	rm -rf .venv .setup.lock build dist *.egg-info .mypy_cache .ruff_cache .pytest_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

docs-tools:
	@sh scripts/setup.sh docs

runtime develop browser:
	@sh scripts/setup.sh $@
