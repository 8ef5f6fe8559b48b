# Commands for people who work on the extension; `make` alone lists them.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help
.PHONY: help demo test test-window docs figures pictures lint zip bench bench-coacd bench-hulls bench-hull-errors bench-physics bench-outlines bench-ablation \
  bench-clouds bench-cuts bench-objects bench-shells bench-speed bench-window contact-sheet clean psb stress venv development

# BPY=4.2 | 5.0 | 5.2 chooses the bpy module, PYTHON=path the interpreter.
BPY ?=
PYTHON ?=
VENV ?= .venv$(if $(BPY),-$(BPY))
export BPY PYTHON

# The checkout is what gets packed: no caches in it.
PYTHON_HERE := PYTHONDONTWRITEBYTECODE=1 $(VENV)/bin/python

help: ## List these commands
	@echo "make COMMAND [BPY=4.2|5.0|5.2] [PYTHON=path of a Python 3.11 or 3.13]"
	@echo
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-18s %s\n", $$1, $$2}' Makefile

demo: venv ## Decompose Blender's monkey; results in build/demo/
	@mkdir -p build/demo
	@echo "Making Suzanne, Blender's monkey, with two subdivisions: build/demo/suzanne.obj"
	@$(PYTHON_HERE) .tools/make_suzanne.py build/demo/suzanne.obj >/dev/null
	@echo "Decomposing her into weakly convex parts"
	@$(PYTHON_HERE) . build/demo/suzanne.obj --output build/demo/suzanne.blend \
	  --report build/demo/suzanne.json --picture build/demo/suzanne.png
	@echo
	@echo "build/demo/suzanne.blend   the model with its parts, for Blender"
	@echo "build/demo/suzanne.png     a picture of the parts"
	@echo "build/demo/suzanne.json    the numbers"

test: development ## Run all tests that need no window
	@echo "Testing with $$($(VENV)/bin/python -V) and $$($(VENV)/bin/pip list 2>/dev/null | awk '/^(bpy|numpy|scipy) / {printf "%s %s  ", $$1, $$2}')"
	@WCD_REQUIRE_BLENDER=1 $(PYTHON_HERE) .tools/run_tests.py $(PYTEST)

stress: development ## Work on objects at random, 10,000 steps: STEPS=number
	@WCD_REQUIRE_BLENDER=1 WCD_STRESS_STEPS=$(or $(STEPS),10000) $(PYTHON_HERE) -m pytest -q -n0 \
	  tests/blender/bridge/test_random_edits.py $(PYTEST)

test-window: development ## Drive a Blender that has a window: BLENDER=command that starts it
	@[ -n "$(BLENDER)" ] || { echo "Name the command that starts Blender: BLENDER=blender"; exit 1; }
	@BLENDER="$(BLENDER)" $(PYTHON_HERE) -m pytest tests/window $(PYTEST)

docs: ## Build the pages as a site into build/docs/
	@wanted=.tools/requirements/docs.txt; made=.venv-docs/made-by-make.txt; \
	cmp -s $$wanted $$made || { \
	  python=$$(.tools/find_python 3.13 $(PYTHON) || .tools/find_python 3.11 $(PYTHON)); \
	  echo "Making .venv-docs: $$(xargs <$$wanted)"; \
	  rm -rf .venv-docs; $$python -m venv .venv-docs; \
	  .venv-docs/bin/pip install -qq --disable-pip-version-check -r $$wanted; \
	  cp $$wanted $$made; }
	@PYTHONDONTWRITEBYTECODE=1 NO_MKDOCS_2_WARNING=1 .venv-docs/bin/mkdocs build --strict --clean \
	  --config-file docs/site/mkdocs.yml
	@echo "build/docs/index.html"

figures: venv ## Draw the figures of docs/ anew: FIGURES="hands ranks" for some of them
	@$(PYTHON_HERE) docs/figures/make_figures.py $(FIGURES)

pictures: ## Take the pictures of the window anew: BLENDER=command
	@[ -n "$(BLENDER)" ] || { echo "Name the command that starts Blender: BLENDER=blender"; exit 1; }
	@for subject in looks sight explode pick cut; do \
	  $(BLENDER) --python tests/window/drive.py -- $$subject; done
	@cp build/window/looks-before.png docs/pictures/sidebar.png
	@cp build/window/looks-after.png docs/pictures/parts.png
	@cp build/window/sight-clicked.png docs/pictures/sight.png
	@cp build/window/explode-exploded.png docs/pictures/exploded.png
	@cp build/window/pick-pie.png docs/pictures/picking.png
	@cp build/window/cut-solid.png docs/pictures/cut_faces.png

lint: development ## Check the format, the rules of the code and the types
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/ruff check .
	@echo "mypy core operators ui"  # by the package's name, whatever the checkout's is
	@checkout=$$PWD; mypy=$$(realpath -s $(VENV)/bin/mypy); links=$$(mktemp -d); \
	ln -s "$$checkout" "$$links/weak_convex_decomposition"; cd "$$links"; \
	trap 'rm -r "$$links"' EXIT; "$$mypy" --config-file "$$checkout/pyproject.toml" \
	  --cache-dir "$$checkout/.mypy_cache" weak_convex_decomposition/{core,operators,ui}

zip: venv ## Build the installable zips into build/
	@$(PYTHON_HERE) .tools/extension.py build --output build

