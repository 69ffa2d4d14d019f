#pragma once
/// Many samples at once, with one array per coordinate.

#include <mc/core/error.h>
#include <mc/warp/concept.h>

#include <algorithm>
#include <array>
#include <span>

namespace mc {

/// One array per coordinate of u.
template <Warp W>
using UnitColumns =
    std::array<std::span<const typename W::Scalar>, sizeof(UnitPointOf<W>) / sizeof(typename W::Scalar)>;
/// One array per coordinate of the points of a warp.
template <Warp W>
using PointColumns = std::array<std::span<typename W::Scalar>, sizeof(PointOf<W>) / sizeof(typename W::Scalar)>;

/// Calls warp.sample for every i, e.g. sample_n(CosineHemisphere<float>{}, {u0, u1}, {x, y, z}).
/// The compiler vectorizes the loop if sample neither branches nor calls functions: disk, annulus, sphere, hemispheres,
/// cone, Henyey-Greenstein, exponential. The normal distribution has its own sample_n(). All other warps run as a plain
/// loop.
///   bits   : identical to sample, if the caller too compiles with -ffp-contract=off.
///   arrays : an output may be an array of u; otherwise arrays must not overlap.
///   throws : Error unless all arrays have the same size.
template <Warp W> void sample_n(const W& warp, const UnitColumns<W>& u, const PointColumns<W>& x) {
  const std::size_t n = u[0].size();
  for (const auto& column : u)
    require(column.size() == n, "sample_n: {} numbers in one array of u, {} in the first; as many are needed",
            column.size(), n);
  for (const auto& column : x)
    require(column.size() == n, "sample_n: {} numbers in an array of points, {} in those of u; as many are needed",
            column.size(), n);
  if constexpr (requires { warp.sample_n(u[0], x[0]); }) {
    warp.sample_n(u[0], x[0]);
    return;
  }
  // The loop writes to a local array, which cannot alias its inputs. Compilers need this proof to vectorize.
  constexpr std::size_t block = 64;
  std::array<std::array<typename W::Scalar, block>, std::tuple_size_v<PointColumns<W>>> out;
  for (std::size_t first = 0; first < n; first += block) {
    const std::size_t count = std::min(block, n - first);
    for (std::size_t i = 0; i < count; ++i) {
      if constexpr (W::Domain::dim == 1) {
        out[0][i] = warp.sample(u[0][first + i]);
      } else {
        UnitPointOf<W> v;
        for (std::size_t k = 0; k < u.size(); ++k) v[static_cast<Eigen::Index>(k)] = u[k][first + i];
        const PointOf<W> p = warp.sample(v);
        for (std::size_t k = 0; k < x.size(); ++k) out[k][i] = p[static_cast<Eigen::Index>(k)];
      }
    }
    for (std::size_t k = 0; k < x.size(); ++k) std::copy_n(out[k].data(), count, x[k].data() + first);
  }
}

} // namespace mc
