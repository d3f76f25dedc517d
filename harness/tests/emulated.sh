#!/usr/bin/env bash
# Runs an evalcts that was built for aarch64 under an emulator. The digest must be that of docs/accuracy.md, also on an
# ARMv8.0 processor (cortex-a53); `production` must round correctly; and the suite must not report anything unexpected.
# usage: emulated.sh FOLDER EMULATOR [ARGUMENT]..., in the root of the checkout; FOLDER has the programs
set -euo pipefail
programs=$1 emulator=("${@:2}") folder=$(dirname "$1")/emulated
fail() { echo "$*" >&2; exit 1; }

# `evalcts run` starts the evalcts-suite next to it, which this machine cannot execute. Therefore evalcts is linked into a
# folder in which evalcts-suite is a script that starts the emulator.
mkdir -p "$folder"
ln -f "$programs/evalcts" "$folder/evalcts"
printf '#!/bin/sh\nexec %s "%s" "$@"\n' "${emulator[*]}" "$programs/evalcts-suite" >"$folder/evalcts-suite"
chmod +x "$folder/evalcts-suite"
evalcts() { "${emulator[@]}" "$folder/evalcts" "$@"; }
rounding() { "${emulator[@]}" "$programs/../../production/tests/glevaluator_rounding" "$@"; }

expected=$(sed -n 's/.*"digest": "\([0-9a-f]\{16\}\)".*/\1/p' docs/accuracy.md)
[[ $expected ]] || fail "docs/accuracy.md has no digest"
for processor in max cortex-a53; do
  result=$(QEMU_CPU=$processor rounding digest)
  [[ $result == *"\"digest\": \"$expected\""* ]] || fail "$processor: docs/accuracy.md has another digest, $expected: $result"
done
rounding check --values 2000
evalcts run --implementation production --depth quick --strict --output "$folder/results"
