#!/usr/bin/env bash
# Builds the preset host-asan and runs its tests: the same ones, under the address and undefined-behaviour sanitizers.
# But for those that measure over many scenes: they run no code that the others do not.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset host-asan
cmake --build --preset host-asan --parallel "$(nproc)"
studies='^(Identity\.(Noise|Three)|HiddenEnds\.|Tour\.|alert_study|quality_table\.reaches)'
exec ctest --preset host-asan --parallel "$(nproc)" --no-tests=error --exclude-regex "$studies"
