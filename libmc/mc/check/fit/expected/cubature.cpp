#include <mc/check/fit/expected/cubature.h>

#include <mc/core/error.h>
#include <mc/core/sum.h>
#include <mc/core/types.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

// Nodes on [0,1] of nested Clenshaw-Curtis rules with n, n/2 and n/4 intervals. For each node that a rule adds to the
// next coarser rule, the weights of the coarser interpolant there.
struct Rule {
  struct Surplus {
    std::size_t node;
    double weight;
    std::vector<double> interpolation;
  };
  int nodes;
  std::vector<double> x, w;
  std::array<std::vector<Surplus>, 2> surpluses; // of the finest rule, and of the next

  explicit Rule(int n) : nodes(n + 1), x(static_cast<std::size_t>(n + 1)), w(weights(n, 1)) {
    for (int j = 0; j <= n; ++j) x[static_cast<std::size_t>(j)] = 0.5 - 0.5 * std::cos(pi<double> * j / n);
    for (int level = 0; level < 2; ++level) {
      const int stride = 1 << level;
      const std::vector<double> own = weights(n / stride, stride);
      for (int j = stride; j < n; j += 2 * stride) {
        Surplus s{static_cast<std::size_t>(j), own[static_cast<std::size_t>(j)], std::vector<double>(x.size(), 0.0)};
        for (int k = 0; k <= n; k += 2 * stride) {
          double product = 1;
          for (int m = 0; m <= n; m += 2 * stride)
            if (m != k)
              product *= (x[s.node] - x[static_cast<std::size_t>(m)]) /
                         (x[static_cast<std::size_t>(k)] - x[static_cast<std::size_t>(m)]);
          s.interpolation[static_cast<std::size_t>(k)] = product;
        }
        surpluses[static_cast<std::size_t>(level)].push_back(std::move(s));
      }
    }
    // Slightly inside the faces: values on the far side of a face belong to another box.
    x.front() = 0x1p-24;
    x.back() = 1 - 0x1p-24;
  }

 private:
  std::vector<double> weights(int m, std::size_t stride) const {
    std::vector<double> result(x.size(), 0.0);
    for (int j = 0; j <= m; ++j) {
      double sum = 1;
      for (int k = 1; 2 * k <= m; ++k)
        sum -= (2 * k == m ? 1.0 : 2.0) / (4.0 * k * k - 1) * std::cos(2 * pi<double> * k * j / m);
      result[static_cast<std::size_t>(j) * stride] = (j == 0 || j == m ? 0.5 : 1.0) * sum / m;
    }
    return result;
  }
};

struct Region {
  UnitBox box;
  double value = 0, error = 0;
  int owner = 0, axis = 0;
  bool rough = false; // the finer rule did not help: halve with the cheaper rule
  bool operator<(const Region& other) const { return error < other.error; }
};

class Integrator {
 public:
  Integrator(const BatchFunction& f, int dim) : f_(f), dim_(dim) {}

