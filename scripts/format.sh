#!/usr/bin/env bash
# Usage: scripts/format.sh [--check] [--help]
# Formats all C++ files that git knows with the clang-format that .clang-format is written for, 14; with --check tells
# which are not formatted and fails if any is.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

mode=(-i)
case "${1:-}" in
  "") ;;
  --check) mode=(--dry-run -Werror) ;;
  -h | --help) sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}"; exit 0 ;;
  *) echo "format: unknown option '$1'; allowed: --check, --help" >&2; exit 2 ;;
esac

"$root/scripts/setup.sh" --format
cd "$root"
git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format-14 "${mode[@]}"
