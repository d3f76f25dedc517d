#!/bin/sh
# Writes what the program prints for --help, and for --help of each of its commands, into FOLDER/evalcts*.txt.
# usage: write-help.sh PROGRAM FOLDER
set -eu
program=$1
folder=$2
mkdir -p "$folder"
rm -f "$folder"/evalcts*.txt

write() { # command words
  "$program" "$@" --help >"$folder/$(echo evalcts "$@" | tr ' ' -).txt"
  # A loop evaluates its list once, and "$@" belongs to this call, so that the function may call itself.
  # shellcheck disable=SC2013 # words
  for command in $(sed '1,/^Subcommands:/d; s/^  \([a-z][a-z]*\) .*/\1/p; d' \
    "$folder/$(echo evalcts "$@" | tr ' ' -).txt"); do
    write "$@" "$command"
  done
}
write
