#!/usr/bin/env bash
# Runs parsers_fuzzer for a minute, or $EVALCTS_FUZZ_SECONDS, on seeds from the repository. The first byte of a seed says
# which parser reads the rest. The corpus and the inputs that fail are kept in FOLDER.
# usage: parsers_fuzzer.sh PROGRAM FOLDER, in the root of the checkout
set -euo pipefail
program=$1 folder=$2 seeds=$2/seeds
rm -rf "$seeds"
mkdir -p "$folder/corpus" "$seeds"

seed() { # first byte, file...
  local file
  for file in "${@:2}"; do { printf '%s' "$1"; cat "$file"; } >"$seeds/$1-${file##*/}"; done
}
seed v vectors/tests/sample/*.json
seed r reports/tests/sample/results-*.json
python3 -c 'import json, pathlib, sys
for bug in json.loads("[" + pathlib.Path("suites/bugs/mesa.json").read_text() + "]"):
    for program in bug.get("programs", []):
        if "name" in program:
            seed = pathlib.Path(sys.argv[1], "c-" + program["name"])
            seed.write_text("c" + json.dumps(program["commands"]))' "$seeds"
printf 'b# version: Mesa 20.3 to 24.3\n# implementation: egl, glx\n\n# bug: mesa-a.\n# why\nA.B/@(C|D)*,Fail\nA.E,Pass\n\f%s\f%s\f%s' \
  $'A.B*,quick,3-0c515077b74857d4\n' $'# hangs\n^C\\.\n' $'# now and then\n^A\\.(B|C)/\n' >"$seeds/b"
printf 'amap1_eval.ordinary.1 0x1p+0 -2.5\nmap1_eval.ordinary.2 skip\n# words\nx inf nan\n' >"$seeds/a"
printf 'lrun\n--implementation\nosmesa\n--shard\n1/2\n--jobs=2\n--interpretation\nC-V-GETN=x\n' >"$seeds/l-run"
printf 'lulp\n--orders\n2\n--points=0x1p-3,0.7\n--at\n0.3\n--values=7' >"$seeds/l-ulp"
printf 'lvectors\nemti\n--kind\ngrid\n' >"$seeds/l-vectors"

EVALCTS_VECTORS_SAMPLE=$PWD/vectors/tests/sample/map1_eval.json exec "$program" \
  -max_total_time="${EVALCTS_FUZZ_SECONDS:-60}" -timeout=20 -rss_limit_mb=4096 -max_len=20000 -print_final_stats=1 \
  -artifact_prefix="$folder/" "$folder/corpus" "$seeds"
