#pragma once
/// Faults of random position, shape and scale in correct subjects; see random_subjects.h.

#include <mc/check/random_subjects.h>

#include <mc/check/report/report.h>

#include <mc/random/hash.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>

namespace checker_bench {

/// A subject with a fault.
///   size : relative error of the density, fraction of wrong samples, or number of lattice cells.
struct FaultySubject {
  std::string kind;
  double size = 0;
  Subject subject;
};

using Draw = Subject::Draw;
using Coordinates = Subject::Coordinates;

/// Changes the draws of a correct subject; omits draws for which `change` returns false.
inline Subject with_changed_draws(Subject right, const std::function<bool(Pcg&, Draw&)>& change) {
  right.draw = [draw = right.draw, change](std::uint64_t seed, std::size_t n, std::vector<Draw>& out) {
    Pcg random(seed, 91);
    std::vector<Draw> draws;
    const std::size_t wanted = out.size() + n;
    for (std::uint64_t part = 0; out.size() < wanted; ++part) {
      draws.clear();
      draw(mc::hash(seed, part), n, draws);
      for (Draw& d : draws) {
        if (out.size() == wanted) break;
        if (d.kind != Draw::Kind::point || change(random, d)) out.push_back(d);
      }
    }
  };
  right.describe_draw = nullptr;
  right.inverted = nullptr;
  return right;
}

/// Returns a subject with samples of density (1 + error(v)) times the claimed density, for |error| <= most.
inline Subject reweighted(const Subject& right, double most, const std::function<double(const Coordinates&)>& error) {
  return with_changed_draws(right, [=](Pcg& r, Draw& d) { return uniform(r) * (1 + most) < 1 + error(d.v); });
}

/// Ranks of chart coordinates among samples, per axis: a scale on which the marginal densities are nearly uniform.
struct Ranks {
  mc::PerAxis<std::vector<double>> sorted;
  std::vector<Coordinates> points;

  Ranks(const Subject& s, std::uint64_t seed, std::size_t n) {
    std::vector<Draw> draws;
    s.draw(seed, n, draws);
    for (const Draw& d : draws)
      if (d.kind == Draw::Kind::point) points.push_back(d.v);
    for (std::size_t a = 0; a < static_cast<std::size_t>(s.dim); ++a) {
      for (const Coordinates& v : points) sorted[a].push_back(v[a]);
      std::sort(sorted[a].begin(), sorted[a].end());
    }
  }
  Coordinates operator()(const Coordinates& v) const {
    Coordinates r{};
    for (std::size_t a = 0; a < sorted.size() && !sorted[a].empty(); ++a) {
      const auto above = std::upper_bound(sorted[a].begin(), sorted[a].end(), v[a]);
      const auto i = static_cast<std::size_t>(above - sorted[a].begin());
      const double lo = i > 0 ? sorted[a][i - 1] : 0.0, hi = i < sorted[a].size() ? sorted[a][i] : 1.0;
      const double within = hi > lo ? (v[a] - lo) / (hi - lo) : 0.0;
      r[a] = (static_cast<double>(i) + within) / static_cast<double>(sorted[a].size() + 1);
    }
    return r;
  }
};

/// Number of random numbers for the axes of a fault: for three axes at least, so that the seeds of faults in fewer
/// dimensions give the same faults.
inline std::size_t drawn(int dim) { return static_cast<std::size_t>(std::max(dim, 3)); }

/// A rotated and stretched frame of the ranks that preserves volumes.
struct Frame {
  mc::PerAxis<mc::PerAxis<double>> axes{};
  Frame(Pcg& r, int dim) {
    for (std::size_t a = 0; a < axes.size(); ++a) axes[a][a] = 1;
    for (std::size_t a = 0; a + 1 < static_cast<std::size_t>(dim); ++a) {
      const double t = random_index(r, 2) == 0 ? 0.0 : 2 * mc::pi<double> * uniform(r), c = std::cos(t),
                   s = std::sin(t);
      for (std::size_t k = 0; k < axes.size(); ++k) {
        const double x = axes[k][a], y = axes[k][a + 1];
        axes[k][a] = c * x + s * y;
        axes[k][a + 1] = c * y - s * x;
      }
    }
    mc::PerAxis<double> stretch{};
    for (std::size_t a = 0; a < drawn(dim); ++a) stretch[a] = log_uniform(r, 0.6, 1.7);
    double volume = 1;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) volume *= stretch[a];
    for (std::size_t a = 0; a < axes.size(); ++a)
      for (double& x : axes[a]) x *= stretch[a] / std::pow(volume, 1.0 / dim);
  }
  Coordinates operator()(const Coordinates& v, const Coordinates& centre = {}) const {
    Coordinates x{};
    for (std::size_t a = 0; a < axes.size(); ++a)
      for (std::size_t k = 0; k < axes.size(); ++k) x[a] += axes[a][k] * (v[k] - centre[k]);
    return x;
  }
};

