# Two targets are for everybody: `make run` and `make test`. The others are steps of these, or for contributors.

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
PORT   ?= 8080
DATA   ?= data

# Python keeps what it has compiled: the tests start many processes.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := run
.PHONY: run test test-all test-frontend test-vscode fuzz check check-backend check-frontend check-types format lock system generate pictures clean

## run: set everything up, then serve the IDE with a running example machine and print its address
run: $(VENV)/.ready frontend/dist/.ready
	$(BIN)/tappet serve --port $(PORT) --data $(DATA) --example bottling --local-link

# Steps that need nothing of each other run beside each other; what each one prints stays together.
BESIDE := $(MAKE) --no-print-directory -j 2 $(if $(filter output-sync,$(.FEATURES)),--output-sync=target)
CHECKS := check-frontend check-backend check-types

# Browsers want the machine for themselves: their tests come last, two at a time. There are few and they are long:
# who has nothing left to do takes over some of the other's.
PARALLEL := -n 2 --dist loadfile
BROWSERS := -n 2 --dist worksteal

## test: all fast tests, those in a real browser included
test:
	@$(BESIDE) system $(CHECKS) test-frontend test-vscode frontend/dist/.ready
	$(BIN)/python -m pytest --ignore tests/e2e -m "not slow" $(PARALLEL)
	$(BIN)/python -m pytest tests/e2e -m "not slow" $(BROWSERS)

## test-all: the slow suites as well
test-all:
	@$(BESIDE) system $(CHECKS) test-frontend test-vscode frontend/dist/.ready
	$(BIN)/python -m pytest --ignore tests/e2e $(PARALLEL)
	$(BIN)/python -m pytest tests/e2e $(BROWSERS)

## fuzz: what reads foreign texts, for SECONDS each; guided by coverage where `pip install atheris` works
FUZZ    ?= lexer parser checker compiler il plcopen twincat export text folder archive library package frame literal gcode \
           editor messages door-online door-events door-lsp door-view door-wire
SECONDS ?= 300
fuzz: $(VENV)/.ready
	for name in $(FUZZ); do $(BIN)/python -m tests.fuzz $$name --seconds $(SECONDS) --to build/fuzz || exit 1; done

## check: format, lint, types, imports
check:
	@$(BESIDE) $(CHECKS)

check-backend: $(VENV)/.ready
	$(BIN)/ruff format --check backend tests
	$(BIN)/ruff check backend tests
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo

check-frontend: frontend/node_modules/.ready
	cd frontend && npm run --silent lint

check-types: frontend/node_modules/.ready
	cd frontend && npm run --silent typecheck

test-frontend: frontend/node_modules/.ready
	cd frontend && npm run --silent test

## test-vscode: the extension for VS Code, built, checked and tested
test-vscode: plugins/vscode/node_modules/.ready
	cd plugins/vscode && npm run --silent typecheck && npm run --silent build && npm run --silent test

format: $(VENV)/.ready
	$(BIN)/ruff format backend tests
	$(BIN)/ruff check --fix backend tests

## lock: resolve pyproject.toml again into requirements.lock
lock: $(VENV)/.ready
	$(BIN)/pip install --quiet uv
	$(BIN)/uv pip compile pyproject.toml --group dev --universal --python-version 3.11 --quiet \
	  --custom-compile-command "make lock" -o requirements.lock

## generate: what is made from the sources: OpenAPI, client types, pages of the diagnostics, manual of the motion library
generate: $(VENV)/.ready frontend/node_modules/.ready
	$(BIN)/python -m tappet.server.print_openapi > frontend/src/api/openapi.json
	cd frontend && npm run --silent generate
	$(BIN)/python -m tappet.lang.diagnostic_pages
	$(BIN)/python -m tappet.manual
	$(BIN)/python -m tappet.iec.typescript
	$(BIN)/python -m tappet.iec.task_typescript
	$(BIN)/python -m tappet.iec.textmate
	$(BIN)/python -m tappet.cnc.dialect > frontend/src/kinds/cnc/dialect.json
	$(BIN)/python -m tappet.project.axes.channels > frontend/src/kinds/axis/channels.json
	$(BIN)/python -m tappet.project.axis_groups.kinematics > frontend/src/kinds/axis_group/kinematics.json
	$(BIN)/python -m tappet.lang.languages.il.typescript
	$(BIN)/python tests/iec/iec_texts.py
	$(BIN)/python tests/lang/il_texts.py
	$(BIN)/python tests/project/placement_answers.py
	$(BIN)/python tests/projects/axis_group_curve.py

$(VENV)/.ready: requirements.lock pyproject.toml
	@test -d $(VENV) || $(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --disable-pip-version-check -r requirements.lock
	$(BIN)/pip install --quiet --disable-pip-version-check --no-deps -e .
	$(BIN)/python -m compileall -q backend/tappet
	@touch $@

frontend/node_modules/.ready: frontend/package-lock.json frontend/package.json
	cd frontend && npm ci --no-audit --no-fund --loglevel=error
	@touch $@

plugins/vscode/node_modules/.ready: plugins/vscode/package-lock.json plugins/vscode/package.json
	cd plugins/vscode && npm ci --no-audit --no-fund --loglevel=error
	@touch $@

FRONTEND_SOURCES := $(shell find frontend/src frontend/public frontend/index.html frontend/vite.config.ts -type f 2>/dev/null)

frontend/dist/.ready: frontend/node_modules/.ready $(FRONTEND_SOURCES)
	cd frontend && npm run --silent build
	@touch $@

## system: the browser and the database server that the tests drive (Debian's packages)
system:
	@.ci/system

## pictures: the screenshots of the README and docs
pictures: $(VENV)/.ready frontend/dist/.ready system
	TAPPET_PICTURES=docs/images $(BIN)/python -m pytest tests/e2e/test_pictures.py

clean:
	rm -rf $(VENV) frontend/node_modules frontend/dist plugins/vscode/node_modules plugins/vscode/dist build dist
