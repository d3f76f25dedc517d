#!/usr/bin/env bash
# Installs the library, moves it, and builds and runs programs against it, through find_package and pkg-config.
# check.sh BUILD EXAMPLES WORK FORTRAN(ON|OFF)
set -euo pipefail
build=$1 examples=$2 work=$3 fortran=$4
here=$(cd -- "$(dirname -- "$0")" && pwd)
fail() { echo "$*" >&2; exit 1; }

rm -rf "$work"
mkdir -p "$work"
cmake --install "$build" --component glevaluator_runtime --prefix "$work/runtime" >/dev/null
[[ $(find "$work/runtime" ! -type d -printf '%f\n' | sort | tr '\n' ' ') =~ ^libglevaluator\.so\.0\ libglevaluator\.so\.0\.[0-9.]+\ $ ]] ||
  fail "the component glevaluator_runtime is not the shared library alone"

cmake --install "$build" --component glevaluator --prefix "$work/installed" >/dev/null
[[ $fortran == OFF ]] || cmake --install "$build" --component glevaluator_fortran --prefix "$work/installed" >/dev/null
# The commands of the README install the documented files and nothing else.
mkdir "$work/documented"
grep '^cmake --install build/release' "$examples/../README.md" |
  sed -e "s|build/release|$build|" -e "s|PREFIX|$work/documented|" >"$work/documented.sh"
[[ -s $work/documented.sh ]] || fail "the README says no commands to install"
[[ $fortran == ON ]] || sed -i '/glevaluator_fortran/d' "$work/documented.sh"
bash -e "$work/documented.sh" >/dev/null
diff <(cd "$work/installed" && find . | sort) <(cd "$work/documented" && find . | sort) ||
  fail "the commands of the README install something else"
mkdir "$work/elsewhere"
prefix=$work/elsewhere/moved
mv "$work/installed" "$prefix"
places=$(grep -rlF -e "$build" -e "$work/installed" -e "$(dirname "$examples")" "$prefix" || true)
[[ ! $places ]] || fail "these name places of this machine: $places"
libraries=$(dirname "$(find "$prefix" -name libglevaluator.a)")

same() { # name, command...: it prints what the first one printed
  "${@:2}" >"$work/$1.txt"
  [[ -s $work/$1.txt ]] || fail "$1 prints nothing"
  cmp "$work/$1.txt" "$work/first.txt"
}

consume() { # name, CMake-option...
  local log=$work/$1.log
  cmake -G Ninja -S "$here" -B "$work/$1" -DCMAKE_PREFIX_PATH="$prefix" -DEXAMPLES="$examples" -DCMAKE_BUILD_TYPE=Release \
    "${@:2}" >"$log" 2>&1 || { cat "$log"; fail "$1: find_package fails"; }
  cmake --build "$work/$1" >"$log" 2>&1 || { cat "$log"; fail "$1 does not build"; }
}

# A project without a C++ compiler, and a project with one, which links its C programs without the C++ compiler.
CXX=false consume build -DFORTRAN="$fortran"
consume mixed -DMIXED=ON
[[ $(ninja -C "$work/mixed" -t commands curve_glevaluator) != *++* ]] || fail "the C++ compiler links"
"$work/build/curve_glevaluator" >"$work/first.txt"
grep -q '^    2.000000    1.500000' "$work/first.txt" || fail "that is not the middle of the curve"
same find_package_shared "$work/build/curve_glevaluator_shared"
[[ $(ldd "$work/build/curve_glevaluator") != *@(glevaluator|stdc++)* ]] || fail "the static library is not linked alone"
[[ $(ldd "$work/build/curve_glevaluator_shared") == *"$libraries/libglevaluator.so.0"* ]] || fail "not the installed library"
[[ $fortran == OFF ]] || same find_package_fortran "$work/build/curve_fortran"

# A version that is not installed is not found.
sed 's/glevaluator 0.2/glevaluator 99.0/' "$here/CMakeLists.txt" >"$work/CMakeLists.txt"
if cmake -G Ninja -S "$work" -B "$work/refused" -DCMAKE_PREFIX_PATH="$prefix" -DEXAMPLES="$examples" >"$work/refused.log" 2>&1; then
  fail "version 99 was found"
fi
grep -q 'requested version "99.0"' "$work/refused.log" || fail "version 99 is rejected for another reason"

command -v pkg-config >/dev/null || { echo "there is no pkg-config: without its part"; exit; }
export PKG_CONFIG_PATH=$libraries/pkgconfig
# shellcheck disable=SC2046 # words
{
  cc "$examples/curve.c" -o "$work/pc_shared" $(pkg-config --cflags --libs glevaluator)
  LD_LIBRARY_PATH=$libraries same pkg_config_shared "$work/pc_shared"
  cc -static "$examples/curve.c" -o "$work/pc_static" $(pkg-config --static --cflags --libs glevaluator)
  same pkg_config_static "$work/pc_static"
  # The first program of the installed README.
  awk '/^```/ { if (on) exit; on = /^```c$/; next } on' "$prefix/share/doc/glevaluator/README.md" >"$work/readme.c"
  cc -static "$work/readme.c" -o "$work/readme" $(pkg-config --static --cflags --libs glevaluator)
  [[ $("$work/readme" | tr '\n' ' ') == "0 0 0 0.90625 1.125 0 2 1.5 0 3.09375 1.125 0 4 0 0 2 1.5 0 " ]] ||
    fail "the program of the README prints something else"
  if [[ $fortran == ON ]]; then
    gfortran "$examples/curve.f" -o "$work/pc_fortran" $(pkg-config --cflags --libs fglev)
    LD_LIBRARY_PATH=$libraries same pkg_config_fortran "$work/pc_fortran"
  fi
}
