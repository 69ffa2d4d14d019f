#include "arrays.h"
#include "contracts.h"
#include "module.h"

#include <mc/core/parallel.h>
#include <mc/sampler/halton.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/latin_hypercube.h>
#include <mc/sampler/lattice.h>
#include <mc/sampler/multi_jittered.h>
#include <mc/sampler/padded_sobol.h>
#include <mc/sampler/padded_sobol_4d.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <pybind11/stl.h>

#include <cstdint>
#include <optional>

namespace bindings {

namespace {

using py::arg;
using Seed = std::uint64_t;

constexpr std::uint64_t index_limit = std::uint64_t{1} << 32;

Array new_points(std::uint64_t n, std::uint32_t d, std::uint64_t first) {
  mc::require(d >= 1, "points of {} dimensions; one or more are needed", d);
  mc::require(first < index_limit && n <= index_limit - first, "points {} to {}; indices end at 2^32", first,
              first + n);
  return Array({static_cast<py::ssize_t>(n), static_cast<py::ssize_t>(d)});
}

// Calls fill(first, last, out) for parts of the rows, without the interpreter's lock.
template <class Fill> Array in_parts(std::uint64_t n, std::uint32_t d, std::uint64_t first, Fill fill) {
  Array points = new_points(n, d, first);
  double* const out = points.mutable_data();
  const py::gil_scoped_release release;
  mc::parallel_parts(n, 4096, 0, [&](std::size_t begin, std::size_t end) { fill(begin, end, out + begin * d); });
  return points;
}

template <mc::Sampler T> Array points_of(const T& sampler, std::uint64_t n, std::uint32_t d, std::uint64_t first) {
  return in_parts(n, d, first, [&](std::size_t begin, std::size_t end, double* out) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::uint32_t k = 0; k < d; ++k) *out++ = mc::coordinate<double>(sampler, first + i, k);
  });
}

// Whole rows at a time: finds each box once.
Array points_of(const mc::Stratified& sampler, std::uint64_t n, std::uint32_t d, std::uint64_t first) {
  return in_parts(n, d, first, [&](std::size_t begin, std::size_t end, double* out) {
    for (std::size_t i = begin; i < end; ++i, out += d) sampler.point(first + i, std::span(out, d));
  });
}

// Whole columns at a time.
Array points_of(const mc::Sobol& sampler, std::uint64_t n, std::uint32_t d, std::uint64_t first) {
  return in_parts(n, d, first, [&](std::size_t begin, std::size_t end, double* out) {
    std::vector<double> column(end - begin);
    for (std::uint32_t k = 0; k < d; ++k) {
      sampler.fill(first + begin, k, std::span(column));
      for (std::size_t i = 0; i < column.size(); ++i) out[i * d + k] = column[i];
    }
  });
}

Array sobol(std::uint64_t n, std::uint32_t d, std::optional<Seed> seed, std::uint64_t first) {
  if (seed) return points_of(mc::Sobol(*seed), n, d, first);
  mc::require(d <= mc::Sobol::dimensions, "sobol: {} dimensions; unscrambled points have at most {}", d,
              mc::Sobol::dimensions);
  const mc::Sobol sampler;
  return in_parts(n, d, first, [&](std::size_t begin, std::size_t end, double* out) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::uint32_t k = 0; k < d; ++k)
        *out++ = sampler.unscrambled(static_cast<std::uint32_t>(first + i), k) * 0x1p-32;
  });
}

Array halton(std::uint64_t n, std::uint32_t d, std::optional<Seed> seed, std::uint64_t first, const std::string& kind) {
  mc::require(kind == "owen" || kind == "digits", "halton: scramble '{}' must be owen or digits", kind);
  const auto scramble = kind == "owen" ? mc::HaltonScramble::owen : mc::HaltonScramble::digits;
  if (seed) return points_of(mc::Halton(*seed, scramble), n, d, first);
  mc::require(d <= mc::Halton::dimensions, "halton: {} dimensions; unscrambled points have at most {}", d,
              mc::Halton::dimensions);
  return in_parts(n, d, first, [&](std::size_t begin, std::size_t end, double* out) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::uint32_t k = 0; k < d; ++k)
        *out++ = mc::Halton::radical_inverse(static_cast<std::uint32_t>(first + i), k);
  });
}

// `n` points of a set of `count`; None: count = n.
std::uint32_t count_of(std::optional<std::uint32_t> count, std::uint64_t n, const char* name) {
  mc::require(count || n < index_limit, "{}: {} points; fewer than 2^32 are needed", name, n);
  return count.value_or(static_cast<std::uint32_t>(std::max<std::uint64_t>(n, 1)));
}

// The contract of a C++ class after the line on arguments.
std::string doc(const char* cpp_class, const std::string& arguments = "") {
  return "Points first, first + 1, ... of shape (n, d), in [0,1)." + arguments + "\n\n" + contract(cpp_class);
}

constexpr const char* unscrambled = " seed=None leaves them unscrambled.";
constexpr const char* counted = " `count` is the size of a set; None: n.";

template <class Make> void bind_sequence(py::module_& m, const char* name, const char* cpp_class, Make make) {
  m.def(
      name,
      [make](std::uint64_t n, std::uint32_t d, Seed seed, std::uint64_t first) {
        return points_of(make(seed), n, d, first);
      },
      arg("n"), arg("d"), arg("seed") = 0, py::kw_only(), arg("first") = 0, doc(cpp_class).c_str());
}

template <class Make> void bind_counted(py::module_& m, const char* name, const char* cpp_class, Make make) {
  m.def(
      name,
      [make, name](std::uint64_t n, std::uint32_t d, Seed seed, std::optional<std::uint32_t> count,
                   std::uint64_t first) { return points_of(make(count_of(count, n, name), d, seed), n, d, first); },
      arg("n"), arg("d"), arg("seed") = 0, py::kw_only(), arg("count") = py::none(), arg("first") = 0,
      doc(cpp_class, counted).c_str());
}

} // namespace

void bind_samplers(py::module_& parent) {
  py::module_ m = parent.def_submodule("samplers", "Point sets in the unit cube, as arrays of shape (n, d).");
  bind_sequence(m, "random", "Independent", [](Seed seed) { return mc::Independent{seed}; });
  bind_sequence(m, "lattice", "Lattice", [](Seed seed) { return mc::Lattice(seed); });
  bind_sequence(m, "padded_sobol", "PaddedSobol", [](Seed seed) { return mc::PaddedSobol{seed}; });
  bind_sequence(m, "padded_sobol_4d", "PaddedSobol4D", [](Seed seed) { return mc::PaddedSobol4D(seed); });
  bind_counted(m, "stratified", "Stratified",
               [](std::uint32_t n, std::uint32_t d, Seed seed) { return mc::Stratified(n, seed, d); });
  bind_counted(m, "latin_hypercube", "LatinHypercube",
               [](std::uint32_t n, std::uint32_t, Seed seed) { return mc::LatinHypercube(n, seed); });
  bind_counted(m, "multi_jittered", "MultiJittered",
               [](std::uint32_t n, std::uint32_t, Seed seed) { return mc::MultiJittered(n, seed); });
  m.def("sobol", &sobol, arg("n"), arg("d"), arg("seed") = 0, py::kw_only(), arg("first") = 0,
        doc("Sobol", unscrambled).c_str());
  m.def("halton", &halton, arg("n"), arg("d"), arg("seed") = 0, py::kw_only(), arg("first") = 0,
        arg("scramble") = "owen",
        doc("Halton", std::string(unscrambled) + " `scramble` is owen (nested) or digits.").c_str());
}

} // namespace bindings
