#pragma once
/// The worst case of a deterministic law, with its witness.

#include <mc/check/report/report.h>

#include <concepts>
#include <string>
#include <utility>

namespace mc {

/// Collects the errors of one law over many points.
class WorstError {
 public:
  WorstError(std::string law, double limit, Fault fault) : law_(std::move(law)), limit_(limit), fault_(fault) {}

  /// One point: its error, and a description that is only made for a new worst one beyond the limit. NaN is the worst
  /// error.
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

  Check check() const {
    Check c{law_, broken_ == 0 ? Verdict::pass : Verdict::fail, {}, 0, worst_, limit_, fault_, {}};
    if (broken_ > 0)
      c.detail = witness_ + "; broken at " + std::to_string(broken_) + " of " + std::to_string(points_) + " points";
    return c;
  }

 private:
  std::string law_, witness_;
  double limit_, worst_ = 0;
  Fault fault_;
  std::size_t points_ = 0, broken_ = 0;
};

} // namespace mc
