#include <render/film/sampling_plan.h>

#include <mc/core/error.h>
#include <mc/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace render {

namespace {

/// Cost and variance of one sample of all pixels of a tile. Single precision saves memory: a tile may be a pixel.
struct TileCost {
  float rays = 0;
  /// Relative variances for planning each of the 3x3 tiles about this tile; the middle is for tiles farther off.
  std::array<float, 9> variances = {};

  double variance() const { return double(variances[4]); }
  /// Relative variance for planning the tile at (dx, dy) from this tile.
  double variance(int dx, int dy) const {
    if (std::max(std::abs(dx), std::abs(dy)) > 1) return variance();
    const int neighbour = 3 * dy + dx + 4;
    return double(variances[static_cast<std::size_t>(neighbour)]);
  }
};

/// Cost and variance of all tiles of a film, row by row.
class Tiles {
 public:
  Tiles(const Film& film, ErrorScope scope, const Tiling& tiling)
      : width((tiling.x + film.width() - 1) / tiling.side + 1),
        height((tiling.y + film.height() - 1) / tiling.side + 1),
        tile_costs(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)), tiling_(tiling) {
    std::vector<Sum> sums(tile_costs.size());
    double mean = 0;
    for_each_pixel(film, [&](int x, int y, const PixelEstimate& pixel) {
      const std::size_t tile = tile_of(x, y);
      sums[tile].radiance += pixel.mean;
      ++sums[tile].pixels;
      mean += pixel.mean.mean() / (double(film.width()) * film.height());
      tile_costs[tile].rays +=
          static_cast<float>(film.rays(x, y)) / static_cast<float>(std::max<std::uint64_t>(pixel.samples, 1));
    });
    for_each_pixel(film, [&](int x, int y, const PixelEstimate& pixel) {
      add_variances(sums, tile_of(x, y), pixel, mc::sqr(mean / 2), scope);
    });
  }

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  /// The tile of a pixel.
  std::size_t tile_of(int x, int y) const { return at((tiling_.x + x) / tiling_.side, (tiling_.y + y) / tiling_.side); }

  int width, height;
  std::vector<TileCost> tile_costs;
  double light = 0; ///< Relative variance of one sample of all pixels that is due to light paths.

 private:
  /// Sums over the pixels of a tile.
  struct Sum {
    Eigen::Array3d radiance = Eigen::Array3d::Zero();
    double pixels = 0;
  };

  // Estimates each pixel anew: all estimates together would need as much memory as the film.
  template <class Visit> static void for_each_pixel(const Film& film, const Visit& visit) {
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) visit(x, y, film.estimate(x, y));
  }

  void add_variances(const std::vector<Sum>& sums, std::size_t tile, const PixelEstimate& pixel, double dark,
                     ErrorScope scope) {
    light += (pixel.light_variance / (pixel.mean.square() + dark)).mean() * double(pixel.samples);
    const Eigen::Array3d variance =
        pixel.variance - pixel.light_variance; // without light paths, which more samples of the pixel do not improve
    if (!(variance > 0).any()) return;
    const int x = static_cast<int>(tile) % width, y = static_cast<int>(tile) / width;
    const auto tiles_about = [&](auto&& visit) {
      for (int j = std::max(y - 1, 0); j < std::min(y + 2, height); ++j)
        for (int i = std::max(x - 1, 0); i < std::min(x + 2, width); ++i) {
          const int neighbour = 3 * (j - y) + i - x + 4;
          visit(sums[at(i, j)], static_cast<std::size_t>(neighbour));
        }
    };
    Sum all;
    tiles_about([&](const Sum& sum, std::size_t) {
      all.radiance += sum.radiance;
      all.pixels += sum.pixels;
    });
    tiles_about([&](const Sum& sum, std::size_t observer) {
      const double others = observer == 4 ? all.pixels : all.pixels - sum.pixels;
      const Eigen::Array3d about = (observer == 4 ? all.radiance : (all.radiance - sum.radiance).eval()) / others,
                           least = scope == ErrorScope::image ? pixel.mean.min(about).eval() : pixel.mean,
                           square = pixel.mean * least + dark;
      tile_costs[tile].variances[observer] += static_cast<float>((variance / square).mean() * double(pixel.samples));
    });
  }

  static_assert(sizeof(TileCost) + sizeof(Sum) <= planning_bytes);

  Tiling tiling_;
};

constexpr int radius = 8;

// Weight of a neighbour by its distances along both axes: the inverse square of the distance, up to `radius`.
std::array<std::array<double, radius + 1>, radius + 1> neighbour_weights() {
  std::array<std::array<double, radius + 1>, radius + 1> weights = {};
  for (std::size_t j = 0; j <= radius; ++j)
    for (std::size_t i = 0; i <= radius; ++i)
      if (i + j > 0 && i * i + j * j <= radius * radius) weights[j][i] = 1 / double(i * i + j * j);
  return weights;
}

// The factor c with which the rates max(least, c w) of weights w have the mean 1. The mean increases with c.
double normalization(const std::vector<double>& weights, double least) {
  const auto n = double(weights.size());
  const auto mean = [&](double c) {
    double total = 0;
    for (const double w : weights) total += std::max(least, c * w);
    return total / n;
  };
  double lo = 0, hi = n / std::accumulate(weights.begin(), weights.end(), 0.0);
  for (int i = 0; i < 50; ++i) {
    const double middle = (lo + hi) / 2;
    (mean(middle) < 1 ? lo : hi) = middle;
  }
  return hi;
}

