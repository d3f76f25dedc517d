#!/usr/bin/env bash
# Builds the worker for aarch64 and runs the suite through it under QEMU: `production` and `reference` must give the records of
# this machine, and the OSMesa of the distribution for that processor must have no new failures.
# usage: aarch64_suite.sh EVALCTS, in the root of the checkout
set -euo pipefail
evalcts=$1 build=$PWD/build/aarch64
root=$build/system/root
# shellcheck source-path=SCRIPTDIR source=../../packaging/clean-root.sh
. packaging/clean-root.sh

cmake --preset aarch64 >/dev/null
cmake --build --preset aarch64 --target evalcts-suite
if [[ ! -e $root/usr ]]; then
  rm -rf "$build/system"
  mkdir -p "$build/system"
  # shellcheck source=/dev/null
  bootstrap "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$build/system" --variant=extract --architectures=arm64 \
    --include=libosmesa6,libstdc++6 || { echo "no root of arm64 could be made" >&2; exit 1; }
fi
worker="qemu-aarch64 -L $root $build/harness/cli/evalcts-suite"
python3 harness/tests/own_records.py "$evalcts" "$worker" "$build/results"
# softpipe, because llvmpipe compiles for the processor that QEMU imitates.
"$evalcts" run --library "$root/usr/lib/aarch64-linux-gnu/libOSMesa.so.8" --depth quick --no-bugs --strict \
  --output "$build/results/osmesa" --worker "env GALLIUM_DRIVER=softpipe DRAW_USE_LLVM=0 $worker"
