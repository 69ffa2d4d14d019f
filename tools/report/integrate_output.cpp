#include <report/integrate_output.h>
#include <report/report_json.h>
#include <terminal/progress.h>
#include <terminal/version.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

// Returns a remedy for an estimate without an error bar.
const char* remedy(mc::ErrorBar bar) {
  switch (bar) {
  case mc::ErrorBar::known: return "";
  case mc::ErrorBar::undersampled:
  case mc::ErrorBar::all_zero:
    return "; raise --max-calls, name the place with --peak, or narrow --domain to the part that matters";
  case mc::ErrorBar::too_few_points: return "; raise --max-calls, or name the place of a peak with --peak";
  case mc::ErrorBar::infinite_variance:
    return ". Substitute a variable that removes the singularity; if there is none, raise --max-calls";
  case mc::ErrorBar::not_integrable: return ". Split --domain at the singularity, or subtract the part that diverges";
  }
  return "";
}

std::string value_with_error(const mc::Estimate& e, mc::ErrorBar bar) {
  return bar == mc::ErrorBar::known ? fmt::format("{:<14.8g} ± {:<8.2g}", e.value, e.std_error)
                                    : fmt::format("{:<14.8g} ± {:<8}", e.value, "?");
}

std::string about_truth(const UnitCubeIntegral& e, const mc::Integral& r) {
  if (!std::isfinite(e.truth)) return "";
  if (r.error_bar != mc::ErrorBar::known) return fmt::format("the true value is {:.10g}\n", e.truth);
  const double sigmas = r.estimate.std_error > 0 ? std::abs(r.estimate.value - e.truth) / r.estimate.std_error : 0.0;
  return fmt::format("the true value is {:.10g}, {:.2f} standard errors away\n", e.truth, sigmas);
}

std::string correlation_table(const mc::VectorIntegral& r) {
  std::string text = "correlations of the errors\n";
  for (std::size_t i = 0; i < r.outputs.size(); ++i) {
    for (std::size_t j = 0; j < r.outputs.size(); ++j) text += fmt::format(" {:>6.3f}", r.correlation(i, j));
    text += "\n";
  }
  return text;
}

nlohmann::json as_json(const DerivedValue& d) {
  return {{"expression", d.expression}, {"value", d.value},    {"std_error", d.std_error},
          {"lo", d.interval.lo},        {"hi", d.interval.hi}, {"error_bar", d.has_pole ? "pole" : name(d.error_bar)},
          {"linear", d.is_linear}};
}

nlohmann::json as_json(const SweptValues& values) {
  nlohmann::json j = nlohmann::json::object();
  for (const auto& [name, value] : values) j[name] = value;
  return j;
}

std::string derived_text(const DerivedValue& d) {
  if (d.has_pole)
    return fmt::format("{} = {:.10g}, error not known: it is not finite within the errors of the integrals\n",
                       d.expression, d.value);
  if (d.error_bar != mc::ErrorBar::known)
    return fmt::format("{} = {:.10g}, error not known, as that of an integral in it\n", d.expression, d.value);
  return fmt::format("{} = {:.10g} ± {:.2g} (standard error, from the covariance), 95 % in [{:.10g}, {:.10g}]{}\n",
                     d.expression, d.value, d.std_error, d.interval.lo, d.interval.hi,
                     d.is_linear ? "" : "; it is nonlinear within the errors of the integrals: lower --rel-error");
}

nlohmann::json as_json(const mc::Integral& r, const UnitCubeIntegral& e) {
  nlohmann::json j = {{"integrand", e.name},
                      {"value", r.estimate.value},
                      {"std_error", r.estimate.std_error},
                      {"lo", r.interval.lo},
                      {"hi", r.interval.hi},
                      {"error_bar", name(r.error_bar)},
                      {"chi2", r.chi2},
                      {"chi2_dof", r.chi2_dof},
                      {"consistent", r.consistent},
                      {"infinite", r.infinite_points}};
  if (std::isfinite(e.truth)) j["truth"] = e.truth;
  for (const mc::IntegrateRound& round : r.rounds)
    j["rounds"].push_back({{"method", name(round.method)},
                           {"learning", round.learning},
                           {"calls", round.calls},
                           {"value", round.estimate.value},
                           {"std_error", round.estimate.std_error},
                           {"error_bar", name(round.error_bar)},
                           {"chi2", round.chi2}});
  return j;
}

// Returns the stop reason; a cancelled run is called interrupted.
std::string_view why_stopped(const mc::Integral& r) {
  return r.stop == mc::StopReason::cancelled ? "interrupted" : name(r.stop);
}

} // namespace

std::string calls_text(const IntegrateResults& found) {
  const mc::Integral& first = found.results.outputs.front();
  std::string text;
  if (found.replaced > 0)
    text = fmt::format("{} values were not a number and count as {} (--nan)\n", found.replaced, found.replacement);
  return text + fmt::format("{} calls in {} by {}; stopped: {}\n", format_count(double(first.calls)),
                            format_seconds(first.seconds), name(first.method), why_stopped(first));
}

