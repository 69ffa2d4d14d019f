#include <mc/check/cubature.h>

#include <mc/core/error.h>
#include <mc/core/sum.h>
#include <mc/core/types.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

// Nodes on [0,1] and weights of the nested Clenshaw-Curtis rules with n, n/2 and n/4 intervals, on the nodes of the finest.
struct Rule {
  int nodes;
  std::vector<double> x;
  std::array<std::vector<double>, 3> w;

  explicit Rule(int n) : nodes(n + 1), x(static_cast<std::size_t>(n + 1)) {
    for (int j = 0; j <= n; ++j) x[static_cast<std::size_t>(j)] = 0.5 - 0.5 * std::cos(pi<double> * j / n);
    // Just inside the faces: what holds on the far side of a face is another box's business.
    x.front() = 0x1p-24, x.back() = 1 - 0x1p-24;
    for (int level = 0; level < 3; ++level) {
      const int m = n >> level;
      auto& weights = w[static_cast<std::size_t>(level)];
      weights.assign(x.size(), 0.0);
      for (int j = 0; j <= m; ++j) {
        double sum = 1;
        for (int k = 1; 2 * k <= m; ++k) sum -= (2 * k == m ? 1.0 : 2.0) / (4.0 * k * k - 1) * std::cos(2 * pi<double> * k * j / m);
        weights[static_cast<std::size_t>(j << level)] = (m == 1 ? 0.5 : (j == 0 || j == m ? 0.5 : 1.0) * sum / m);
      }
    }
  }
};

struct Region {
  UnitBox box;
  double value = 0, error = 0;
  int owner = 0, axis = 0;
  bool rough = false; // the finer rule was of no use: halve with the cheaper one
  bool operator<(const Region& other) const { return error < other.error; }
};

class Integrator {
 public:
  Integrator(const std::function<double(const std::array<double, 3>&)>& f, int dim) : f_(f), dim_(dim) {}

  void evaluate(Region& r) {
    const Rule& rule = r.rough ? coarse() : fine();
    const int n = rule.nodes;
    std::array<double, 3> width{1, 1, 1};
    double volume = 1;
    for (int d = 0; d < dim_; ++d) width[ix(d)] = r.box.hi[ix(d)] - r.box.lo[ix(d)], volume *= width[ix(d)];
    const std::array<int, 3> count{n, dim_ > 1 ? n : 1, dim_ > 2 ? n : 1};
    values_.clear();
    std::array<double, 3> v{};
    double largest = 0, least = HUGE_VAL;
    for (int k = 0; k < count[2]; ++k)
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) {
          const std::array<int, 3> index{i, j, k};
          for (int d = 0; d < dim_; ++d) v[ix(d)] = r.box.lo[ix(d)] + width[ix(d)] * rule.x[ix(index[ix(d)])];
          double value = f_(v);
          if (!(value >= 0 && value <= std::numeric_limits<double>::max())) {
            if (!bad) bad = v;
            value = 0;
          }
          largest = std::max(largest, value), least = std::min(least, value);
          values_.push_back(value);
        }
    evaluations += values_.size();

