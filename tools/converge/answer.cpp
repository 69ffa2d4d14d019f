#include <converge/answer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

// "0.1", "0.1 and 0.05", "0.2, 0.1 and 0.05".
std::string list_of(const std::vector<double>& values, const std::string& unit) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text += i + 1 < values.size() ? ", " : " and ";
    text += fmt::format("{:.3g}{}", values[i], unit);
  }
  return text;
}

std::string two_digits(double x) { return x < 10 ? fmt::format("{:.2g}", x) : fmt::format("{:.0f}", x); }

/// The wanted values with one winner, and the gains over plain Monte Carlo.
struct Group {
  const ConvergenceCurve* winner;
  std::vector<double> wanted;
  double least_gain = HUGE_VAL, largest_gain = 0;

  void add_gain(const std::optional<IntervalEstimate>& gain) {
    if (!gain || gain->is_upper_bound() || gain->is_lower_bound() || !(gain->lo < gain->hi)) return;
    least_gain = std::min(least_gain, gain->value);
    largest_gain = std::max(largest_gain, gain->value);
  }
  // "11" or "11 to 63".
  std::string gain_text() const {
    const std::string least = two_digits(least_gain), largest = two_digits(largest_gain);
    return least == largest ? least : least + " to " + largest;
  }
};

template <class For> std::vector<Group> grouped(const std::vector<For>& all) {
  std::vector<Group> groups;
  for (const For& f : all) {
    if (f.candidates.empty()) continue;
    const ConvergenceCurve* winner = f.candidates.front().curve;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.winner == winner; });
    if (group == groups.end()) group = groups.insert(groups.end(), {winner, {}});
    group->wanted.push_back(f.goal);
    group->add_gain(f.gain);
  }
  return groups;
}

template <class For> std::vector<double> without_offers(const std::vector<For>& all) {
  std::vector<double> wanted;
  for (const For& f : all)
    if (f.candidates.empty()) wanted.push_back(f.goal);
  return wanted;
}

} // namespace

std::string answer_text(const Measurement& m, const TradeResults& trade_results) {
  std::string text;
  const std::string unit = fmt::format("{}{}", m.cost.unit, m.cost.qualifier);
  for (const Group& g : grouped(trade_results.by_error)) {
    text +=
        fmt::format("The cheapest method for an RMS error of {} is {}", list_of(g.wanted, ""), curve_label(*g.winner));
    text += g.largest_gain > 0 ? fmt::format("; plain Monte Carlo costs {} times as much. ", g.gain_text()) : ". ";
  }
  if (const std::vector<double> missed = without_offers(trade_results.by_error); !missed.empty())
    text += fmt::format("No method reached an RMS error of {}. ", list_of(missed, ""));
  for (const Group& g : grouped(trade_results.by_time)) {
    text += fmt::format("The most accurate method for {} is {}", list_of(g.wanted, unit), curve_label(*g.winner));
    text += g.largest_gain > 0 ? fmt::format("; the error of plain Monte Carlo is {} times as large. ", g.gain_text())
                               : ". ";
  }
  if (const std::vector<double> missed = without_offers(trade_results.by_time); !missed.empty())
    text += fmt::format("{} is too little for any method. ", list_of(missed, unit));
  if (!text.empty()) text.pop_back();
  return text;
}

} // namespace carlo