bench: psb venv ## Measure quality: make bench PSB=directory of the Princeton benchmark
	@PYTHONPATH=tests/support $(PYTHON_HERE) tests/benchmarks/rand_index.py "$(PSB)" $(BENCH)

bench-coacd: psb venv ## Segment the benchmark with CoACD: PSB=directory SEGMENTS=folder
	@[ -n "$(SEGMENTS)" ] || { echo "Name the folder to write to: SEGMENTS=folder"; exit 1; }
	@$(VENV)/bin/python -m venv .venv-coacd
	@.venv-coacd/bin/pip install -qq --disable-pip-version-check coacd==1.0.14 numpy scipy
	@PYTHONPATH=tests/support PYTHONDONTWRITEBYTECODE=1 .venv-coacd/bin/python \
	  tests/benchmarks/coacd_segments.py "$(PSB)" "$(SEGMENTS)"

bench-hulls: venv ## Compare hulls with CoACD's and V-HACD's: MESHES=directory
	@[ -n "$(MESHES)" ] || { echo "Name the directory of meshes: MESHES=directory"; exit 1; }
	@$(VENV)/bin/python -m venv .venv-hulls
	@.venv-hulls/bin/pip install -qq --disable-pip-version-check \
	  coacd==1.0.14 vhacdx trimesh embreex numpy pillow scipy
	@PYTHONPATH=tests/support PYTHONDONTWRITEBYTECODE=1 .venv-hulls/bin/python \
	  tests/benchmarks/hulls/rivals.py "$(MESHES)" build/bench_hulls "$(VENV)/bin/python"

bench-hull-errors: development ## Measure the stated errors of hulls again: MESHES=directory SHAPES="HULL BOX"
	@[ -n "$(MESHES)" ] || { echo "Name the directory of meshes: MESHES=directory"; exit 1; }
	@PYTHONPATH=tests/support $(PYTHON_HERE) tests/benchmarks/hulls/hull_errors.py "$(MESHES)" $(SHAPES)

bench-physics: development ## Drop models as compounds of hulls, balls on them: FILES="chair.off elk.off"
	@[ -n "$(FILES)" ] || { echo "Name the files of models: FILES=\"chair.off elk.off\""; exit 1; }
	@PYTHONPATH=tests/support $(PYTHON_HERE) tests/benchmarks/physics.py $(FILES)

bench-ablation: psb venv ## Measure quality with each stage switched off: PSB=directory
	@PYTHONPATH=tests/support:tests/benchmarks $(PYTHON_HERE) tests/benchmarks/ablation/measure.py "$(PSB)" $(BENCH)

bench-clouds: psb venv ## Measure quality of point clouds beside meshes: PSB=directory
	@PYTHONPATH=tests/support $(PYTHON_HERE) tests/benchmarks/clouds.py "$(PSB)" $(BENCH)

bench-outlines: venv ## Measure quality of flat shapes: OUTLINES=directory of the 2D Shape Structure Dataset
	@[ -n "$(OUTLINES)" ] || { echo "Name the directory of outlines: OUTLINES=directory"; exit 1; }
	@PYTHONPATH=tests/support $(PYTHON_HERE) tests/benchmarks/outlines.py "$(OUTLINES)" $(BENCH)

bench-cuts: development ## Cut the faces of random meshes, and check what must stay: CUTS=200
	@PYTHONPATH=tests/support $(PYTHON_HERE) tests/benchmarks/cut_faces.py $(CUTS)

bench-speed: venv ## Measure seconds and memory on Suzanne
	@PYTHONPATH=tests/support $(PYTHON_HERE) tests/benchmarks/speed/suzanne.py

bench-shells: psb venv ## Measure shapes of many shells beside the benchmark's median model: PSB=directory
	@PYTHONPATH=tests/support:tests/benchmarks $(PYTHON_HERE) tests/benchmarks/speed/many_shells.py "$(PSB)"

bench-window: ## Measure seconds and freezes in a window: BLENDER=command that starts it
	@[ -n "$(BLENDER)" ] || { echo "Name the command that starts Blender: BLENDER=blender"; exit 1; }
	@for start in idle at-once ten-million hulls; do \
	  $(BLENDER) --python tests/window/drive.py -- tests/benchmarks/speed/in_window.py $$start; done
	@$(BLENDER) --python tests/window/drive.py -- tests/benchmarks/speed/live_in_window.py

bench-objects: venv ## Measure files of many small objects: OBJECTS=1000
	@PYTHONPATH=tests/support $(PYTHON_HERE) tests/benchmarks/speed/many_objects.py $(OBJECTS)

contact-sheet: psb venv ## Draw the benchmark's models in build/contact_sheet/: PSB=directory
	@PYTHONPATH=tests/support $(PYTHON_HERE) tests/benchmarks/contact_sheet.py "$(PSB)" \
	  build/contact_sheet $(BENCH)

clean: ## Remove everything that these commands made
	rm -rf build wheels .venv .venv-* .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

psb:
	@[ -n "$(PSB)" ] || { echo "Name the benchmark's directory: make $(MAKECMDGOALS) PSB=directory"; exit 1; }

venv:
	@.tools/make_venv "$(VENV)"

development:
	@.tools/make_venv "$(VENV)" development
