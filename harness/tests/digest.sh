#!/usr/bin/env bash
# The digest of the library must be that of docs/accuracy.md, on every processor and system.
# usage: digest.sh COMMAND [ARGUMENT]..., in the root of the checkout; the command starts glevaluator_rounding
set -euo pipefail
expected=$(sed -n 's/.*"digest": "\([0-9a-f]\{16\}\)".*/\1/p' docs/accuracy.md)
result=$("$@" digest)
[[ $expected && $result == *"\"digest\": \"$expected\""* ]] ||
  { echo "the digest of docs/accuracy.md is ${expected:-missing}, but $* gives $result" >&2; exit 1; }