// Weights of the tiles: the rates are proportional to them, or to a power of them, where the lower bound permits it.
std::vector<double> weights_of(const Tiles& tiles, ErrorScope scope, int threads) {
  const auto nearness = neighbour_weights();
  std::vector<double> weights(tiles.tile_costs.size());
  mc::parallel_for(static_cast<std::size_t>(tiles.height), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < tiles.width; ++x) {
      double variance = 0, rays = 0, weight = 0;
      for (int j = std::max(y - radius, 0); j < std::min(y + radius + 1, tiles.height); ++j)
        for (int i = std::max(x - radius, 0); i < std::min(x + radius + 1, tiles.width); ++i) {
          const double w =
              nearness[static_cast<std::size_t>(std::abs(j - y))][static_cast<std::size_t>(std::abs(i - x))];
          weight += w;
          const TileCost& tile_cost = tiles.tile_costs[tiles.at(i, j)];
          variance += w * tile_cost.variance(x - i, y - j);
          rays += w * double(tile_cost.rays);
        }
      if (variance > 0)
        weights[tiles.at(x, y)] = scope == ErrorScope::image ? std::sqrt(variance / rays) : variance / weight;
    }
  });
  return weights;
}

/// Rates of tiles, with mean 1, that grow with a power of their weights; and the cost that the pilot predicts for them:
/// variance times rays.
struct RateCandidate {
  double power, least, factor = 1;
  double variance = 0, rays = 0;

  RateCandidate(double p, std::vector<double> weights, double smallest, const std::vector<TileCost>& tile_costs)
      : power(p), least(smallest) {
    for (double& w : weights) w = std::pow(w, power);
    factor = normalization(weights, least);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double rate = std::max(least, factor * weights[i]);
      variance += tile_costs[i].variance() / rate;
      rays += double(tile_costs[i].rays) * rate;
    }
  }
  /// The rate of a tile.
  double rate(double weight) const { return std::max(least, factor * std::pow(weight, power)); }
  /// The cost of all tiles but this one.
  double cost_without(double rate, const TileCost& tile_cost) const {
    return (variance - tile_cost.variance() / rate) * (rays - double(tile_cost.rays) * rate);
  }
};

// For each tile the rate of the candidate with the least cost of all other tiles.
std::vector<double> best_of(const std::vector<RateCandidate>& candidates, const std::vector<double>& weights,
                            const std::vector<TileCost>& tile_costs) {
  std::vector<double> rates(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    double least_cost = mc::infinity<double>;
    for (const RateCandidate& candidate : candidates) {
      const double rate = candidate.rate(weights[i]), cost = candidate.cost_without(rate, tile_costs[i]);
      if (!(cost < least_cost) && rates[i] > 0) continue;
      least_cost = cost;
      rates[i] = rate;
    }
  }
  return rates;
}

// Ratio of light paths to samples that minimizes variance times rays (Lagrange).
double light_rate(const RateCandidate& samples, double variance, double rays) {
  if (rays == 0) return 1;
  // At least 1, so that sampling continues where the pilot missed light paths. At most 4, so that samples still
  // determine the time.
  constexpr double least = 1, most = 4;
  return std::clamp(std::sqrt(variance * samples.rays / (samples.variance * rays)), least, most);
}

} // namespace

SamplingPlan SamplingPlan::with_border(int width, int height, int border, double from) const {
  if (rates.empty()) return *this;
  SamplingPlan plan{.rates = {}, .even = from, .light_path_scale = light_path_scale};
  plan.rates.reserve(static_cast<std::size_t>(width + 2 * border) * static_cast<std::size_t>(height + 2 * border));
  for (int y = -border; y < height + border; ++y)
    for (int x = -border; x < width + border; ++x)
      plan.rates.push_back(
          rates[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(std::clamp(x, 0, width - 1))]);
  const double mean = std::accumulate(plan.rates.begin(), plan.rates.end(), 0.0) / double(plan.rates.size());
  for (float& rate : plan.rates) rate = static_cast<float>(double(rate) / mean);
  return plan;
}

SamplingPlan adaptive_plan(const Film& pilot, double least, ErrorScope scope, int threads, const Tiling& tiling) {
  mc::require(least > 0 && least <= 1, "adaptive_plan: the least rate {} must lie in (0, 1]", least);
  const Tiles tiles(pilot, scope, tiling);
  std::vector<double> weights = weights_of(tiles, scope, threads);
  if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; })) return {};
  if (scope == ErrorScope::image) {
    std::vector<RateCandidate> candidates;
    for (const double power : {0.0, 0.5, 0.75, 1.0, 1.25})
      candidates.emplace_back(power, weights, least, tiles.tile_costs);
    weights = best_of(candidates, weights, tiles.tile_costs);
  }
  const RateCandidate planned(1, weights, least, tiles.tile_costs);
  SamplingPlan plan;
  plan.light_path_scale = light_rate(planned, tiles.light, pilot.light_rays());
  plan.rates.reserve(static_cast<std::size_t>(pilot.width()) * static_cast<std::size_t>(pilot.height()));
  for (int y = 0; y < pilot.height(); ++y)
    for (int x = 0; x < pilot.width(); ++x)
      plan.rates.push_back(static_cast<float>(planned.rate(weights[tiles.tile_of(x, y)])));
  return plan;
}

} // namespace render