    // Line by line along each axis, so that the errors of neighbouring lines cannot cancel.
    double e1 = 0, e2 = 0, worst = -1, integral = 0;
    const std::array<int, 3> stride{1, n, n * n};
    for (int axis = 0; axis < dim_; ++axis) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      double d1 = 0, d2 = 0;
      integral = 0;
      for (int j = 0; j < count[ix(b)]; ++j)
        for (int i = 0; i < count[ix(a)]; ++i) {
          const double w = (count[ix(a)] > 1 ? rule.w[0][ix(i)] : 1.0) * (count[ix(b)] > 1 ? rule.w[0][ix(j)] : 1.0);
          const double* line = values_.data() + i * stride[ix(a)] + j * stride[ix(b)];
          std::array<double, 3> q{};
          for (int k = 0; k < n; ++k)
            for (std::size_t level = 0; level < 3; ++level) q[level] += rule.w[level][ix(k)] * line[k * stride[ix(axis)]];
          integral += w * q[0];
          d1 += w * std::abs(q[0] - q[1]);
          d2 += w * std::abs(q[1] - q[2]);
        }
      e1 += d1, e2 += d2;
      if (d1 > worst) worst = d1, r.axis = axis;
    }
    r.value = integral * volume;
    e1 *= volume, e2 *= volume;
    // Geometric convergence: the next difference would be about e1 (e1 / e2); ten times that is the bound. A small e1 alone may
    // be luck, so a part of e2 stays.
    const double ratio = e2 > 0 ? e1 / e2 : 0.0;
    r.error = ratio < 0.1 ? 10 * e1 * ratio : 2 * e1;
    const bool edge = least == 0 && largest > 0; // of the support: never smooth
    r.error = std::max(r.error, (edge ? 0.25 : r.rough ? 0.1 : 0.01) * e2) + 4e-16 * largest * volume;
    r.rough = r.rough || edge || ratio > 0.3;
  }

  // Halves r in place and returns the other half.
  Region halve(Region& r) {
    Region other = r;
    const std::size_t axis = ix(r.axis);
    const double middle = 0.5 * (r.box.lo[axis] + r.box.hi[axis]);
    const double claimed = r.value, bound = r.error;
    r.box.hi[axis] = other.box.lo[axis] = middle;
    evaluate(r);
    evaluate(other);
    // A bound that its own halves refute says that theirs are too small as well.
    const double change = std::abs(r.value + other.value - claimed);
    if (change > bound) r.error = std::max(r.error, change / 4), other.error = std::max(other.error, change / 4);
    return other;
  }
  static bool divisible(const Region& r) {
    const std::size_t axis = ix(r.axis);
    const double middle = 0.5 * (r.box.lo[axis] + r.box.hi[axis]);
    return middle > r.box.lo[axis] && middle < r.box.hi[axis];
  }

  std::size_t evaluations = 0;
  std::optional<std::array<double, 3>> bad;

 private:
  static std::size_t ix(int i) { return static_cast<std::size_t>(i); }
  static const Rule& fine() {
    static const Rule rule(8);
    return rule;
  }
  static const Rule& coarse() {
    static const Rule rule(4);
    return rule;
  }
  const std::function<double(const std::array<double, 3>&)>& f_;
  int dim_;
  std::vector<double> values_;
};

} // namespace

CubatureResult integrate_boxes(const std::function<double(const std::array<double, 3>&)>& f, int dim, const std::vector<UnitBox>& boxes,
                               const CubatureGoal& goal) {
  require(dim >= 1 && dim <= 3, "integrate_boxes: dim {} must lie in 1..3", dim);
  Integrator integrator(f, dim);
  CubatureResult result;
  result.boxes.resize(boxes.size());
  std::vector<Region> regions;
  regions.reserve(boxes.size());

  // First each box by itself to its own goal, then all together to the goal of the total.
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::size_t first = regions.size();
    Region whole;
    whole.box = boxes[i];
    whole.owner = static_cast<int>(i);
    integrator.evaluate(whole);
    regions.push_back(whole);
    for (;;) {
      double value = 0, error = 0;
      for (std::size_t r = first; r < regions.size(); ++r) value += regions[r].value, error += regions[r].error;
      const double allowed = goal.box_error ? goal.box_error(value) : goal.total_error;
      if (error <= allowed) break;
      if (integrator.evaluations >= goal.max_evaluations) {
        result.converged = false;
        break;
      }
      // Halve every region with more than its share: cheaper than one at a time, since the sums are recomputed.
      const double share = 0.5 * allowed / static_cast<double>(regions.size() - first);
      bool progress = false;
      for (std::size_t r = first, end = regions.size(); r < end; ++r)
        if (regions[r].error > share && Integrator::divisible(regions[r])) {
          Region other = integrator.halve(regions[r]);
          regions.push_back(other);
          progress = true;
        }
      if (!progress) break;
    }
  }

  double error = 0;
  for (const Region& r : regions) error += r.error;
  std::make_heap(regions.begin(), regions.end());
  while (error > goal.total_error && integrator.evaluations < goal.max_evaluations && Integrator::divisible(regions.front())) {
    std::pop_heap(regions.begin(), regions.end());
    error -= regions.back().error;
    Region other = integrator.halve(regions.back());
    error += regions.back().error + other.error;
    std::push_heap(regions.begin(), regions.end());
    regions.push_back(other);
    std::push_heap(regions.begin(), regions.end());
  }

  CompensatedSum value, bound;
  for (const Region& r : regions) {
    auto& box = result.boxes[static_cast<std::size_t>(r.owner)];
    box.value += r.value, box.error += r.error;
    value.add(r.value), bound.add(r.error);
  }
  result.total = {value.value(), bound.value()};
  result.converged = result.converged && result.total.error <= goal.total_error;
  result.evaluations = integrator.evaluations;
  result.bad = integrator.bad;
  return result;
}

} // namespace mc
