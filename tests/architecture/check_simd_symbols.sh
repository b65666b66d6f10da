#!/usr/bin/env bash
# What a source file that is compiled for one instruction set emits out of line must name that instruction set: the linker
# keeps one copy of a function of the same name, and ordinary code would then run instructions that the processor lacks.
# Usage: check_simd_symbols.sh OBJECT...
set -euo pipefail
failures=0
for object in "$@"; do
  case "$object" in
    *_avx512.dir/*) tag='xsimd::avx512|Isa\)2' ;;
    *_avx2.dir/*) tag='xsimd::fma3<xsimd::avx2>|Isa\)1' ;;
    *) continue ;;
  esac
  while read -r symbol; do
    echo "$object: $symbol" >&2
    failures=$((failures + 1))
  done < <(nm --demangle "$object" | sed -nE 's/^[0-9a-f]+ [WT] //p' | grep -vE "$tag|^DW\.ref\." || true)
done
((failures == 0)) || exit 1
echo "every symbol names its instruction set"
