#include <render/film/sampling_plan.h>

#include <mc/core/error.h>
#include <mc/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace render {

namespace {

/// Cost and variance of one sample of all pixels of a tile.
struct TileCost {
  double rays = 0;
  /// Relative variances for planning each of the 3x3 tiles about this tile; the middle is for tiles farther off.
  std::array<double, 9> variances = {};

  double variance() const { return variances[4]; }
  /// Relative variance for planning the tile at (dx, dy) from this tile.
  double variance(int dx, int dy) const {
    if (std::max(std::abs(dx), std::abs(dy)) > 1) return variance();
    const int neighbour = 3 * dy + dx + 4;
    return variances[static_cast<std::size_t>(neighbour)];
  }
};

/// Sums over the pixels of a tile.
struct Sum {
  Eigen::Array3d radiance = Eigen::Array3d::Zero();
  double pixels = 0;
};

/// Cost and variance of all tiles of a film, row by row.
class Tiles {
 public:
  Tiles(const Film& film, ErrorScope scope, const Tiling& tiling)
      : width((tiling.x + film.width() - 1) / tiling.side + 1),
        height((tiling.y + film.height() - 1) / tiling.side + 1),
        tile_costs(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)), sums_(tile_costs.size()) {
    std::vector<PixelEstimate> pixels;
    pixels.reserve(static_cast<std::size_t>(film.width()) * static_cast<std::size_t>(film.height()));
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) {
        const std::size_t tile = at((tiling.x + x) / tiling.side, (tiling.y + y) / tiling.side);
        tile_of_pixel.push_back(tile);
        pixels.push_back(film.estimate(x, y));
        sums_[tile].radiance += pixels.back().mean;
        ++sums_[tile].pixels;
        tile_costs[tile].rays += double(film.rays(x, y)) / double(std::max<std::uint64_t>(pixels.back().samples, 1));
      }
    double mean = 0;
    for (const Sum& sum : sums_) mean += sum.radiance.sum() / (3.0 * double(pixels.size()));
    for (std::size_t i = 0; i < pixels.size(); ++i)
      add_variances(tile_of_pixel[i], pixels[i], mc::sqr(mean / 2), scope);
  }

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }

  int width, height;
  std::vector<TileCost> tile_costs;
  std::vector<std::size_t> tile_of_pixel; ///< The tile of each pixel.
  double light = 0;                       ///< Relative variance of one sample of all pixels that is due to light paths.

 private:
  void add_variances(std::size_t tile, const PixelEstimate& pixel, double dark, ErrorScope scope) {
    light += (pixel.light_variance / (pixel.mean.square() + dark)).mean() * double(pixel.samples);
    const Eigen::Array3d variance =
        pixel.variance - pixel.light_variance; // without light paths, which more samples of the pixel do not improve
    if (!(variance > 0).any()) return;
    const int x = static_cast<int>(tile) % width, y = static_cast<int>(tile) / width;
    const auto tiles_about = [&](auto&& visit) {
      for (int j = std::max(y - 1, 0); j < std::min(y + 2, height); ++j)
        for (int i = std::max(x - 1, 0); i < std::min(x + 2, width); ++i) {
          const int neighbour = 3 * (j - y) + i - x + 4;
          visit(sums_[at(i, j)], static_cast<std::size_t>(neighbour));
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
      tile_costs[tile].variances[observer] += (variance / square).mean() * double(pixel.samples);
    });
  }

  std::vector<Sum> sums_;
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

// Rates max(least, c w) for unnormalized rates w, with c such that the mean is 1. The mean increases with c.
std::vector<double> normalized(const std::vector<double>& unnormalized_rates, double least) {
  const auto n = double(unnormalized_rates.size());
  const auto mean = [&](double c) {
    double total = 0;
    for (const double w : unnormalized_rates) total += std::max(least, c * w);
    return total / n;
  };
  double lo = 0, hi = n / std::accumulate(unnormalized_rates.begin(), unnormalized_rates.end(), 0.0);
  for (int i = 0; i < 50; ++i) {
    const double middle = (lo + hi) / 2;
    (mean(middle) < 1 ? lo : hi) = middle;
  }
  std::vector<double> rates;
  rates.reserve(unnormalized_rates.size());
  for (const double w : unnormalized_rates) rates.push_back(std::max(least, hi * w));
  return rates;
}

