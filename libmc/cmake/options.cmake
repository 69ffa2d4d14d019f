# Compile options of our own targets. Users of mc::mc get none of these but C++20.
add_library(mc_options INTERFACE)
target_compile_features(mc_options INTERFACE cxx_std_20)
target_compile_options(mc_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual -Woverloaded-virtual -Wextra-semi
  # A fused multiply-add changes the last bit from one inlining to the next: we write std::fma where we mean it. g++ 12
  # still fuses the pair a c - b d, a d + b c; tests/layout/same_bits.sh finds it.
  -ffp-contract=off
  # Lets sqrt and floor become instructions; values stay IEEE.
  -fno-math-errno
  # Vectors wider than the machine's are passed by memory; none crosses from one file to another.
  -Wno-psabi)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports false positives inside Eigen and the standard library at -O3.
  target_compile_options(mc_options INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow
    -Wno-stringop-overread -Wno-restrict)
  # A tenth of the time to compile was spent on collecting garbage in a heap of 128 MB.
  target_compile_options(mc_options INTERFACE --param=ggc-min-heapsize=500000)
endif()
if(MC_WERROR)
  target_compile_options(mc_options INTERFACE -Werror)
endif()
if(MC_NATIVE)
  target_compile_options(mc_options INTERFACE -march=native)
endif()
# Who links a library that is built for a sanitizer must link the sanitizer too: mc passes this on.
if(MC_CHECKED)
  # Null pointers and sizes of objects are the address sanitizer's, nothing is virtual: a quarter less to compile.
  target_compile_options(mc_options INTERFACE -fsanitize=address,undefined -fno-sanitize=null,object-size,vptr
    -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  set(MC_SANITIZER -fsanitize=address,undefined)
endif()
if(MC_TSAN)
  target_compile_options(mc_options INTERFACE -fsanitize=thread)
  set(MC_SANITIZER -fsanitize=thread)
endif()
# What nearly every source reads, for a precompiled header of each library.
set(MC_PRECOMPILED <Eigen/Core> <fmt/format.h> <algorithm> <array> <cmath> <functional> <optional> <span> <string> <vector>)

# Files of a target that are compiled together: most of the time goes into reading and instantiating the same headers,
# and what a header instantiates is not precompiled. Up to 8 files are one group, up to 16 two, more are four, by the
# first letter of their names, so that a new file does not move others. Names that are local to a file must differ from
# those of its group. Hot loops stay apart: inlining depends on the file.
option(MC_UNITY "Compile tests, readers and commands in groups" ON)
function(mc_compile_in_groups target name)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${MC_UNITY} UNITY_BUILD_MODE GROUP)
  list(LENGTH ARGN count)
  set(groups a-z)
  if(count GREATER 16)
    set(groups a-c d-l m-r s-z)
  elseif(count GREATER 8)
    set(groups a-l m-z)
  endif()
  foreach(file ${ARGN})
    cmake_path(GET file FILENAME stem)
    foreach(letters ${groups})
      if(stem MATCHES "^[${letters}]")
        string(MAKE_C_IDENTIFIER "${name}_${letters}" group)
      endif()
    endforeach()
    set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()
