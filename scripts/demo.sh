#!/usr/bin/env bash
# Usage: scripts/demo.sh [OPTION OF 'ridgeloc run']...    for example: scripts/demo.sh --trials 100000
# Installs what is missing, builds the program alone in the shortest time, runs the studies fig3a and fig3bcd and draws their four figures into
# out/ as SVG and PDF.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then
  sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}"
  exit 0
fi

"$root/scripts/build.sh" --quick >&2

ridgeloc="$root/build/quick/app/ridgeloc"
out="$root/out"
studies=(fig3a fig3bcd)
figures=(fig3a fig3b fig3c fig3d)

"$ridgeloc" run "${studies[@]}" -o "$out/" "$@"
products=()
for study in "${studies[@]}"; do
  "$ridgeloc" plot "$out/$study.h5" -o "$out/" --format svg --format pdf >/dev/null
  products+=("$out/$study.h5")
done
for figure in "${figures[@]}"; do products+=("$out/$figure.svg" "$out/$figure.pdf"); done

for product in "${products[@]}"; do
  if [[ ! -s "$product" ]]; then
    echo "demo: $product was not made" >&2
    exit 1
  fi
done
echo "demo: results and figures" >&2
printf '%s\n' "${products[@]}"
