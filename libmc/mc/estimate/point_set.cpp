#include <mc/core/error.h>
#include <mc/estimate/axis_warp.h>
#include <mc/estimate/point_set.h>
#include <mc/random/permute.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace mc {

namespace {

// Builds for any machine contain clones of the loops over many points, among which the loader selects. The clones are
// named by instruction set level, because a processor name would select only that processor.
#if defined(MC_ANY_MACHINE) && defined(__x86_64__) && !defined(__clang__)
#define MC_CLONES [[gnu::target_clones("default", "avx2", "arch=x86-64-v4")]]
#else
#define MC_CLONES
#endif

constexpr std::uint64_t window = 256; // points with indices that differ only in the low bits

// Writes a coordinate of points first, first + 1, ... to every dim-th element of out.
MC_CLONES void independent(const Independent& sampler, std::uint32_t axis, std::uint64_t first, std::size_t count,
                           std::size_t dim, double* out) {
  for (std::size_t i = 0; i < count; ++i) out[i * dim] = coordinate<double>(sampler, first + i, axis);
}

// Writes scrambled coordinates of points base + skip, ..., base + skip + count - 1 to elements skip, ... of x.
MC_CLONES void coordinates(const Sobol& sobol, std::uint64_t seed, std::uint32_t dim, std::uint64_t base,
                           std::size_t skip, std::size_t count, std::array<std::uint32_t, window>& x) {
  sobol.fill_reversed(static_cast<std::uint32_t>(base), dim, std::span(x).first(skip + count));
  const auto key = static_cast<std::uint32_t>(hash(seed, dim) >> 32);
  for (std::size_t i = skip; i < skip + count; ++i) x[i] = reverse_bits(owen_scramble_reversed(x[i], key));
}

// Spreads the low 26 bits of x to the even bit positions.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x0000ffff0000ffffu;
  x = (x | x << 8) & 0x00ff00ff00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fu;
  x = (x | x << 2) & 0x3333333333333333u;
  return (x | x << 1) & 0x5555555555555555u;
}

// Converts x and hashed lower bits to numbers of 52 bits, at the middle of their interval. Writes them to every dim-th
// element of out.
MC_CLONES void extended(const std::uint32_t* x, std::uint64_t key, std::uint64_t index, std::size_t count,
                        std::size_t dim, double* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t low = mix64(key ^ (index + i)) & 0xfffff;
    out[i * dim] = (static_cast<double>(std::uint64_t{x[i]} << 20 | low) + 0.5) * 0x1p-52;
  }
}

// Same for the alternating 26 leading bits of x and y. Builds the mantissa of a number in [1, 2) and subtracts 1.
MC_CLONES void interlaced(const std::uint32_t* x, const std::uint32_t* y, std::size_t count, std::size_t dim,
                          double* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t bits = spread(x[i] >> 6) << 1 | spread(y[i] >> 6);
    out[i * dim] = std::bit_cast<double>(bits | 0x3ff0000000000000u) - (1 - 0x1p-53);
  }
}

// Maps the coordinates u of an axis, and multiplies the Jacobians by the slopes. Writes the coordinates to every dim-th
// element of out.
MC_CLONES void warp(const detail::AxisWarp& map, const double* u, std::size_t count, double* jacobians, std::size_t dim,
                    double* out) {
  for (std::size_t i = 0; i < count; ++i) {
    jacobians[i] *= map.slope(u[i]);
    out[i * dim] = map(u[i]);
  }
}

// Calls visit(base, skip, count, out) for windows of points that cover u.
template <class Visit> void windows(std::uint64_t first, std::size_t dim, std::span<double> u, Visit&& visit) {
  const std::uint64_t last = first + u.size() / dim;
  for (std::uint64_t begin = first, end; begin < last; begin = end) {
    const std::uint64_t base = begin / window * window;
    end = std::min(base + window, last);
    visit(base, static_cast<std::size_t>(begin - base), static_cast<std::size_t>(end - begin),
          u.data() + (begin - first) * dim);
  }
}

