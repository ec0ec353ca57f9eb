#!/usr/bin/env bash
# Builds the preset host-asan and runs its tests: the same ones, under the address and undefined-behaviour sanitizers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset host-asan
cmake --build --preset host-asan --parallel "$(nproc)"
exec ctest --preset host-asan --parallel "$(nproc)" --no-tests=error
