#include <plugin/pure_check.h>

#include <mc/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

namespace carlo {

namespace {

class Comparison {
 public:
  // A slow integrand is evaluated at fewer points.
  explicit Comparison(const PureCheck& check) : check_(check) {
    constexpr std::size_t most = 22 * 23 / 2; // batches of 1 to 22 points
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    while (count_ < most && (count_ == 0 || std::chrono::steady_clock::now() < end)) {
      points_.resize((count_ + 1) * check.dim);
      values_.resize((count_ + 1) * check.outputs);
      check.point(count_, std::span(points_).last(check.dim));
      check.each(points(count_, 1), std::span(values_).last(check.outputs));
      ++count_;
    }
    for (const double value : values_)
      if (std::isfinite(value)) size_ = std::max(size_, std::abs(value));
  }

  std::size_t count() const { return count_; }

  void repeat(std::size_t i) const {
    const std::vector<double> again = values_of(check_.each, i, 1);
    hold(i, again, "and then", "it must depend on x alone, on nothing before");
  }
  void repeat_batch(std::size_t first, std::size_t size) const {
    const std::vector<double> again = values_of(check_.many, first, size);
    for (std::size_t i = 0; i < size; ++i)
      hold(first + i, std::span(again).subspan(i * check_.outputs, check_.outputs),
           fmt::format("and {}, as point {} of {},", check_.many_name, i, size), check_.many_remedy);
  }

 private:
  std::span<const double> points(std::size_t first, std::size_t count) const {
    return std::span(points_).subspan(first * check_.dim, count * check_.dim);
  }
  // A value that is not written stays NaN.
  std::vector<double> values_of(const EvalPoints& eval, std::size_t first, std::size_t count) const {
    std::vector<double> values(count * check_.outputs, std::numeric_limits<double>::quiet_NaN());
    eval(points(first, count), values);
    return values;
  }
  // Values may differ by rounding, for example in a vectorised loop. If both are not finite, the integration reports
  // it.
  void hold(std::size_t i, std::span<const double> again, const std::string& says, const std::string& remedy) const {
    constexpr double tolerance = 1.5e-8; // about the square root of epsilon
    for (std::size_t k = 0; k < check_.outputs; ++k) {
      const double first = values_[i * check_.outputs + k];
      const bool same = first == again[k] || std::abs(again[k] - first) <= tolerance * size_;
      mc::require(same || (std::isnan(first) && std::isnan(again[k])), "{}: at {}{} eval says {:.17g} {} {:.17g}; {}",
                  check_.name, place(i), check_.outputs > 1 ? fmt::format(" output {}", k) : "", first, says, again[k],
                  remedy);
    }
  }
  std::string place(std::size_t i) const {
    constexpr std::size_t most = 8;
    std::string text = "x = (";
    for (std::size_t k = 0; k < std::min(check_.dim, most); ++k)
      text += fmt::format("{}{:.17g}", k > 0 ? ", " : "", points(i, 1)[k]);
    return text + (check_.dim > most ? ", ...)" : ")");
  }

  const PureCheck& check_;
  std::size_t count_ = 0;
  std::vector<double> points_, values_;
  double size_ = 0;
};

} // namespace

void require_pure(const PureCheck& check) {
  const Comparison comparison(check);
  const std::size_t count = comparison.count();
  for (std::size_t i = count; i-- > 0;) comparison.repeat(i);
  if (!check.many) return;
  comparison.repeat_batch(0, count);
  // Batches of every small size, to test the remainders of vectorised loops.
  for (std::size_t first = 0, size = 1; first < count; first += size++)
    comparison.repeat_batch(first, std::min(size, count - first));
}

} // namespace carlo
