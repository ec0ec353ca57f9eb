#!/usr/bin/env bash
# usage: rebuild_test.sh PAGE OUTPUT: is PAGE what host/web/build makes of the sources?
set -euo pipefail
"$(dirname "${BASH_SOURCE[0]}")/../../../host/web/build" "$2"
cmp "$1" "$2" || { echo "the page is not that of these sources: host/web/build builds it anew, then commit it" >&2; exit 1; }
