#!/bin/sh
# wide_symbols.sh OBJECT: what a source compiled for processors with AVX-512 may define for others to take is its own: a
# function with a name that other sources have, too, could be linked in the place of theirs.
set -e
names=$(nm -C --defined-only "$1" | grep -E '^[0-9a-f]+ [TWVuBDR] ' | cut -d' ' -f2-)
[ -n "$names" ]
if echo "$names" | grep -vE 'BasicPack<8>|solid::forces_of_eight|solid::built_for_eight'; then
  echo "these are shared with other sources"
  exit 1
fi
if objdump -h "$1" | grep -q '\.init_array'; then
  echo "this runs on every processor when the program is loaded"
  exit 1
fi