std::vector<double> unnormalized_rates_of(const Tiles& tiles, ErrorScope scope, int threads) {
  const auto weights = neighbour_weights();
  std::vector<double> unnormalized_rates(tiles.tile_costs.size());
  mc::parallel_for(static_cast<std::size_t>(tiles.height), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < tiles.width; ++x) {
      double variance = 0, rays = 0, weight = 0;
      for (int j = std::max(y - radius, 0); j < std::min(y + radius + 1, tiles.height); ++j)
        for (int i = std::max(x - radius, 0); i < std::min(x + radius + 1, tiles.width); ++i) {
          const double w =
              weights[static_cast<std::size_t>(std::abs(j - y))][static_cast<std::size_t>(std::abs(i - x))];
          weight += w;
          const TileCost& tile_cost = tiles.tile_costs[tiles.at(i, j)];
          variance += w * tile_cost.variance(x - i, y - j);
          rays += w * tile_cost.rays;
        }
      if (variance > 0)
        unnormalized_rates[tiles.at(x, y)] =
            scope == ErrorScope::image ? std::sqrt(variance / rays) : variance / weight;
    }
  });
  return unnormalized_rates;
}

/// Rates, with the cost that the pilot predicts: variance times rays.
struct RateCandidate {
  std::vector<double> rates;
  double variance = 0, rays = 0;

  RateCandidate(std::vector<double> r, const std::vector<TileCost>& tile_costs) : rates(std::move(r)) {
    for (std::size_t i = 0; i < rates.size(); ++i) {
      variance += tile_costs[i].variance() / rates[i];
      rays += tile_costs[i].rays * rates[i];
    }
  }
  /// The cost of all other tiles.
  double cost_without(std::size_t i, const TileCost& tile_cost) const {
    return (variance - tile_cost.variance() / rates[i]) * (rays - tile_cost.rays * rates[i]);
  }
};

// For each tile the rate of the candidate with the least cost of all other tiles.
std::vector<double> best_of(const std::vector<RateCandidate>& candidates, const std::vector<TileCost>& tile_costs) {
  std::vector<double> rates(tile_costs.size());
  for (std::size_t i = 0; i < tile_costs.size(); ++i) {
    const auto best =
        std::min_element(candidates.begin(), candidates.end(), [&](const RateCandidate& a, const RateCandidate& b) {
          return a.cost_without(i, tile_costs[i]) < b.cost_without(i, tile_costs[i]);
        });
    rates[i] = best->rates[i];
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
  std::vector<double> unnormalized_rates = unnormalized_rates_of(tiles, scope, threads);
  if (std::all_of(unnormalized_rates.begin(), unnormalized_rates.end(), [](double w) { return w == 0; })) return {};
  std::vector<double> rates = normalized(unnormalized_rates, least);
  if (scope == ErrorScope::image) {
    std::vector<RateCandidate> candidates;
    for (const double power : {0.0, 0.5, 0.75, 1.0, 1.25}) {
      std::vector<double> some = unnormalized_rates;
      for (double& w : some) w = std::pow(w, power);
      candidates.emplace_back(normalized(some, least), tiles.tile_costs);
    }
    rates = normalized(best_of(candidates, tiles.tile_costs), least);
  }
  SamplingPlan plan;
  plan.light_path_scale = light_rate(RateCandidate(rates, tiles.tile_costs), tiles.light, pilot.light_rays());
  plan.rates.reserve(tiles.tile_of_pixel.size());
  for (const std::size_t tile : tiles.tile_of_pixel) plan.rates.push_back(static_cast<float>(rates[tile]));
  return plan;
}

} // namespace render
