#include <render/film/sampling_plan.h>

#include <mc/core/error.h>
#include <mc/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace render {

namespace {

/// Of one sample.
struct Need {
  double variance = 0, rays = 0;
};

std::vector<Need> needs_of(const Film& film) {
  const auto pixels = static_cast<std::size_t>(film.width()) * static_cast<std::size_t>(film.height());
  std::vector<PixelEstimate> estimates;
  estimates.reserve(pixels);
  double mean = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      estimates.push_back(film.estimate(x, y));
      mean += estimates.back().mean.sum() / (3.0 * double(pixels));
    }
  std::vector<Need> needs(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto& [value, all, of_light, samples, sets] = estimates[i];
    if (samples == 0) continue;
    const Eigen::Array3d variance = all - of_light; // what more samples of the pixel make smaller
    if ((variance > 0).any()) needs[i].variance = (variance / value.max(mean / 2).square()).mean() * double(samples);
    const int width = film.width(), place = static_cast<int>(i);
    needs[i].rays = double(film.rays(place % width, place / width)) / double(samples);
  }
  return needs;
}

constexpr int radius = 8;

// Weights of the neighbours by their distance along both axes.
std::array<std::array<double, radius + 1>, radius + 1> neighbour_weights() {
  std::array<std::array<double, radius + 1>, radius + 1> weights = {};
  for (std::size_t j = 0; j <= radius; ++j)
    for (std::size_t i = 0; i <= radius; ++i)
      if (i + j > 0 && i * i + j * j <= radius * radius) weights[j][i] = 1 / double(i * i + j * j);
  return weights;
}

// Rates as the wishes, of mean 1, none below `least`: c times the wishes, where the mean of max(least, c wish) is 1. It
// rises with c.
std::vector<double> with_mean_one(const std::vector<double>& wishes, double least) {
  const auto n = double(wishes.size());
  const auto mean = [&](double c) {
    double total = 0;
    for (const double w : wishes) total += std::max(least, c * w);
    return total / n;
  };
  double lo = 0, hi = n / std::accumulate(wishes.begin(), wishes.end(), 0.0);
  for (int i = 0; i < 50; ++i) {
    const double middle = (lo + hi) / 2;
    (mean(middle) < 1 ? lo : hi) = middle;
  }
  std::vector<double> rates;
  rates.reserve(wishes.size());
  for (const double w : wishes) rates.push_back(std::max(least, hi * w));
  return rates;
}

std::vector<double> wishes_of(const Film& pilot, const std::vector<Need>& needs, ErrorOf of, int threads) {
  const auto weights = neighbour_weights();
  const int width = pilot.width(), height = pilot.height();
  const auto at = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  std::vector<double> wishes(needs.size());
  mc::parallel_for(static_cast<std::size_t>(height), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      Need sum;
      double weight = 0;
      for (int j = std::max(y - radius, 0); j < std::min(y + radius + 1, height); ++j)
        for (int i = std::max(x - radius, 0); i < std::min(x + radius + 1, width); ++i) {
          const double w =
              weights[static_cast<std::size_t>(std::abs(j - y))][static_cast<std::size_t>(std::abs(i - x))];
          weight += w;
          sum.variance += w * needs[at(i, j)].variance;
          sum.rays += w * needs[at(i, j)].rays;
        }
      if (sum.variance > 0)
        wishes[at(x, y)] = of == ErrorOf::picture ? std::sqrt(sum.variance / sum.rays) : sum.variance / weight;
    }
  });
  return wishes;
}

/// Rates, and what they cost as far as the pilot can tell: rays times variance.
struct Candidate {
  std::vector<double> rates;
  double variance = 0, rays = 0;

  Candidate(std::vector<double> r, const std::vector<Need>& needs) : rates(std::move(r)) {
    for (std::size_t i = 0; i < rates.size(); ++i) {
      variance += needs[i].variance / rates[i];
      rays += needs[i].rays * rates[i];
    }
  }
  double cost_without(std::size_t i, const Need& need) const {
    return (variance - need.variance / rates[i]) * (rays - need.rays * rates[i]);
  }
};

// Every pixel takes the candidate that costs all others least.
std::vector<double> best_of(const std::vector<Candidate>& candidates, const std::vector<Need>& needs) {
  std::vector<double> rates(needs.size());
  for (std::size_t i = 0; i < needs.size(); ++i) {
    const auto best =
        std::min_element(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
          return a.cost_without(i, needs[i]) < b.cost_without(i, needs[i]);
        });
    rates[i] = best->rates[i];
  }
  return rates;
}

} // namespace

SamplingPlan adaptive_plan(const Film& pilot, double least, ErrorOf of, int threads) {
  mc::require(least > 0 && least <= 1, "adaptive_plan: the least rate {} must lie in (0, 1]", least);
  const std::vector<Need> needs = needs_of(pilot);
  std::vector<double> wishes = wishes_of(pilot, needs, of, threads);
  if (std::all_of(wishes.begin(), wishes.end(), [](double w) { return w == 0; })) return {};
  std::vector<double> rates = with_mean_one(wishes, least);
  if (of == ErrorOf::picture) {
    std::vector<Candidate> candidates;
    for (const double power : {0.0, 0.5, 0.75, 1.0, 1.25}) {
      std::vector<double> some = wishes;
      for (double& w : some) w = std::pow(w, power);
      candidates.emplace_back(with_mean_one(some, least), needs);
    }
    rates = with_mean_one(best_of(candidates, needs), least);
  }
  return {std::vector<float>(rates.begin(), rates.end())};
}

} // namespace render
