#include <sampling/point_sets.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/sampler/halton.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/latin_hypercube.h>
#include <mc/sampler/lattice.h>
#include <mc/sampler/multi_jittered.h>
#include <mc/sampler/padded_sobol.h>
#include <mc/sampler/padded_sobol_4d.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <algorithm>

namespace carlo {

namespace {

// The points of a sampler made for (count, dim, seed).
template <class Make> PointSet row(std::string name, std::string title, Make make) {
  return {std::move(name), std::move(title), [make](std::uint32_t count, std::uint32_t dim, std::uint64_t seed) {
            const auto sampler = make(count, dim, seed);
            std::vector<double> points;
            points.reserve(std::size_t{count} * dim);
            for (std::uint32_t i = 0; i < count; ++i)
              for (std::uint32_t k = 0; k < dim; ++k) points.push_back(mc::coordinate<double>(sampler, i, k));
            return points;
          }};
}

} // namespace

const std::vector<PointSet>& point_sets() {
  using Count = std::uint32_t;
  using Seed = std::uint64_t;
  static const std::vector<PointSet> all = {
      row("random", "independent points", [](Count, Count, Seed seed) { return mc::Independent{seed}; }),
      row("stratified", "one point in each box of a grid over all dimensions (jittered)",
          [](Count n, Count dim, Seed seed) { return mc::Stratified(n, seed, dim); }),
      row("latin_hypercube", "one point in each of n slices of every axis",
          [](Count n, Count, Seed seed) { return mc::LatinHypercube(n, seed); }),
      row("multi_jittered", "correlated multi-jittered, in pairs of dimensions",
          [](Count n, Count, Seed seed) { return mc::MultiJittered(n, seed); }),
      row("halton", "Halton's sequence, digits scrambled", [](Count, Count, Seed seed) { return mc::Halton(seed); }),
      row("lattice", "rank-1 lattice, shifted", [](Count, Count, Seed seed) { return mc::Lattice(seed); }),
      row("sobol", "Sobol's sequence, Owen-scrambled", [](Count, Count, Seed seed) { return mc::Sobol(seed); }),
      row("padded_sobol", "Sobol's first two dimensions for every pair",
          [](Count, Count, Seed seed) { return mc::PaddedSobol{seed}; }),
      row("padded_sobol_4d", "Sobol's first four dimensions for every four",
          [](Count, Count, Seed seed) { return mc::PaddedSobol4D(seed); }),
  };
  return all;
}

const PointSet& point_set(const std::string& name) {
  std::vector<std::string> names;
  for (const PointSet& s : point_sets()) {
    if (s.name == name) return s;
    names.push_back(s.name);
  }
  throw mc::Error(fmt::format("unknown point set '{}'{}; use one of {}", name, mc::did_you_mean(name, names),
                              fmt::join(names, ", ")));
}

} // namespace carlo
