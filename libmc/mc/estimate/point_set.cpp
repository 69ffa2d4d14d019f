#include <mc/core/error.h>
#include <mc/estimate/point_set.h>
#include <mc/random/permute.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace mc {

namespace {

// Where the library is made for any machine, its loader chooses among clones of the loops that run over many points: by
// levels of the instruction set, since the name of a processor would ask for that very one.
#if defined(MC_ANY_MACHINE) && defined(__x86_64__) && !defined(__clang__)
#define MC_CLONES [[gnu::target_clones("default", "avx2", "arch=x86-64-v4")]]
#else
#define MC_CLONES
#endif

constexpr std::uint64_t window = 256; // points whose index differs in the low bits only

MC_CLONES void fill(const Independent& sampler, std::uint64_t first, std::size_t dim, std::span<double> u) {
  for (std::size_t i = 0; i < u.size(); i += dim)
    for (std::size_t d = 0; d < dim; ++d)
      u[i + d] = coordinate<double>(sampler, first + i / dim, static_cast<std::uint32_t>(d));
}

// Scrambled coordinates of the points base + skip, ..., base + skip + count - 1, to the same places of x.
MC_CLONES void coordinates(const Sobol& sobol, std::uint64_t seed, std::uint32_t dim, std::uint64_t base,
                           std::size_t skip, std::size_t count, std::array<std::uint32_t, window>& x) {
  // Points base .. base + 2^k - 1 from the first half of them, their bits in reverse order.
  x[0] = reverse_bits(sobol.unscrambled(static_cast<std::uint32_t>(base), dim));
  for (std::uint32_t half = 1; half < skip + count; half *= 2) {
    const std::uint32_t column = reverse_bits(sobol.unscrambled(half, dim));
    for (std::uint32_t i = 0; i < half; ++i) x[half + i] = x[i] ^ column;
  }
  const auto key = static_cast<std::uint32_t>(hash(seed, dim) >> 32);
  for (std::size_t i = skip; i < skip + count; ++i) x[i] = reverse_bits(owen_scramble_reversed(x[i], key));
}

// The low 26 bits of x at the even places.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x0000ffff0000ffffu;
  x = (x | x << 8) & 0x00ff00ff00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fu;
  x = (x | x << 2) & 0x3333333333333333u;
  return (x | x << 1) & 0x5555555555555555u;
}

// Numbers of 52 bits, the middle of their interval: those of x, then hashed ones. To every dim-th place of out.
MC_CLONES void extended(const std::uint32_t* x, std::uint64_t key, std::uint64_t index, std::size_t count,
                        std::size_t dim, double* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t low = mix64(key ^ (index + i)) & 0xfffff;
    out[i * dim] = (static_cast<double>(std::uint64_t{x[i]} << 20 | low) + 0.5) * 0x1p-52;
  }
}

// The same from the 26 leading bits of x and y in turn, put behind the point of 1.x.
MC_CLONES void interlaced(const std::uint32_t* x, const std::uint32_t* y, std::size_t count, std::size_t dim,
                          double* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t bits = spread(x[i] >> 6) << 1 | spread(y[i] >> 6);
    out[i * dim] = std::bit_cast<double>(bits | 0x3ff0000000000000u) - (1 - 0x1p-53);
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

// To where a permutation takes them: all walk a step together, then those again that landed beyond its end.
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

// Points on their way down to a box each, axis by axis: how many boxes are left to each, which of them is its own, and
// its stratum of the axis at hand, `size` boxes from `start`. Whole numbers, as doubles.
struct Descent {
  std::array<double, window> boxes, box, start, size;
};

// The strata of the points where the boxes of each are cut along an axis into at most 2^16. Numerators of whole numbers
// are raised by half: quotients lie further from an integer than they are rounded by, so floors are exact.
MC_CLONES void cut(Descent& points, double strata, std::size_t count) {
  const double per_stratum = 1 / strata;
  for (std::size_t i = 0; i < count; ++i) {
    const double boxes = points.boxes[i];
    const double stratum = std::floor((points.box[i] * strata + 0.5) / boxes);
    const double raised = stratum * boxes + (strata - 0.5); // to round up
    points.start[i] = std::floor(raised * per_stratum);
    points.size[i] = std::floor((raised + boxes) * per_stratum) - points.start[i];
  }
}

// A coordinate of each anywhere in its stratum, to every dim-th place of out; then on to the boxes of the stratum.
MC_CLONES void jitter(Descent& points, std::uint64_t key, std::uint64_t index, std::size_t count, std::size_t dim,
                      double* out) {
  constexpr double margin = 0x1p-50; // 8 roundings; at most 6 come together
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t bits = mix64(key + (index + i) * 0x9e3779b97f4a7c15u);
    const double u = std::bit_cast<double>(bits >> 12 | 0x3ff0000000000000u) - 1;
    const double per_box = 1 / points.boxes[i], start = points.start[i], size = points.size[i];
    out[i * dim] = (start * per_box + margin) + (size * per_box - 2 * margin) * u;
    points.box[i] -= start;
    points.boxes[i] = size;
  }
}

void fill(const ScrambledSobol& set, std::uint64_t first, std::size_t dim, std::span<double> u) {
  const Sobol sobol(set.seed);
  std::array<std::uint32_t, window> x;
  windows(first, dim, u, [&](std::uint64_t base, std::size_t skip, std::size_t count, double* out) {
    for (std::size_t d = 0; d < dim; ++d) {
      const auto dimension = static_cast<std::uint32_t>(d);
      if (dimension < Sobol::dimensions) {
        coordinates(sobol, set.seed, dimension, base, skip, count, x);
        extended(&x[skip], hash(set.seed, dimension), base + skip, count, dim, out + d);
      } else {
        for (std::size_t i = 0; i < count; ++i)
          out[i * dim + d] = coordinate<double>(sobol, base + skip + i, dimension);
      }
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
    std::uint32_t left = 0; // boxes of a point, or one more
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
        // No integer is the power of half an odd number, so rounding its root is safe however it is found.
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

void fill(const InterlacedSobol& set, std::uint64_t first, std::size_t dim, std::span<double> u) {
  MC_ASSERT(2 * dim <= Sobol::dimensions);
  const Sobol sobol(set.seed);
  std::array<std::uint32_t, window> x, y;
  windows(first, dim, u, [&](std::uint64_t base, std::size_t skip, std::size_t count, double* out) {
    for (std::size_t d = 0; d < dim; ++d) {
      coordinates(sobol, set.seed, static_cast<std::uint32_t>(2 * d), base, skip, count, x);
      coordinates(sobol, set.seed, static_cast<std::uint32_t>(2 * d + 1), base, skip, count, y);
      interlaced(&x[skip], &y[skip], count, dim, out + d);
    }
  });
}

} // namespace

void fill_points(const PointSet& set, std::uint64_t first, int dim, std::span<double> u) {
  std::visit([&](const auto& s) { fill(s, first, static_cast<std::size_t>(dim), u); }, set);
}

} // namespace mc
