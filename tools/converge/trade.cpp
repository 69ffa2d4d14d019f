#include <converge/trade.h>

#include <mc/core/types.h>
#include <mc/random/hash.h>
#include <mc/stats/chi_square.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace carlo {

namespace {

using Edge = double mc::RmsError::*;

constexpr double farthest = 2; ///< an error that is known badly may have reached one by as much smaller, and no less

// The first N from which an edge of the band stays below the error; between two N a straight line in the logarithms.
std::optional<double> crossing(const std::vector<mc::RmsError>& errors, Edge edge, double error) {
  std::optional<std::size_t> first;
  for (std::size_t i = errors.size(); i-- > 0 && errors[i].*edge <= error;) first = i;
  if (!first) return {};
  const mc::RmsError& below = errors[*first];
  if (*first == 0) return below.n;
  const mc::RmsError& above = errors[*first - 1];
  if (!(below.*edge > 0)) return edge == &mc::RmsError::lo ? above.n : below.n;
  const double t = std::log(above.*edge / error) / std::log(above.*edge / (below.*edge));
  return above.n * std::pow(below.n / above.n, t);
}

// The error at n, by straight lines in the logarithms; at the ends those of the first and last two points.
double error_at(const std::vector<mc::RmsError>& errors, Edge edge, double n) {
  if (errors.size() < 2) return errors.front().*edge;
  std::size_t i = 1;
  while (i + 1 < errors.size() && errors[i].n < n) ++i;
  const mc::RmsError &a = errors[i - 1], &b = errors[i];
  if (!(a.*edge > 0 && b.*edge > 0)) return edge == &mc::RmsError::lo ? 0 : b.*edge; // a bound beside it
  return a.*edge * std::pow(b.*edge / (a.*edge), std::log(n / a.n) / std::log(b.n / a.n));
}

Offer offer_at(const Curve& c, const Ranged& n, const SecondsOfOne& seconds_of_one) {
  const Ranged one = seconds_of_one(c, n.value);
  Offer offer;
  offer.curve = &c;
  offer.n = n.value;
  offer.seconds = {n.value * one.value, n.lo * one.lo, n.hi * one.hi};
  offer.error = {error_at(c.errors, &mc::RmsError::rms, n.value), error_at(c.errors, &mc::RmsError::lo, n.value),
                 error_at(c.errors, &mc::RmsError::hi, n.value)};
  return offer;
}

Offer last_of(const Curve& c) {
  const mc::RmsError& e = c.errors.back();
  return {&c, e.n, {e.seconds, e.seconds, e.seconds}, {e.rms, e.lo, e.hi}};
}

const Curve* plain(const Measurement& m) {
  for (const Curve& c : m.curves)
    if (c.way->name == m.plain && !c.way->one_by_one && !c.exact) return &c;
  return nullptr;
}

// Nothing where neither end is known.
std::optional<Ranged> ratio(const Ranged& a, const Ranged& b) {
  const Ranged r{a.value / b.value, a.lo / b.hi, a.hi / b.lo};
  return r.is_at_most() && r.is_at_least() ? std::nullopt : std::optional(r);
}

// The first offers, and plain Monte Carlo where it is one.
std::vector<Offer> contenders(const std::vector<Offer>& offers, const std::string& plain_name) {
  constexpr std::size_t most = 6;
  std::vector<Offer> chosen(offers.begin(),
                            offers.begin() + static_cast<std::ptrdiff_t>(std::min(most, offers.size())));
  for (std::size_t i = most; i < offers.size(); ++i)
    if (offers[i].curve->way->name == plain_name) chosen.push_back(offers[i]);
  return chosen;
}

// Seconds of one evaluation near the N of an offer: the first of three replicates fills caches, the last counts.
double seconds_again(const Target& target, const Offer& o, std::uint64_t seed, std::uint64_t round,
                     const std::atomic<bool>* cancel) {
  const std::vector<mc::RmsError>& errors = o.curve->errors;
  const double n = std::clamp(std::exp2(std::round(std::log2(o.n))), errors.front().n, errors.back().n);
  const Replicates r =
      target.run({o.curve->way, static_cast<std::uint64_t>(n), mc::hash(seed, 5), 3 * round, 3, 1, cancel});
  return r.seconds[2] / std::max(r.calls[2], 1.0);
}

/// Whether an offer cannot be told from the first of all.
class TiesWithFirst {
 public:
  TiesWithFirst(const std::vector<Offer>& offers, Ranged Offer::*by) : by_(by) {
    if (offers.empty()) return;
    wider_ = mc::normal_quantile(0.05 / static_cast<double>(offers.size())) / mc::normal_quantile(0.05);
    most_ = widened(offers.front().*by, (offers.front().*by).hi);
  }
  bool operator()(const Offer& o) const { return widened(o.*by_, (o.*by_).lo) <= most_; }