// Applies a permutation to all positions in steps. Repeats the walk for positions that land beyond its end.
MC_CLONES void shuffle(const Permutation& permutation, std::span<std::uint32_t> positions) {
  std::array<std::uint32_t, window> x, whose;
  std::copy(positions.begin(), positions.end(), x.begin());
  std::iota(whose.begin(), whose.end(), 0u);
  for (std::size_t walking = positions.size(); walking > 0;) {
    for (std::uint64_t r = 0; r < permutation.rounds(); ++r) {
      const std::uint64_t key = permutation.key(r);
      for (std::size_t i = 0; i < walking; ++i) x[i] = permutation.round(x[i], key);
    }
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < walking; ++i) {
      positions[whose[i]] = x[i];
      whose[beyond] = whose[i];
      x[beyond] = x[i];
      beyond += x[beyond] >= permutation.size();
    }
    walking = beyond;
  }
}

// Points that descend to a box each, axis by axis. For each point: the number of boxes left, the index of its own box,
// and its stratum on the current axis, as `size` boxes from `start`. All are whole numbers stored as doubles.
struct Descent {
  std::array<double, window> boxes, box, start, size;
};

// Computes the strata of the points if the boxes of each point are cut into `strata` <= 2^16 strata along an axis.
// Numerators are whole numbers plus a half. The quotients are then farther from an integer than their rounding error,
// so the floors are exact.
MC_CLONES void cut(Descent& points, double strata, std::size_t count) {
  const double per_stratum = 1 / strata;
  for (std::size_t i = 0; i < count; ++i) {
    const double boxes = points.boxes[i];
    const double stratum = std::floor((points.box[i] * strata + 0.5) / boxes);
    const double raised = stratum * boxes + (strata - 0.5); // rounds up
    points.start[i] = std::floor(raised * per_stratum);
    points.size[i] = std::floor((raised + boxes) * per_stratum) - points.start[i];
  }
}

// Writes a uniform coordinate in the stratum of each point to every dim-th element of out. Then reduces the boxes of
// each point to its stratum.
MC_CLONES void jitter(Descent& points, std::uint64_t key, std::uint64_t index, std::size_t count, std::size_t dim,
                      double* out) {
  constexpr double margin = 0x1p-50; // 8 roundings; at most 6 add up
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t bits = mix64(key + (index + i) * 0x9e3779b97f4a7c15u);
    const double u = std::bit_cast<double>(bits >> 12 | 0x3ff0000000000000u) - 1;
    const double per_box = 1 / points.boxes[i], start = points.start[i], size = points.size[i];
    out[i * dim] = (start * per_box + margin) + (size * per_box - 2 * margin) * u;
    points.box[i] -= start;
    points.boxes[i] = size;
  }
}

void fill(const Independent& sampler, std::uint64_t first, std::size_t dim, std::span<double> u) {
  windows(first, dim, u, [&](std::uint64_t base, std::size_t skip, std::size_t count, double* out) {
    for (std::size_t d = 0; d < dim; ++d)
      independent(sampler, static_cast<std::uint32_t>(d), base + skip, count, dim, out + d);
  });
}

// Writes coordinate d of points base + skip, ... to every stride-th element of out.
void write_axis(const ScrambledSobol& set, const Sobol& sobol, std::size_t d, std::uint64_t base, std::size_t skip,
                std::size_t count, std::size_t stride, double* out) {
  std::array<std::uint32_t, window> x;
  const auto dimension = static_cast<std::uint32_t>(d);
  if (dimension < Sobol::dimensions) {
    coordinates(sobol, set.seed, dimension, base, skip, count, x);
    extended(&x[skip], hash(set.seed, dimension), base + skip, count, stride, out);
  } else {
    for (std::size_t i = 0; i < count; ++i) out[i * stride] = coordinate<double>(sobol, base + skip + i, dimension);
  }
}

