#!/usr/bin/env bash
# Configures production/ alone: by the commands of its README, and as a part of projects that include it by
# add_subdirectory, which use the static library, and by FetchContent, which use the shared one. Compilation takes a fraction of
# the time for one instruction set and without optimization; the projects that include it compile the sources in groups, and
# the README's commands each file by itself.
# alone.sh ROOT WORK
set -euo pipefail
root=$1 work=$2
fail() { echo "$*" >&2; exit 1; }
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "fails: $*"; }; }
export CXXFLAGS=-DHWY_COMPILE_ONLY_STATIC CMAKE_GENERATOR=Ninja CMAKE_BUILD_TYPE=None

rm -rf "$work"
mkdir -p "$work"
version() { sed -n "s/^ *project($2 VERSION \([0-9.]*\) .*/\1/p" "$root/$1"; }
[[ -n $(version CMakeLists.txt evalcts) && $(version CMakeLists.txt evalcts) == $(version production/CMakeLists.txt glevaluator) ]] ||
  fail "production/CMakeLists.txt has another version than CMakeLists.txt"

# The first commands of "Installing", with other paths.
awk '/^## Installing/ { here = 1 } here && /^```/ { if (on) exit; on = 1; next } on' "$root/production/README.md" |
  sed -e "s|build/glevaluator|$work/build|g" -e "s|PREFIX|$work/installed|g" >"$work/commands.sh"
[[ $(grep -c '^cmake' "$work/commands.sh") == 3 ]] || fail "the README has other commands than three of cmake"
(cd "$root" && quietly bash -e "$work/commands.sh")
for file in include/glevaluator.h include/glevaluator.hpp lib/pkgconfig/glevaluator.pc share/doc/glevaluator/LICENSE; do
  [[ -f $(find "$work/installed" -path "*${file#lib/}") ]] || fail "$file is not installed"
done
[[ $(find "$work/installed" -name 'libglevaluator.*' | wc -l) -ge 4 ]] || fail "the libraries are not installed"

# Without Highway's headers, CMake says which package has them. A folder that is given need not be found.
highway=$(sed -n 's/^GLEVALUATOR_HIGHWAY_INCLUDE_DIR:PATH=//p' "$work/build/CMakeCache.txt")
without=(cmake -S "$root/production" -B "$work/without" "-DCMAKE_IGNORE_PATH=$highway" -DGLEVALUATOR_BUILD_TESTS=OFF)
"${without[@]}" >"$work/log" 2>&1 && fail "is configured without Highway"
tr -s '\n ' ' ' <"$work/log" | grep -q 'Install the package libhwy-dev (Debian' ||
  fail "names no package that has Highway's headers: $(cat "$work/log")"
quietly "${without[@]}" -DGLEVALUATOR_HIGHWAY_INCLUDE_DIR="$highway"

cat >"$work/program.c" <<'END'
#include <glevaluator.h>
int main(void) { return glevGetTargetName(0) == 0; }
END
embed() { # name, library, commands of CMake that make the library known
  mkdir -p "$work/$1"
  cat >"$work/$1/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.21)
project(consumer C CXX)
$3
foreach(library glevaluator glevaluator_shared)
  if(NOT TARGET glevaluator::\${library})
    message(FATAL_ERROR "there is no glevaluator::\${library}")
  endif()
endforeach()
add_executable(program ../program.c)
target_link_libraries(program PRIVATE glevaluator::$2)
install(TARGETS program)
END
  quietly cmake -S "$work/$1" -B "$work/$1/build" -DCMAKE_UNITY_BUILD=ON
  quietly cmake --build "$work/$1/build" --target program
  "$work/$1/build/program" || fail "$1: $2 does not work"
  quietly cmake --install "$work/$1/build" --prefix "$work/$1/installed"
  [[ $(find "$work/$1/installed" -type f -printf '%f ') == "program " ]] || fail "$1: installs more than its own"
  [[ ! -f $work/$1/build/CTestTestfile.cmake ]] || fail "$1: has tests"
}
embed subdirectory glevaluator "add_subdirectory($root/production glevaluator)"
embed fetched glevaluator_shared "include(FetchContent)
FetchContent_Declare(glevaluator SOURCE_DIR $root SOURCE_SUBDIR production)
FetchContent_MakeAvailable(glevaluator)"
