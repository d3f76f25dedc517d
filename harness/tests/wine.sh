#!/usr/bin/env bash
# Builds the worker for Windows, makes its archive, and runs the suite through it under Wine: `production` and `reference` must
# give the records of this machine, except for the memory of maps. The OpenGL of Wine must be judged to the end; failures that the
# GL below it does not have are printed. A C program for Windows must show a failure.
# usage: wine.sh EVALCTS, in the root of the checkout
set -euo pipefail
# All workers share one display and one Wine: starting these takes longer than most tests, and a program that starts while Wine ends
# may hang.
if [[ ! ${EVALCTS_STAGE_DISPLAY:-} ]]; then EVALCTS_STAGE_DISPLAY=yes exec xvfb-run -a bash "$0" "$@"; fi
evalcts=$1 folder=$PWD/build/mingw/results
fail() { echo "$*" >&2; exit 1; }
export WINEPREFIX=$PWD/build/mingw/wine WINEDEBUG=-all

cmake --preset mingw >/dev/null
# Workers that start at once would all make the prefix.
wine wineboot --init 2>/dev/null
coproc KEEPER { wine cmd; }
trap 'wineserver -k || true' EXIT
cmake --build --preset mingw
cpack --preset mingw
rm -rf "$folder" build/mingw/archive
mkdir -p build/mingw/archive
(cd build/mingw/archive && cmake -E tar xf ../evalcts-*.zip)
worker="wine $PWD/build/mingw/archive/evalcts-worker.exe"
[[ -f ${worker#wine } ]] || fail "the archive has no worker: $(find build/mingw/archive)"

python3 harness/tests/own_records.py "$evalcts" "$worker" "$folder" --except Contexts.MemoryOfMaps
wine build/mingw/production/examples/circle.exe | grep -q "4000 points"
bash harness/tests/digest.sh wine build/mingw/production/tests/glevaluator_rounding.exe
wine build/mingw/production/tests/glevaluator_rounding.exe check --values 2000

# The GL of Wine is that of libGL, so its known bugs show here as well.
"$evalcts" run --implementation glx --depth quick --no-bugs --output "$folder/glx" >/dev/null || (($? == 1))
"$evalcts" run --library opengl32.dll --depth quick --no-bugs --output "$folder/wgl" --worker "$worker" || (($? == 1))
python3 - "$folder" <<'X'
import json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
def failures(file):
    result = json.loads((folder / file).read_text())
    if result["status"] != "complete":
        sys.exit(f"{file}: {result['status']}, {result.get('reason')}")
    return {test["name"] for test in result["tests"] if test["verdict"] in ("fail", "crash", "timeout")}
surplus = failures("wgl/results-library.json") - failures("glx/results-glx.json")
print("only under Wine:", ", ".join(sorted(surplus)) or "nothing")
X

# The program makes a context of WGL and shows a known bug of Mesa: the ends of a mesh are not where EvalCoord is.
test=$(python3 - "$folder/wgl/results-library.json" <<'X'
import json, sys
tests = json.load(open(sys.argv[1]))["tests"]
print(next(test["name"] for test in tests if test["verdict"] == "fail" and test["name"].startswith("Mesh2.EndsAreExact")))
X
)
"$evalcts" reproduce "library:$test" --run "$folder/wgl" --worker "$worker" --output "$folder/program.c" >/dev/null
x86_64-w64-mingw32-gcc -Wall -Wextra -Werror -o "$folder/program.exe" "$folder/program.c" -lgdi32
code=0
wine "$folder/program.exe" || code=$?
[[ $code == 1 ]] || fail "the C program of $test ends with exit code $code"