void write_axis(const InterlacedSobol& set, const Sobol& sobol, std::size_t d, std::uint64_t base, std::size_t skip,
                std::size_t count, std::size_t stride, double* out) {
  const auto first = static_cast<std::uint32_t>(2 * d);
  MC_ASSERT(first + 1 < Sobol::dimensions);
  std::array<std::uint32_t, window> x, y;
  coordinates(sobol, set.seed, first, base, skip, count, x);
  coordinates(sobol, set.seed, first + 1, base, skip, count, y);
  interlaced(&x[skip], &y[skip], count, stride, out);
}

// ScrambledSobol or InterlacedSobol.
template <class Set>
concept MayBeWarped = requires(const Set& s) {
  s.warped;
};

// `jacobians` are 1.
template <MayBeWarped Set>
void fill(const Set& set, std::uint64_t first, std::size_t dim, std::span<double> u, std::span<double> jacobians) {
  const Sobol sobol(set.seed);
  std::array<double, window> axis;
  windows(first, dim, u, [&](std::uint64_t base, std::size_t skip, std::size_t count, double* out) {
    for (std::size_t d = 0; d < dim; ++d) {
      if (!set.warped) {
        write_axis(set, sobol, d, base, skip, count, dim, out + d);
        continue;
      }
      write_axis(set, sobol, d, base, skip, count, 1, axis.data());
      double* const products = &jacobians[base + skip - first];
      warp(detail::AxisWarp(set.seed, dim, d), axis.data(), count, products, dim, out + d);
    }
  });
}

void fill(const JitteredBoxes& set, std::uint64_t first, std::size_t dim, std::span<double> u) {
  constexpr std::size_t group = 8;
  std::array<std::uint32_t, window> boxes;
  Descent points;
  windows(first, dim, u, [&](std::uint64_t base, std::size_t skip, std::size_t count, double* out) {
    const std::uint64_t index = base + skip;
    MC_ASSERT(index + count <= set.count);
    std::uint32_t left = 0; // boxes of a point, possibly rounded down by one
    for (std::size_t d = 0; d < dim; ++d) {
      if (d % group == 0) {
        std::iota(boxes.begin(), boxes.begin() + count, static_cast<std::uint32_t>(index));
        if (d > 0) shuffle(Permutation(set.count, hash(~set.seed, d)), {boxes.data(), count});
        std::copy_n(boxes.begin(), count, points.box.begin());
        std::fill_n(points.boxes.begin(), count, set.count);
        left = set.count;
      }
      const std::size_t axes = std::min(group - d % group, dim - d);
      if (axes > 1) {
        // No integer is a power of half an odd number, so rounding its root is safe for any method.
        const double strata = std::max(std::round(std::pow(left, 1.0 / static_cast<double>(axes))), 1.0);
        cut(points, strata, count);
        left /= static_cast<std::uint32_t>(strata);
      } else {
        std::copy_n(points.box.begin(), count, points.start.begin());
        points.size.fill(1);
      }
      jitter(points, hash(set.seed, d), index, count, dim, out + d);
    }
  });
}

} // namespace

bool is_warped(const PointSet& set) {
  const auto warped = []<class Set>(const Set& s) {
    if constexpr (MayBeWarped<Set>) return s.warped;
    else return false;
  };
  return std::visit(warped, set);
}

void fill_points(const PointSet& set, std::uint64_t first, int dim, std::span<double> u, std::span<double> jacobians) {
  MC_ASSERT(!is_warped(set) || jacobians.size() == u.size() / static_cast<std::size_t>(dim));
  std::ranges::fill(jacobians, 1.0);
  const auto visit = [&]<class Set>(const Set& s) {
    const auto d = static_cast<std::size_t>(dim);
    if constexpr (MayBeWarped<Set>) fill(s, first, d, u, jacobians);
    else fill(s, first, d, u);
  };
  std::visit(visit, set);
}

} // namespace mc
