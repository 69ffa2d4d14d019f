#!/usr/bin/env bash
# Compiles every public header by itself. Usage: headers_compile_alone.sh COMPILER SOURCE_DIR INCLUDE_DIR...
set -eu
compiler=$1 source=$2
shift 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
flags=(-std=c++20)
for folder in "$@"; do
  # With -isystem of the default folder, C++ headers would not find the C headers.
  for one in ${folder//;/ }; do [ "$one" = /usr/include ] || flags+=(-isystem "$one"); done
done

# Eigen takes most of the time, so it is precompiled for the headers that include it, directly or indirectly.
echo '#include <Eigen/Core>' >"$scratch/eigen.h"
"$compiler" "${flags[@]}" -x c++-header "$scratch/eigen.h" -o "$scratch/eigen.h.gch"
# mpi_*.h needs an MPI, which need not be installed.
headers() {
  for base in libmc librender; do (cd "$source/$base" && find . -name '*.h' ! -name 'mpi_*.h' -printf '%P\n'); done | sort
}
headers >"$scratch/all"
for base in libmc librender; do
  (cd "$source/$base" && grep -rHoE --include='*.h' '^#include <[^>]+>' .)
done | sed 's#^\./##; s#:.*<# #; s#>##' | awk '
  { from[NR] = $1; to[NR] = $2 }
  END {
    do {
      grew = 0
      for (i in from)
        if (!(from[i] in found) && (to[i] ~ /^Eigen\// || to[i] in found)) { found[from[i]]; grew = 1 }
    } while (grew)
    for (header in found) print header
  }' | sort | comm -12 "$scratch/all" - >"$scratch/with_eigen"

compile() { # ARGUMENTS HEADER
  header=${*: -1}
  "$compiler" -fsyntax-only "${@:1:$#-1}" -x c++ - <<<"#include <$header>" ||
    { echo "FAILED: <$header> does not compile alone"; return 1; }
}
export -f compile
export compiler
many=(xargs -r -P "$(nproc)" -I{} bash -c 'compile "$@"' _)
"${many[@]}" "${flags[@]}" -include "$scratch/eigen.h" {} <"$scratch/with_eigen"
comm -23 "$scratch/all" "$scratch/with_eigen" | "${many[@]}" "${flags[@]}" {}
echo "$(wc -l <"$scratch/all") headers compile alone, $(wc -l <"$scratch/with_eigen") of them with Eigen"