std::string integrate_summary(const IntegrateResults& found) {
  std::string text;
  for (std::size_t i = 0; i < found.integrands.size(); ++i) {
    const mc::Integral& r = found.results.outputs[i];
    text += fmt::format("{}{} {}{}\n", found.integrands[i].title, r.may_diverge() ? ":" : " =", r.to_string(),
                        remedy(r.error_bar));
  }
  text += calls_text(found);
  for (std::size_t i = 0; i < found.integrands.size(); ++i)
    text += about_truth(found.integrands[i], found.results.outputs[i]);
  if (found.integrands.size() > 1) text += correlation_table(found.results);
  for (const DerivedValue& d : found.derived) text += derived_text(d);
  return text;
}

std::string round_table(const mc::Integral& r) {
  std::string text = fmt::format("{:<17} {:>8}  {:<25}  {}\n", "round", "calls", "estimate", "chi2 against result");
  for (const mc::IntegrateRound& round : r.rounds)
    text += fmt::format("{:<17} {:>8}  {}  {}\n",
                        fmt::format("{}{}", name(round.method), round.learning ? ", learning" : ""),
                        format_count(double(round.calls)), value_with_error(round.estimate, round.error_bar),
                        std::isfinite(round.chi2) ? fmt::format("{:.2f}", round.chi2) : "-");
  return text + fmt::format("sum of chi2: {:.2f}, {:.0f} degree{} of freedom\n", r.chi2, r.chi2_dof,
                            r.chi2_dof == 1 ? "" : "s");
}

std::string histogram_table(const IntegrateResults& found) {
  double largest = 0;
  std::size_t width = 0;
  for (const HistogramBin& b : found.histogram) {
    largest = std::max(largest, std::abs(b.integral.estimate.value));
    width = std::max(width, b.name.size());
  }
  const mc::Estimate& whole = found.results.outputs.front().estimate;
  const mc::Estimate::Interval& interval = found.results.outputs.front().interval;
  const bool has_shares = interval.lo > 0 || interval.hi < 0; // shares are meaningless if the whole may be 0
  std::string text;
  for (const HistogramBin& b : found.histogram) {
    const double value = b.integral.estimate.value;
    const auto length = static_cast<std::size_t>(largest > 0 ? std::lround(30 * std::abs(value) / largest) : 0);
    text += fmt::format("{:<{}}  {}  {:>8} {}\n", b.name, width,
                        value_with_error(b.integral.estimate, b.integral.error_bar),
                        has_shares ? fmt::format("{:.2f} %", 100 * value / whole.value) : "",
                        std::string(length, value < 0 ? '-' : '#'));
  }
  return text;
}

std::string quantile_table(const IntegrateResults& found) {
  std::string text;
  for (const mc::Quantile& q : found.quantiles)
    text += fmt::format("quantile {:g}: {:.8g}, 95 % in [{:.8g}, {:.8g}]\n", q.probability, q.value, q.interval.lo,
                        q.interval.hi);
  return text;
}

std::string integrals_json(const IntegrateResults& found, const std::string& command, std::uint64_t seed) {
  const mc::Integral& first = found.results.outputs.front();
  const std::size_t n = found.integrands.size();
  const auto output_json = [&](std::size_t i) {
    nlohmann::json j = as_json(found.results.outputs[i], found.integrands[i]);
    if (!found.names.empty()) j["name"] = found.names[i % found.names.size()];
    if (found.is_sweep()) j["set"] = as_json(found.points[i / found.integrands_per_point()]);
    return j;
  };
  // The keys of a single integral also stand at the top, as they did before there were several.
  nlohmann::json j = n == 1 ? output_json(0) : nlohmann::json::object();
  j.update({{"command", command},
            {"commit", commit},
            {"seed", seed},
            {"calls", first.calls},
            {"seconds", first.seconds},
            {"method", name(first.method)},
            {"stop", why_stopped(first)},
            {"replaced", found.replaced}});
  for (std::size_t i = 0; i < n; ++i) {
    j["outputs"].push_back(output_json(i));
    nlohmann::json correlations, covariances;
    for (std::size_t k = 0; k < n; ++k) {
      correlations.push_back(found.results.correlation(i, k));
      covariances.push_back(found.results.covariance(i, k));
    }
    j["correlation"].push_back(correlations);
    j["covariance"].push_back(covariances);
  }
  for (std::size_t i = 0; i < found.derived.size(); ++i) {
    j["derived"].push_back(as_json(found.derived[i]));
    if (found.is_sweep())
      j["derived"].back()["set"] = as_json(found.points[i / (found.derived.size() / found.points.size())]);
  }
  for (const HistogramBin& b : found.histogram)
    j["histogram"].push_back({{"bin", b.name},
                              {"lo", b.lo},
                              {"hi", b.hi},
                              {"value", b.integral.estimate.value},
                              {"std_error", b.integral.estimate.std_error},
                              {"error_bar", name(b.integral.error_bar)}});
  for (const mc::Quantile& q : found.quantiles)
    j["quantiles"].push_back(
        {{"probability", q.probability}, {"value", q.value}, {"lo", q.interval.lo}, {"hi", q.interval.hi}});
  return json_text(j);
}

} // namespace carlo
