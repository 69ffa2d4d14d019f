#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/estimate/integrate.h>

#include <array>
#include <ostream>

namespace mc {

namespace {
constexpr std::array<std::string_view, 6> method_names = {"auto", "plain", "stratified", "rqmc", "vegas", "tree"};
} // namespace

std::string_view name(Method method) { return method_names[static_cast<std::size_t>(method)]; }

Method parse_method(std::string_view word) { return static_cast<Method>(index_of("method", word, method_names)); }

std::string_view name(ErrorBar bar) {
  switch (bar) {
  case ErrorBar::known: return "known";
  case ErrorBar::all_zero: return "unseen";
  case ErrorBar::undersampled: return "hardly_met";
  case ErrorBar::infinite_variance: return "infinite_variance";
  }
  return "";
}

NotFinite::NotFinite(std::uint64_t bad_points, std::uint64_t of_points, std::vector<double> point,
                     std::string_view where)
    : Error(fmt::format("integrate: the integrand is not finite at {} of {} points, the first at {}; it must be finite "
                        "almost everywhere",
                        bad_points, of_points, where)),
      bad(bad_points), points(of_points), u(std::move(point)) {}

std::string Integral::to_string() const {
  std::string text;
  switch (error_bar) {
  case ErrorBar::known:
    text = fmt::format("{:.10g} ± {:.2g} (standard error), {:g} % in [{:.10g}, {:.10g}]", estimate.value,
                       estimate.std_error, 100 * confidence, interval.lo, interval.hi);
    break;
  case ErrorBar::all_zero:
    text = fmt::format("0, error not known yet: the integrand was 0 at every point. What is not 0 fills at most {:.2g} "
                       "of the volume (95 %)",
                       3 / static_cast<double>(calls));
    break;
  case ErrorBar::undersampled:
    text = fmt::format(
        "{:.10g}, error not known yet: a few of {} points hold much of it, and larger values may be missing",
        estimate.value, calls);
    break;
  case ErrorBar::infinite_variance:
    text = fmt::format("{:.10g}, error not known: the variance ", estimate.value);
    if (infinite_points > 0)
      text += fmt::format("is infinite (as is the integrand at {} points, which count as 0)", infinite_points);
    else
      text += fmt::format("looks infinite (the largest values fall off with index {:.2f}{}; a variance needs more than "
                          "2, an integral more than 1)",
                          tail_index, tail_index > 2 ? ", not told from 2" : "");
    break;
  }
  if (!consistent)
    text += fmt::format("; the rounds disagree (chi-square {:.3g} for {:.0f} degrees of freedom): distrust the error",
                        chi2, chi2_dof);
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
