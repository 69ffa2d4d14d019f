#include <sampling/point_sets.h>

#include <mc/core/error.h>
#include <mc/core/sum.h>
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

// Fills `points` with points first, first + 1, ... of the sampler.
template <mc::Real S, mc::Sampler T>
void fill(const T& sampler, std::uint64_t first, std::size_t dim, std::span<double> points) {
  if constexpr (std::same_as<T, mc::Stratified>) {
    std::vector<S> u(dim);
    for (std::size_t i = 0; i < points.size() / dim; ++i) {
      sampler.point(first + i, std::span(u));
      std::copy(u.begin(), u.end(), points.begin() + static_cast<std::ptrdiff_t>(i * dim));
    }
    return;
  }
  for (std::size_t i = 0; i < points.size() / dim; ++i)
    for (std::size_t k = 0; k < dim; ++k)
      points[i * dim + k] = static_cast<double>(mc::coordinate<S>(sampler, first + i, static_cast<std::uint32_t>(k)));
}

template <mc::Real S, mc::Sampler T> double mean_by(const T& sampler, const UnitCubeIntegral& e, std::uint32_t count) {
  const auto dim = static_cast<std::size_t>(e.dim);
  return mean_over(e, count,
                   [&](std::uint64_t first, std::span<double> points) { fill<S>(sampler, first, dim, points); });
}

template <mc::Real S, class Make> PointSet::Mean mean_of(Make make) {
  return [make](const UnitCubeIntegral& e, std::uint32_t count, std::uint64_t seed) {
    return mean_by<S>(make(count, static_cast<std::uint32_t>(e.dim), seed), e, count);
  };
}

// The row of a sampler that make(count, dim, seed) constructs.
template <class Make> PointSet row(std::string name, std::string title, Make make) {
  PointSet set{std::move(name), std::move(title), {}, {}, {}};
  set.make = [make](std::uint32_t count, std::uint32_t dim, std::uint64_t seed) {
    std::vector<double> points(std::size_t{count} * dim);
    fill<double>(make(count, dim, seed), 0, dim, points);
    return points;
  };
  set.mean = mean_of<double>(make);
  set.mean_in_float = mean_of<float>(make);
  return set;
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

double mean_over(const UnitCubeIntegral& e, std::uint64_t n,
                 const std::function<void(std::uint64_t first, std::span<double> points)>& fill) {
  constexpr std::uint64_t block = 256;
  const auto dim = static_cast<std::size_t>(e.dim);
  std::vector<double> points(block * dim), values(block);
  mc::CompensatedSum sum;
  for (std::uint64_t first = 0; first < n; first += block) {
    const auto count = static_cast<std::size_t>(std::min(block, n - first));
    const std::span<double> some = std::span(points).first(count * dim);
    fill(first, some);
    evaluate(e, some, std::span(values).first(count));
    for (std::size_t i = 0; i < count; ++i) sum.add(values[i]);
  }
  return sum.value() / static_cast<double>(n);
}

const PointSet& point_set(const std::string& name) {
  std::vector<std::string> names;
  for (const PointSet& s : point_sets()) names.push_back(s.name);
  return point_sets()[mc::index_of("point set", name, names)];
}

} // namespace carlo
