#!/usr/bin/env bash
# Runs the tests with the lowest versions of the dependencies that pyproject.toml declares, in a copy of the last commit.
# Lint, types and floors are left out: they are judged by the tools of today. Options go to pytest.
set -euo pipefail
checkout="$(cd "$(dirname "$0")/../.." && pwd)"
export FOPARQ_SHARED="${FOPARQ_SHARED:-$(dirname "$checkout")/shared}"
copy="$(mktemp -d)"
trap 'rm -rf "$copy"' EXIT

git clone --quiet "$checkout" "$copy"
cd "$copy"
uv sync --quiet --resolution lowest-direct
uv pip list
.venv/bin/python -m pytest -q -p no:cacheprovider --deselect tests/test_house.py "$@"
