#include <mc/points/star_discrepancy.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace mc {

namespace {

// The coordinates that the points have along each axis, with 0 before and 1 behind them; a point is where its
// coordinates stand there.
struct Ranks {
  std::vector<std::vector<double>> coordinate; // by axis, ascending
  std::vector<std::uint32_t> rank;             // of coordinate k of point i at i * dim + k
  std::size_t dim;

  explicit Ranks(PointList p) : coordinate(p.dim, {0.0, 1.0}), rank(p.values.size()), dim(p.dim) {
    for (std::size_t k = 0; k < dim; ++k) {
      std::vector<double>& c = coordinate[k];
      for (std::size_t i = 0; i < p.size(); ++i) c.push_back(p[i][k]);
      std::sort(c.begin(), c.end());
      c.erase(std::unique(c.begin(), c.end()), c.end());
      for (std::size_t i = 0; i < p.size(); ++i)
        rank[i * dim + k] = static_cast<std::uint32_t>(std::lower_bound(c.begin(), c.end(), p[i][k]) - c.begin());
    }
  }
};

// The boxes whose corner lies above coordinate lo[k] and at most at hi[k] along every axis.
struct Corners {
  std::vector<std::uint32_t> lo, hi;
  std::vector<std::uint32_t> open; // points that are in some of the boxes and not in all
  std::size_t inside = 0;          // points that are in all of them
  double most = 1;                 // bound on the discrepancy of all of them
  bool operator<(const Corners& other) const { return most < other.most; }
};

class Search {
 public:
  explicit Search(PointList points) : ranks_(points), n_(static_cast<double>(points.size())) {
    Corners all;
    for (const auto& c : ranks_.coordinate) {
      all.lo.push_back(0);
      all.hi.push_back(static_cast<std::uint32_t>(c.size() - 1));
    }
    for (std::uint32_t i = 0; i < points.size(); ++i) all.open.push_back(i);
    push(std::move(all));
  }

  StarDiscrepancy run(std::uint64_t work) {
    while (!queue_.empty() && queue_.top().most > lower_ && work_ < work) {
      const Corners worst = queue_.top();
      queue_.pop();
      halve(worst);
    }
    return {lower_, queue_.empty() ? lower_ : std::max(lower_, queue_.top().most)};
  }

 private:
  // Moves to `inside` the open points that all boxes hold, drops those that none holds, and bounds the rest.
  void push(Corners c) {
    std::size_t kept = 0;
    work_ += c.open.size() + 16;
    for (const std::uint32_t i : c.open) {
      const std::uint32_t* rank = ranks_.rank.data() + i * ranks_.dim;
      bool in_all = true, in_none = false;
      for (std::size_t k = 0; k < ranks_.dim; ++k) {
        in_all = in_all && rank[k] <= c.lo[k];
        in_none = in_none || rank[k] >= c.hi[k];
      }
      if (in_all) ++c.inside;
      else if (!in_none) c.open[kept++] = i;
    }
    c.open.resize(kept);
    double small = 1, large = 1;
    bool divisible = false;
    for (std::size_t k = 0; k < ranks_.dim; ++k) {
      small *= ranks_.coordinate[k][c.lo[k]];
      large *= ranks_.coordinate[k][c.hi[k]];
      divisible = divisible || c.hi[k] - c.lo[k] > 1;
    }
    const double fewest = static_cast<double>(c.inside) / n_, most = static_cast<double>(c.inside + kept) / n_;
    lower_ = std::max({lower_, large - most, fewest - small});
    c.most = std::max(large - fewest, most - small);
    if (!divisible) lower_ = std::max(lower_, c.most); // both are attained
    else if (c.most > lower_) queue_.push(std::move(c));
  }

  // Across the axis along which the volume differs by the largest factor, in the middle.
  void halve(const Corners& c) {
    std::size_t axis = 0;
    double widest = -1;
    for (std::size_t k = 0; k < ranks_.dim; ++k) {
      if (c.hi[k] - c.lo[k] < 2) continue;
      const double a = ranks_.coordinate[k][c.lo[k]], b = ranks_.coordinate[k][c.hi[k]], wide = (b - a) / b;
      if (wide <= widest) continue;
      widest = wide;
      axis = k;
    }
    const std::vector<double>& x = ranks_.coordinate[axis];
    const double middle = 0.5 * (x[c.lo[axis]] + x[c.hi[axis]]);
    const auto at = std::lower_bound(x.begin() + c.lo[axis] + 1, x.begin() + c.hi[axis] - 1, middle);
    const auto cut = static_cast<std::uint32_t>(at - x.begin());
    Corners low = c, high = c;
    low.hi[axis] = cut;
    high.lo[axis] = cut;
    push(std::move(low));
    push(std::move(high));
  }

  Ranks ranks_;
  double n_, lower_ = 0;
  std::uint64_t work_ = 0;
  std::priority_queue<Corners> queue_;
};

} // namespace

StarDiscrepancy star_discrepancy(PointList points, std::uint64_t work) {
  require_unit_points(points);
  return Search(points).run(work);
}

} // namespace mc