 private:
  double widened(const Ranged& r, double edge) const {
    return r.value > 0 ? r.value * std::pow(edge / r.value, wider_) : edge;
  }

  Ranged Offer::*by_;
  double wider_ = 1, most_ = 0;
};

// At the N that a time is enough for, as far as it was measured.
Offer offer_within(const Curve& c, const Ranged& range, const SecondsOfOne& seconds_of_one) {
  Offer offer = offer_at(c, range, seconds_of_one);
  // Fewer evaluations where they take longer than their median.
  const double most = c.errors.back().n;
  offer.error.lo = std::min(offer.error.lo, error_at(c.errors, &mc::RmsError::lo, std::min(range.hi, most)));
  offer.error.hi = std::max(offer.error.hi, error_at(c.errors, &mc::RmsError::hi, range.lo));
  return offer;
}

// A time is enough for more than was measured: plain Monte Carlo by its law, another at its largest N.
Offer offer_beyond(const Measurement& m, const Curve& c, const Ranged& range, const Ranged& one) {
  const mc::RmsError& last = c.errors.back();
  const auto fallen = [&](double error, double n, double slope) {
    return n > last.n ? error * std::pow(n / last.n, slope) : error;
  };
  if (&c == plain(m)) {
    const double seconds = range.value * one.value;
    return {&c,
            range.value,
            {seconds, seconds, seconds},
            {fallen(last.rms, range.value, -0.5), fallen(last.lo, range.hi, -0.5), fallen(last.hi, range.lo, -0.5)}};
  }
  const double steepest = std::min(c.law ? c.law->lo : -1, -0.5);
  const double rounded = std::min(last.lo, 1e-16 * m.size); // below which nothing falls
  return {&c,
          last.n,
          {last.n * one.value, last.n * one.lo, last.n * one.hi},
          {last.rms, std::max(fallen(last.lo, range.hi, steepest), rounded), last.hi},
          !c.exact && last.rms > 0};
}

// The best first, then what ties with it, then the others.
void rank(std::vector<Offer>& offers, Ranged Offer::*by) {
  std::sort(offers.begin(), offers.end(),
            [by](const Offer& a, const Offer& b) { return (a.*by).value < (b.*by).value; });
  std::stable_partition(offers.begin(), offers.end(), TiesWithFirst(offers, by));
}

} // namespace

Ranged shown(const Offer& o, Ranged Offer::*by) {
  Ranged r = o.*by;
  if (by == &Offer::error ? o.ended : o.error.is_at_most()) r.lo = 0;
  return r;
}

Ranged as_measured(const Curve& c, double n) {
  std::size_t i = 0;
  while (i + 1 < c.errors.size() && c.errors[i].n < n) ++i;
  std::vector<double> seconds = c.replicates[i].seconds;
  std::sort(seconds.begin(), seconds.end());
  const double count = static_cast<double>(seconds.size()), half = 0.98 * std::sqrt(count);
  const auto at = [&](double rank) {
    return seconds[static_cast<std::size_t>(std::clamp(rank, 0.0, count - 1))] / c.errors[i].n;
  };
  return {at(count / 2), at(count / 2 - half), at(count / 2 + half)};
}

SecondsOfOne taken_in_turn(const Target& target, const Measurement& m, const std::vector<Offer>& offers,
                           std::uint64_t seed, const std::atomic<bool>* cancel) {
  constexpr std::uint64_t rounds = 9;
  std::map<const Curve*, std::vector<double>> seconds;
  for (std::uint64_t round = 0; round < rounds; ++round)
    for (const Offer& o : contenders(offers, m.plain)) {
      if (cancel && *cancel) return as_measured;
      seconds[o.curve].push_back(seconds_again(target, o, seed, round, cancel));
    }
  if (cancel && *cancel) return as_measured; // the last one means nothing
  // The second and the eighth of nine hold the median with 96 % confidence.
  std::map<const Curve*, Ranged> medians;
  for (auto& [curve, all] : seconds) {
    std::sort(all.begin(), all.end());
    medians[curve] = {all[4], all[1], all[7]};
  }
  return [medians](const Curve& curve, double n) {
    const auto it = medians.find(&curve);
    return it == medians.end() ? as_measured(curve, n) : it->second;
  };
}