/// Returns an error with random signs on a lattice of random offset and direction with about `patches` cells.
inline FaultySubject random_signs(const Subject& right, Pcg& r, double size, double patches) {
  const auto ranks = std::make_shared<Ranks>(right, r.next64(), 1 << 14);
  const Frame frame(r, right.dim);
  const double scale = std::pow(patches, 1.0 / right.dim);
  const std::uint64_t seed = r.next64();
  Coordinates offset{};
  for (std::size_t a = 0; a < drawn(right.dim); ++a) offset[a] = uniform(r);
  return {"random signs", size, reweighted(right, size, [=](const Coordinates& v) {
            const Coordinates x = frame((*ranks)(v));
            std::uint64_t cell = seed;
            for (std::size_t a = 0; a < drawn(right.dim); ++a)
              cell = mc::hash(cell, static_cast<std::uint64_t>(
                                        static_cast<std::int64_t>(std::floor(scale * x[a] + offset[a]) + 1000)));
            return cell & 1 ? size : -size;
          })};
}

/// Returns an error in one region with the given share of the samples: an ellipsoid or a box of the ranks.
inline FaultySubject one_region(const Subject& right, Pcg& r, double size, double share) {
  const auto ranks = std::make_shared<Ranks>(right, r.next64(), 1 << 17);
  const Frame frame(r, right.dim);
  const bool box = random_index(r, 2) == 0;
  const Coordinates centre = (*ranks)(ranks->points[r.next64() % ranks->points.size()]);
  const auto distance = [=](const Coordinates& v) {
    double largest = 0, squares = 0;
    for (const double x : frame((*ranks)(v), centre)) {
      largest = std::max(largest, std::abs(x));
      squares += x * x;
    }
    return box ? largest : std::sqrt(squares);
  };
  std::vector<double> distances;
  for (const Coordinates& v : ranks->points) distances.push_back(distance(v));
  const auto at = distances.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(distances.size()));
  std::nth_element(distances.begin(), at, distances.end());
  const double sign = size < 1 && random_index(r, 2) == 0 ? -size : size;
  return {"one region", size, reweighted(right, size, [=, radius = *at](const Coordinates& v) {
            return distance(v) <= radius ? sign : 0.0;
          })};
}

/// Returns a smooth error in ranks: a wrong exponent along an axis, a tilt along it, or a correlation of two axes.
inline FaultySubject smooth(const Subject& right, Pcg& r, double size) {
  const auto ranks = std::make_shared<Ranks>(right, r.next64(), 1 << 16);
  const auto axis = static_cast<std::size_t>(random_index(r, right.dim)),
             other = (axis + 1) % static_cast<std::size_t>(right.dim);
  const int form = random_index(r, right.dim > 1 ? 3 : 2);
  const char* names[] = {"exponent", "tilt", "correlation"};
  const double sign = random_index(r, 2) == 0 ? size : -size;
  return {names[form], size, reweighted(right, 3 * size, [=](const Coordinates& v) {
            const Coordinates at = (*ranks)(v);
            if (form == 0) return std::clamp(sign * (1 + std::log(at[axis])), -0.9, 3 * size);
            if (form == 1) return sign * (2 * at[axis] - 1);
            return sign * (2 * at[axis] - 1) * (2 * at[other] - 1);
          })};
}

/// Returns a wave error with at most 100 periods along an axis.
inline FaultySubject wave(const Subject& right, Pcg& r, double size) {
  const double k = uniform_between(r, -100, 100), l = uniform_between(r, -100, 100), m = uniform_between(r, -15, 15),
               phase = uniform(r);
  const bool space = right.dim >= 3;
  return {"wave", size, reweighted(right, size, [=](const Coordinates& v) {
            const double turns = space ? 0.15 * (k * v[0] + l * v[1]) + m * v[2] : k * v[0] + l * v[1];
            return size * std::cos(2 * mc::pi<double> * (turns + phase));
          })};
}

