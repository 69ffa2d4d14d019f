#pragma once
/// The largest error of a deterministic law, with its place.

#include <mc/check/report/report.h>

#include <concepts>
#include <string>
#include <utility>

namespace mc {

/// Collects the errors of one law at many points.
class WorstError {
 public:
  WorstError(std::string law, double limit, Fault fault) : law_(std::move(law)), limit_(limit), fault_(fault) {}

  /// Adds the error at one point. `describe` returns the finding (observed value, expected value, place); it is called
  /// only for a new largest error beyond the limit. NaN exceeds every other error.
  template <std::invocable Describe> void note(double error, Describe&& describe) {
    ++points_;
    if (error <= limit_) {
      if (error > worst_ && broken_ == 0) worst_ = error;
      return;
    }
    if (broken_++ == 0 || !(error <= worst_)) {
      if (broken_ > 1 && worst_ != worst_) return;
      worst_ = error;
      witness_ = describe();
    }
  }

  /// Returns the result; fails if any error exceeds the limit.
  Check check() const {
    Check c{law_, broken_ == 0 ? Verdict::pass : Verdict::fail, {}, 0, worst_, limit_, fault_, {}};
    if (broken_ > 0)
      c.detail =
          witness_ + "; " + std::to_string(broken_) + " of " + std::to_string(points_) + " points break this law";
    return c;
  }

 private:
  std::string law_, witness_;
  double limit_, worst_ = 0;
  Fault fault_;
  std::size_t points_ = 0, broken_ = 0;
};

} // namespace mc