std::string label(const Curve& c) { return c.way->name + (c.way->one_by_one ? " (one by one)" : ""); }

std::optional<Ranged> evaluations_for(const Curve& c, double error) {
  const auto lo = crossing(c.errors, &mc::RmsError::lo, error);
  if (!lo) return {};
  const mc::RmsError& last = c.errors.back();
  if (last.rms > farthest * error) return {};
  // What does not come so low goes on no slower than plain Monte Carlo.
  const auto needed = [&](Edge edge) {
    return crossing(c.errors, edge, error).value_or(last.n * mc::sqr(last.*edge / error));
  };
  const double n = needed(&mc::RmsError::rms);
  return Ranged{n, std::min(*lo, n), std::max(needed(&mc::RmsError::hi), n)};
}

std::size_t as_good(const std::vector<Offer>& offers, Ranged Offer::*by) {
  const auto told = std::find_if_not(offers.begin(), offers.end(), TiesWithFirst(offers, by));
  return static_cast<std::size_t>(told - offers.begin());
}

ForError offers_for_error(const Measurement& m, double error, const SecondsOfOne& seconds_of_one) {
  ForError result{error, {}, {}, {}};
  for (const Curve& c : m.curves) {
    if (const auto n = evaluations_for(c, error)) result.offers.push_back(offer_at(c, *n, seconds_of_one));
    else result.nearest.push_back(last_of(c));
  }
  rank(result.offers, &Offer::seconds);
  std::sort(result.nearest.begin(), result.nearest.end(),
            [](const Offer& a, const Offer& b) { return a.error.value < b.error.value; });
  if (const Curve* random = plain(m); random && !result.offers.empty()) {
    const mc::RmsError& e = random->errors.back();
    const double fewest = random->errors.front().n;
    const auto needed = [&](double rms) { return std::max(e.n * mc::sqr(rms / error), fewest); };
    const Ranged n{needed(e.rms), e.is_bound ? 0 : needed(e.lo), needed(e.hi)};
    const Ranged one = seconds_of_one(*random, std::min(n.value, e.n));
    const Offer& best = result.offers.front();
    result.gain = best.curve == random
                      ? Ranged{1, 1, 1}
                      : ratio({n.value * one.value, n.lo * one.lo, n.hi * one.hi}, shown(best, &Offer::seconds));
  }
  return result;
}

ForSeconds offers_for_seconds(const Measurement& m, double seconds, const SecondsOfOne& seconds_of_one) {
  ForSeconds result{seconds, {}, {}};
  for (const Curve& c : m.curves) {
    const double most = c.errors.back().n;
    Ranged one = seconds_of_one(c, most);
    const double n = std::min(most, seconds / one.value);
    if (n < c.errors.front().n) continue; // it cannot even begin
    one = seconds_of_one(c, n);
    const Ranged range{seconds / one.value, seconds / one.hi, seconds / one.lo};
    result.offers.push_back(range.value > most ? offer_beyond(m, c, range, one)
                                               : offer_within(c, range, seconds_of_one));
  }
  rank(result.offers, &Offer::error);
  for (const Offer& o : result.offers) // an exact way gains nothing that a number says
    if (o.curve == plain(m) && result.offers.front().error.value > 0)
      result.gain = ratio(o.error, shown(result.offers.front(), &Offer::error));
  return result;
}

std::vector<Offer> pareto_front(const Measurement& m) {
  std::vector<Offer> all;
  for (const Curve& c : m.curves)
    for (const mc::RmsError& e : c.errors)
      all.push_back({&c, e.n, {e.seconds, e.seconds, e.seconds}, {e.rms, e.lo, e.hi}});
  std::sort(all.begin(), all.end(), [](const Offer& a, const Offer& b) {
    return std::pair(a.seconds.value, a.error.value) < std::pair(b.seconds.value, b.error.value);
  });
  std::vector<Offer> front;
  for (const Offer& o : all)
    if (front.empty() || o.error.value < front.back().error.value) front.push_back(o);
  return front;
}

} // namespace carlo
