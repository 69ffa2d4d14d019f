#include <mc/points/star_grid.h>
#include <mc/random/hash.h>
#include <mc/random/uniform.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mc {

StarGrid::StarGrid(PointList p)
    : size_(p.size()), axes_(p.dim, {0.0, 1.0}), ranks_(p.values.size()),
      orders_(p.dim, std::vector<std::uint32_t>(p.size())) {
  for (std::size_t k = 0; k < p.dim; ++k) {
    std::vector<double>& c = axes_[k];
    for (std::size_t i = 0; i < size_; ++i) c.push_back(p[i][k]);
    std::sort(c.begin(), c.end());
    c.erase(std::unique(c.begin(), c.end()), c.end());
    for (std::size_t i = 0; i < size_; ++i)
      ranks_[i * p.dim + k] = static_cast<std::uint32_t>(std::lower_bound(c.begin(), c.end(), p[i][k]) - c.begin());
    std::iota(orders_[k].begin(), orders_[k].end(), 0u);
    std::sort(orders_[k].begin(), orders_[k].end(),
              [&](std::uint32_t a, std::uint32_t b) { return ranks(a)[k] < ranks(b)[k]; });
  }
}

namespace {

// Local search over boxes given by ranks. A box contains the points with ranks of at most `last`. The closed box ends
// there, the open box at the next coordinate.
class Ascent {
 public:
  Ascent(const StarGrid& grid, bool closed) : grid_(grid), closed_(closed), last_(grid.dim()), outside_(grid.size()) {}

  double from(std::uint64_t start) {
    for (std::size_t k = 0; k < grid_.dim(); ++k) {
      const double u = uniform<double>(hash(start, k));
      const auto steps = static_cast<double>(grid_.axis(k).size() - 1);
      last_[k] = static_cast<std::uint32_t>(steps * std::pow(u, 1.0 / static_cast<double>(grid_.dim())));
    }
    std::fill(outside_.begin(), outside_.end(), 0u);
    for (std::size_t k = 0; k < grid_.dim(); ++k)
      for (std::size_t i = 0; i < grid_.size(); ++i) outside_[i] += grid_.ranks(i)[k] > last_[k];
    double best = 0;
    for (std::size_t k = 0, idle = 0; idle < grid_.dim(); k = (k + 1) % grid_.dim(), ++idle) {
      const double found = along(k);
      if (found > best) idle = 0;
      best = std::max(best, found);
    }
    return best;
  }

 private:
  double edge(std::size_t k, std::uint32_t last) const { return grid_.axis(k)[last + !closed_]; }

  // Moves the face across axis k to the place of largest error and returns that error.
  double along(std::size_t k) {
    double area = 1;
    for (std::size_t j = 0; j < grid_.dim(); ++j)
      if (j != k) area *= edge(j, last_[j]);
    const auto& order = grid_.order(k);
    const double n = static_cast<double>(grid_.size()), sign = closed_ ? 1 : -1;
    const auto steps = static_cast<std::uint32_t>(grid_.axis(k).size() - 1);
    std::size_t at = 0, inside = 0;
    double worst = -1;
    std::uint32_t where = 0;
    for (std::uint32_t rank = 0; rank < steps; ++rank) {
      for (; at < order.size() && grid_.ranks(order[at])[k] == rank; ++at)
        inside += outside_[order[at]] == (rank > last_[k]);
      const double off = sign * (static_cast<double>(inside) / n - area * edge(k, rank));
      if (off <= worst) continue;
      worst = off;
      where = rank;
    }
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      const std::uint32_t rank = grid_.ranks(i)[k];
      outside_[i] += static_cast<std::uint32_t>(rank > where) - static_cast<std::uint32_t>(rank > last_[k]);
    }
    last_[k] = where;
    return worst;
  }

  const StarGrid& grid_;
  bool closed_;
  std::vector<std::uint32_t> last_;
  std::vector<std::uint32_t> outside_; // for each point, the number of axes along which it is outside
};

} // namespace

double star_ascent(const StarGrid& grid, int starts) {
  double worst = 0;
  for (const bool closed : {false, true}) {
    Ascent ascent(grid, closed);
    for (int s = 0; s < starts; ++s) worst = std::max(worst, ascent.from(hash(static_cast<std::uint64_t>(s), closed)));
  }
  return worst;
}

} // namespace mc