  void evaluate(Region& r) {
    const Rule& rule = r.rough && dim_ == 3 ? coarse() : fine();
    const int n = rule.nodes;
    PerAxis<double> width{1, 1, 1};
    double volume = 1;
    for (int d = 0; d < dim_; ++d) {
      width[ix(d)] = r.box.hi[ix(d)] - r.box.lo[ix(d)];
      volume *= width[ix(d)];
    }
    const std::array<int, 3> count{n, dim_ > 1 ? n : 1, dim_ > 2 ? n : 1};
    points_.clear();
    PerAxis<double> v{};
    for (int k = 0; k < count[2]; ++k)
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) {
          const std::array<int, 3> index{i, j, k};
          for (int d = 0; d < dim_; ++d) v[ix(d)] = r.box.lo[ix(d)] + width[ix(d)] * rule.x[ix(index[ix(d)])];
          points_.push_back(v);
        }
    values_.resize(points_.size());
    f_(points_, values_);
    double largest = 0, least = HUGE_VAL;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      double& value = values_[i];
      if (!(value >= 0 && value <= std::numeric_limits<double>::max())) {
        if (!invalid_point) invalid_point = points_[i];
        value = 0;
      }
      largest = std::max(largest, value);
      least = std::min(least, value);
    }
    evaluations += values_.size();

    // Absolute difference between each new node and the interpolant of the coarser rule. Neither nodes nor lines
    // cancel, so a function with random jumps cannot look smooth.
    double e1 = 0, e2 = 0, worst = -1, integral = 0;
    const std::array<int, 3> stride{1, n, n * n};
    for (int axis = 0; axis < dim_; ++axis) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      std::array<double, 2> d{};
      integral = 0;
      for (int j = 0; j < count[ix(b)]; ++j)
        for (int i = 0; i < count[ix(a)]; ++i) {
          const double w = (count[ix(a)] > 1 ? rule.w[ix(i)] : 1.0) * (count[ix(b)] > 1 ? rule.w[ix(j)] : 1.0);
          const double* line = values_.data() + i * stride[ix(a)] + j * stride[ix(b)];
          const int step = stride[ix(axis)];
          for (int k = 0; k < n; ++k) integral += w * rule.w[ix(k)] * line[k * step];
          for (std::size_t level = 0; level < 2; ++level)
            for (const Rule::Surplus& s : rule.surpluses[level]) {
              double expected = 0;
              for (int k = 0; k < n; k += 2 << level) expected += s.interpolation[ix(k)] * line[k * step];
              d[level] += w * s.weight * std::abs(line[static_cast<int>(s.node) * step] - expected);
            }
        }
      e1 += d[0];
      e2 += d[1];
      if (d[0] > worst) {
        worst = d[0];
        r.axis = axis;
      }
    }
    r.value = integral * volume;
    e1 *= volume;
    e2 *= volume;
    // Geometric convergence: the next surplus is about e1 (e1 / e2); the bound is ten times that.
    const double ratio = e2 > 0 ? e1 / e2 : 0.0;
    r.error = ratio < 0.1 ? 10 * e1 * ratio : e1;
    const bool edge = least == 0 && largest > 0; // an edge of the support is never smooth
    r.error = std::max(r.error, least_share(edge, r.rough) * e2) + 4e-16 * largest * volume;
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
    // If the halves refute the bound of the whole, their own bounds are too small as well.
    const double change = std::abs(r.value + other.value - claimed);
    if (change > bound) {
      r.error = std::max(r.error, change / 4);
      other.error = std::max(other.error, change / 4);
    }
    return other;
  }
  static bool divisible(const Region& r) {
    const std::size_t axis = ix(r.axis);
    const double middle = 0.5 * (r.box.lo[axis] + r.box.hi[axis]);
    return middle > r.box.lo[axis] && middle < r.box.hi[axis];
  }

  // Refinement stops at an invalid density.
  bool spent(const CubatureGoal& goal) const { return invalid_point || evaluations >= goal.max_evaluations; }

  std::size_t evaluations = 0;
  std::optional<PerAxis<double>> invalid_point;

 private:
  static std::size_t ix(int i) { return static_cast<std::size_t>(i); }
  // Smallest error as a fraction of the coarser surplus; larger if f is not smooth.
  static double least_share(bool edge, bool rough) {
    if (edge) return 0.25;
    return rough ? 0.1 : 0.002;
  }
  static const Rule& fine() {
    static const Rule rule(8);
    return rule;
  }
  static const Rule& coarse() {
    static const Rule rule(4);
    return rule;
  }
  const BatchFunction& f_;
  int dim_;
  std::vector<PerAxis<double>> points_;
  std::vector<double> values_;
};

} // namespace

CubatureResult integrate_boxes(const std::function<double(const PerAxis<double>&)>& f, int dim,
                               const std::vector<UnitBox>& boxes, const CubatureGoal& goal) {
  const BatchFunction many = [&f](std::span<PerAxis<double>> v, std::span<double> values) {
    std::transform(v.begin(), v.end(), values.begin(), f);
  };
  return integrate_boxes(many, dim, boxes, goal);
}

CubatureResult integrate_boxes(const BatchFunction& f, int dim, const std::vector<UnitBox>& boxes,
                               const CubatureGoal& goal) {
  require(dim >= 1 && dim <= max_cubature_dim, "integrate_boxes: dim {} must lie in 1..{}", dim, max_cubature_dim);
  Integrator integrator(f, dim);
  CubatureResult result;
  result.boxes.resize(boxes.size());
  std::vector<Region> regions;
  regions.reserve(boxes.size());

  // First refines each box to its own goal, then all boxes together to the goal of the total.
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::size_t first = regions.size();
    Region whole;
    whole.box = boxes[i];
    whole.owner = static_cast<int>(i);
    integrator.evaluate(whole);
    regions.push_back(whole);
    for (;;) {
      double value = 0, error = 0;
      for (std::size_t r = first; r < regions.size(); ++r) {
        value += regions[r].value;
        error += regions[r].error;
      }
      const double allowed = goal.box_error ? goal.box_error(value) : goal.total_error;
      if (error <= allowed) break;
      if (integrator.spent(goal)) {
        result.converged = false;
        break;
      }
      // Halves every region that exceeds its share. This is cheaper than one region at a time, since the sums are
      // recomputed each time.
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
  while (error > goal.total_error && !integrator.spent(goal) && Integrator::divisible(regions.front())) {
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
    box.value += r.value;
    box.error += r.error;
    value.add(r.value);
    bound.add(r.error);
  }
  result.total = {value.value(), bound.value()};
  result.converged = result.converged && result.total.error <= goal.total_error;
  result.evaluations = integrator.evaluations;
  result.invalid_point = integrator.invalid_point;
  return result;
}

} // namespace mc
