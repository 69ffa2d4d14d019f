#!/usr/bin/env bash
# Takes the examples out of a README: every ```cpp block becomes a function of one program, every ```text block after it what it prints.
# Usage: readme_examples.sh README.md PROGRAM.cpp EXPECTED.txt
set -eu
readme=$1 program=$2 expected=$3
awk -v program="$program" -v expected="$expected" '
  BEGIN { printf "" > expected }
  /^```/ {
    if (inside) { if (inside == "cpp") body = body "}\n\n"; inside = "" }
    else { inside = substr($0, 4); if (inside == "cpp") body = body "void example_" ++n "() {\n" "#line " NR + 1 " \"" FILENAME "\"\n" }
    next
  }
  inside == "cpp" && /^#include/ { if (!seen[$0]++) includes = includes $0 "\n"; body = body "\n"; next }
  inside == "cpp" { body = body $0 "\n" }
  inside == "text" && n { print > expected }
  END {
    print includes "\nnamespace {\n\n" body "} // namespace\n\nint main() {" > program
    for (i = 1; i <= n; ++i) print "  example_" i "();" > program
    print "}" > program
    if (!n) { print FILENAME ": no ```cpp examples" > "/dev/stderr"; exit 1 }
  }' "$readme"
