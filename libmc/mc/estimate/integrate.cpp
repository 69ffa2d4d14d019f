#include <mc/core/error.h>
#include <mc/estimate/integrate.h>

#include <ostream>

namespace mc {

namespace {
// Tail index up to which the integral may be infinite: 1, and the deviation of an index fitted to 62 values.
constexpr double perhaps_infinite = 1.25;
} // namespace

std::string_view name(ErrorBar bar) {
  switch (bar) {
  case ErrorBar::known: return "known";
  case ErrorBar::all_zero: return "all_zero";
  case ErrorBar::undersampled: return "undersampled";
  case ErrorBar::too_few_points: return "too_few_points";
  case ErrorBar::infinite_variance: return "infinite_variance";
  case ErrorBar::not_integrable: return "not_integrable";
  }
  return "";
}

NotFinite::NotFinite(std::uint64_t bad_points, std::uint64_t of_points, std::vector<double> point,
                     std::string_view where)
    : Error(fmt::format("integrate: the integrand is not finite at {} of {} points, the first at {}; it must be finite "
                        "almost everywhere",
                        bad_points, of_points, where)),
      bad(bad_points), points(of_points), u(std::move(point)) {}

bool Integral::may_diverge() const {
  return error_bar == ErrorBar::undersampled || error_bar == ErrorBar::not_integrable;
}

std::string Integral::to_string() const {
  std::string text;
  switch (error_bar) {
  case ErrorBar::known:
    text = fmt::format("{:.10g} ± {:.2g} (standard error), {:g} % in [{:.10g}, {:.10g}]", estimate.value,
                       estimate.std_error, 100 * confidence, interval.lo, interval.hi);
    if (constant) text += fmt::format("; constant at all {} points", calls);
    break;
  case ErrorBar::all_zero:
    text = fmt::format("0, error not known: the integrand was 0 at all {} points. Other values fill at most {:.2g} of "
                       "the volume (95 %)",
                       calls, 3 / static_cast<double>(calls));
    break;
  case ErrorBar::undersampled:
    text =
        fmt::format("a few of {} points hold most of {:.4g}: the integral has a peak that few points met, or does not "
                    "converge absolutely",
                    calls, estimate.value);
    break;
  case ErrorBar::too_few_points:
    text = fmt::format("{:.10g}, error not known: {} points are too few for so many dimensions. More calls are needed",
                       estimate.value, calls);
    break;
  case ErrorBar::infinite_variance:
    text = fmt::format("{:.10g}, error not known: the variance ", estimate.value);
    if (infinite_points > 0)
      text += fmt::format("is infinite (as is the integrand at {} points, which count as 0)", infinite_points);
    else if (tail_index < perhaps_infinite)
      text += fmt::format("looks infinite, and the integral may be (tail index {:.2f}; a finite variance needs more "
                          "than 2, a finite integral more than 1)",
                          tail_index);
    else text += fmt::format("looks infinite (tail index {:.2f}; a finite variance needs more than 2)", tail_index);
    break;
  case ErrorBar::not_integrable:
    text = fmt::format("the integral does not seem to converge absolutely (tail index {:.2f}; an integral needs more "
                       "than 1): it is infinite or conditionally convergent. {} points give {:.4g}",
                       tail_index, calls, estimate.value);
    break;
  }
  if (!consistent)
    text += fmt::format("; the rounds disagree (chi-square {:.3g} for {:.0f} degree{} of freedom): distrust the error",
                        chi2, chi2_dof, chi2_dof == 1 ? "" : "s");
  return text;
}

std::ostream& operator<<(std::ostream& out, const Integral& r) { return out << r.to_string(); }

std::string_view name(StopReason stop) {
  switch (stop) {
  case StopReason::converged: return "converged";
  case StopReason::max_calls: return "max_calls";
  case StopReason::cancelled: return "cancelled";
  }
  return "";
}

} // namespace mc