/// Omits an interval of a coordinate with the given share of the samples, or clamps it to one value.
inline FaultySubject gap_or_clamp(const Subject& right, Pcg& r, double share) {
  const Ranks ranks(right, r.next64(), 1 << 19);
  const auto axis = static_cast<std::size_t>(random_index(r, right.dim));
  const std::vector<double>& v = ranks.sorted[axis];
  const double n = static_cast<double>(v.size());
  const auto width = static_cast<std::size_t>(std::max(1.0, share * n));
  const std::size_t first =
      random_index(r, 3) == 0 ? 0 : static_cast<std::size_t>(uniform(r) * (n - static_cast<double>(width)));
  const double lo = first == 0 ? 0.0 : v[first], hi = v[std::min(first + width, v.size() - 1)];
  if (random_index(r, 2) == 0)
    return {"gap", share,
            with_changed_draws(right, [=](Pcg&, Draw& d) { return !(d.v[axis] >= lo && d.v[axis] < hi); })};
  return {"clamp", share, with_changed_draws(right, [=](Pcg&, Draw& d) {
            if (d.v[axis] >= lo && d.v[axis] < hi) {
              d.v[axis] = first == 0 ? hi : lo;
              d.density = -1;
            }
            return true;
          })};
}

/// Rounds a coordinate to a lattice, with equal remainders on two axes or with constant remainder.
inline FaultySubject lattice(const Subject& right, Pcg& r) {
  const double n = std::floor(log_uniform(r, 16, 400));
  const bool shared = random_index(r, 2) == 0 && right.dim > 1;
  return {shared ? "one offset for two axes" : "coarse coordinate", n, with_changed_draws(right, [=](Pcg&, Draw& d) {
            const double fraction = shared ? n * d.v[1] - std::floor(n * d.v[1]) : 0.5;
            d.v[0] = std::min((std::floor(n * d.v[0]) + fraction) / n, 1 - 0x1p-53);
            d.density = -1;
            return true;
          })};
}

/// Moves a share of the samples into a small box around one of them.
inline FaultySubject spike(const Subject& right, Pcg& r, double share) {
  const auto ranks = std::make_shared<Ranks>(right, r.next64(), 1 << 12);
  const Coordinates centre = ranks->points[r.next64() % ranks->points.size()];
  const double radius = log_uniform(r, 1e-7, 3e-3);
  return {"spike", share, with_changed_draws(right, [=, dim = right.dim](Pcg& random, Draw& d) {
            if (uniform(random) >= share) return true;
            for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
              d.v[a] = std::clamp(centre[a] + radius * (uniform(random) - 0.5), 1e-12, 1 - 1e-12);
            d.density = -1;
            return true;
          })};
}

/// Scales the claimed density by 1 + size.
inline FaultySubject wrong_mass(Subject right, double size) {
  right.density = [density = right.density, size](const Coordinates& v) { return (1 + size) * density(v); };
  return {"mass", size, with_changed_draws(right, [](Pcg&, Draw& d) {
            d.density = -1;
            return true;
          })};
}

/// Returns a fault of random kind. Its size is between a fifth and five times the detectable size, approximately.
inline FaultySubject random_fault(const Subject& right, std::uint64_t seed, double samples) {
  Pcg r(mc::hash(seed, 78));
  const double sigma = std::sqrt(1 / samples), factor = log_uniform(r, 0.2, 5);
  switch (random_index(r, 8)) {
  case 0: return random_signs(right, r, std::min(0.9, 30 * factor * sigma), log_uniform(r, 16, samples / 1000));
  case 1: {
    const double share = log_uniform(r, 1000 / samples, 0.1);
    return one_region(right, r, 12 * factor * sigma / std::sqrt(share), share);
  }
  case 2: return wave(right, r, std::min(0.9, 20 * factor * sigma));
  case 3: return gap_or_clamp(right, r, 40 * factor / samples);
  case 4: return lattice(right, r);
  case 5: return spike(right, r, 120 * factor / samples);
  case 6: return smooth(right, r, 10 * factor * sigma);
  default: return wrong_mass(right, 12 * factor * sigma);
  }
}

/// Returns a fault of the size that the report of the correct subject states, of random kind. The error covers patches
/// with the probability of at least four of the checker's cells, or one such region. Half of the faults have the
/// smallest such patches.
inline FaultySubject stated_fault(const Subject& right, const mc::Report& stated, std::uint64_t seed) {
  Pcg r(mc::hash(seed, 79));
  const double cells = std::exp2(std::floor(std::log2(static_cast<double>(stated.samples) / 200)));
  const bool small = random_index(r, 2) == 0;
  if (random_index(r, 2) == 0)
    return random_signs(right, r, stated.detectable, small ? cells / 4 : log_uniform(r, 16, cells / 4));
  return one_region(right, r, stated.detectable_cell, small ? 4 / cells : log_uniform(r, 4 / cells, 0.3));
}

} // namespace checker_bench
