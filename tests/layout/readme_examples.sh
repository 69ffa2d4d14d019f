#!/usr/bin/env bash
# Extracts the examples of a README. Every ```cpp block becomes a function of one header. Every ```text block after it
# is the expected output of readme::print_examples().
# Usage: readme_examples.sh README.md HEADER.h EXPECTED.txt
set -eu
readme=$1 header=$2 expected=$3
awk -v header="$header" -v expected="$expected" '
  BEGIN { printf "" > expected }
  /^```/ {
    if (language) { if (language == "cpp") body = body "}\n\n"; language = "" }
    else { language = substr($0, 4); if (language == "cpp") body = body "inline void example_" ++n "() {\n" "#line " NR + 1 " \"" FILENAME "\"\n" }
    next
  }
  language == "cpp" && /^#include/ { if (!seen[$0]++) includes = includes $0 "\n"; body = body "\n"; next }
  language == "cpp" { body = body $0 "\n" }
  language == "text" && n { print > expected }
  END {
    print "#pragma once\n" includes "\nnamespace readme {\n\n" body "inline void print_examples() {" > header
    for (i = 1; i <= n; ++i) print "  example_" i "();" > header
    print "}\n\n} // namespace readme" > header
    if (!n) { print FILENAME ": no ```cpp examples" > "/dev/stderr"; exit 1 }
  }' "$readme"
