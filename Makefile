# Two commands do everything on a fresh machine with Python 3.11: `make serve` and `make test`.
VENV ?= .venv
PYTHON ?= $(shell command -v python3.11 || command -v python3)
BIN := $(VENV)/bin
PIP_INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile

# Modules are compiled when they are first loaded, not all of them while they are installed, which would take a minute;
# so what was compiled has to be kept, also where the environment of whoever calls make says otherwise.
export PYTHONDONTWRITEBYTECODE :=

.PHONY: serve test promises fuzz page-check docs-check setup-check docker-check training-check wheel wheel-check schemathesis clients check format openapi train evaluate evaluate-human bench bench-reliability bench-load bench-page bench-language bench-teaching bench-planning clean

serve: $(VENV)/.serve
	$(BIN)/cqltl serve

test: $(VENV)/.dev
	$(BIN)/python -m pytest -n 2 --dist loadscope --no-loadscope-reorder

promises: $(VENV)/.dev  # what is promised of jobs, on both executors: processes and database servers are killed
	$(BIN)/python -m pytest -m 'long or not long' tests/service/jobs

fuzz: $(VENV)/.dev  # the tests with random examples never seen before
	CQLTL_FUZZ=1 $(BIN)/python -m pytest

wheel: $(VENV)/.serve  # into dist/
	$(BIN)/python -m pip wheel --quiet --no-deps --wheel-dir dist .

wheel-check: $(VENV)/.dev  # the wheel has everything, and serves in an environment of its own
	$(BIN)/python -m pytest -m long tests/packaging

page-check: $(VENV)/.dev  # the page in Chromium: what a visitor does, who can use it, how it looks
	$(BIN)/python -m pytest -m long tests/page

docs-check: $(VENV)/.dev  # all that README.md and docs/*.md tell their readers to type, against servers of their own; a minute
	$(BIN)/python -m pytest -m 'long or not long' tests/documents --ignore-glob '*/test_setup.py' --ignore-glob '*/test_docker.py' --ignore-glob '*/test_training.py'

setup-check: $(VENV)/.dev  # what they tell them of setting up, in a new copy with environments of its own; ten minutes
	$(BIN)/python -m pytest -m long tests/documents/test_setup.py

docker-check: $(VENV)/.dev  # what they tell them of Docker, where there is Docker with Compose; ten minutes
	$(BIN)/python -m pytest -m long -rs tests/documents/test_docker.py

training-check: $(VENV)/.dev  # what they tell them of training and measuring networks, with little of everything; quarter of an hour
	$(BIN)/python -m pytest -m long tests/documents/test_training.py

schemathesis: $(VENV)/.dev  # ten minutes, or CQLTL_SCHEMATHESIS_S seconds, of requests made up from openapi.yaml
	$(BIN)/python -m pytest -m long tests/service/http/test_schemathesis.py

clients: $(VENV)/.dev  # clients generated from openapi.yaml, in build/clients, driven against a live server
	$(BIN)/python -m pytest tests/clients

check: $(VENV)/.dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/cqltl openapi --check openapi.yaml

format: $(VENV)/.dev
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

openapi: $(VENV)/.dev
	$(BIN)/cqltl openapi --output openapi.yaml

train: $(VENV)/.dev  # this and the next two: OPTIONS=--quick for a tiny run, to see that everything works
	$(BIN)/python -m models.language.train $(OPTIONS)

evaluate: $(VENV)/.dev
	$(BIN)/python -m models.language.evaluate $(OPTIONS)

evaluate-human: $(VENV)/.dev  # commands that people wrote: DATA is the folder with the published files
	$(BIN)/python -m models.language.human --data '$(DATA)' $(OPTIONS)

bench: $(VENV)/.dev
	$(BIN)/python -m benchmarks.table2
	$(BIN)/python -m benchmarks.translate
	$(BIN)/python -m benchmarks.startup
	$(BIN)/python -m benchmarks.hostile
	$(BIN)/python -m benchmarks.slow_clients

bench-reliability: $(VENV)/.dev  # 200 kills, 8 writers, 10,000 requests and 500 jobs, plans stopped; about 40 minutes
	$(BIN)/python -m benchmarks.reliability
	$(BIN)/python -m benchmarks.stopping
	$(BIN)/python -m pytest -m long tests/benchmarks

bench-load: $(VENV)/.dev  # how much can be served, beside an empty endpoint; needs wrk
	$(BIN)/python -m benchmarks.load

bench-page: $(VENV)/.dev  # how soon the page is painted, and its first plan there; needs Chromium
	$(BIN)/python -m benchmarks.page

bench-language: $(VENV)/.dev  # commands in people's own words
	$(BIN)/python -m benchmarks.language

bench-teaching: $(VENV)/.dev  # tasks taught with one example, and with five
	$(BIN)/python -m benchmarks.teaching --draws 2
	$(BIN)/python -m benchmarks.teaching --untaught

bench-planning: $(VENV)/.dev  # against other planners; about half an hour
	$(PIP_INSTALL) -e '.[dev,bench]'
	$(BIN)/python -m benchmarks.planning --large --limit 420 --memory 16 --json docs/planning/results.json --plot docs/planning

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

$(VENV)/.serve: pyproject.toml | $(BIN)/python
	$(PIP_INSTALL) -e .
	$(BIN)/python -m models.planning
	touch $@

$(VENV)/.dev: pyproject.toml | $(BIN)/python
	$(PIP_INSTALL) -e '.[dev]'
	$(BIN)/python -m models.planning
	touch $@ $(VENV)/.serve

clean:
	rm -rf $(VENV) build dist *.egg-info
