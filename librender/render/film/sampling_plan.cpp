#include <render/film/sampling_plan.h>

#include <mc/core/error.h>
#include <mc/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace render {

namespace {

/// Of one sample of all pixels of a tile.
struct Need {
  double rays = 0;
  std::array<double, 9> variances = {}; ///< as the 3x3 tiles about see it; who is farther off sees what the middle has

  double variance() const { return variances[4]; }
  /// As the tile at (dx, dy) from this one sees it.
  double variance(int dx, int dy) const {
    return std::max(std::abs(dx), std::abs(dy)) > 1 ? variance() : variances[static_cast<std::size_t>(3 * dy + dx + 4)];
  }
};

/// Of the pixels of a tile.
struct Sum {
  Eigen::Array3d radiance = Eigen::Array3d::Zero();
  double pixels = 0;
};

/// What the tiles of a film need, row by row.
class Tiles {
 public:
  Tiles(const Film& film, ErrorOf of, const Tiling& tiling)
      : width((tiling.x + film.width() - 1) / tiling.side + 1),
        height((tiling.y + film.height() - 1) / tiling.side + 1),
        needs(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)), sums_(needs.size()) {
    std::vector<PixelEstimate> pixels;
    pixels.reserve(static_cast<std::size_t>(film.width()) * static_cast<std::size_t>(film.height()));
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) {
        const std::size_t tile = at((tiling.x + x) / tiling.side, (tiling.y + y) / tiling.side);
        of_pixels.push_back(tile);
        pixels.push_back(film.estimate(x, y));
        sums_[tile].radiance += pixels.back().mean;
        ++sums_[tile].pixels;
        needs[tile].rays += double(film.rays(x, y)) / double(std::max<std::uint64_t>(pixels.back().samples, 1));
      }
    double mean = 0;
    for (const Sum& sum : sums_) mean += sum.radiance.sum() / (3.0 * double(pixels.size()));
    for (std::size_t i = 0; i < pixels.size(); ++i) add_variances(of_pixels[i], pixels[i], mc::sqr(mean / 2), of);
  }

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }

  int width, height;
  std::vector<Need> needs;
  std::vector<std::size_t> of_pixels; ///< the tile of each pixel
  double light = 0;                   ///< variance of one sample of all pixels that is due to paths from the lights

 private:
  void add_variances(std::size_t tile, const PixelEstimate& pixel, double dark, ErrorOf of) {
    light += (pixel.of_light / (pixel.mean.square() + dark)).mean() * double(pixel.samples);
    const Eigen::Array3d variance = pixel.variance - pixel.of_light; // what more samples of the pixel make smaller
    if (!(variance > 0).any()) return;
    const int x = static_cast<int>(tile) % width, y = static_cast<int>(tile) / width;
    const auto tiles_about = [&](auto&& visit) {
      for (int j = std::max(y - 1, 0); j < std::min(y + 2, height); ++j)
        for (int i = std::max(x - 1, 0); i < std::min(x + 2, width); ++i)
          visit(sums_[at(i, j)], static_cast<std::size_t>(3 * (j - y) + i - x + 4));
    };
    Sum all;
    tiles_about([&](const Sum& sum, std::size_t) {
      all.radiance += sum.radiance;
      all.pixels += sum.pixels;
    });
    tiles_about([&](const Sum& sum, std::size_t seen_from) {
      const double others = seen_from == 4 ? all.pixels : all.pixels - sum.pixels;
      const Eigen::Array3d about = (seen_from == 4 ? all.radiance : (all.radiance - sum.radiance).eval()) / others,
                           least = of == ErrorOf::picture ? pixel.mean.min(about).eval() : pixel.mean,
                           square = pixel.mean * least + dark;
      needs[tile].variances[seen_from] += (variance / square).mean() * double(pixel.samples);
    });
  }

  std::vector<Sum> sums_;
};

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

std::vector<double> wishes_of(const Tiles& tiles, ErrorOf of, int threads) {
  const auto weights = neighbour_weights();
  std::vector<double> wishes(tiles.needs.size());
  mc::parallel_for(static_cast<std::size_t>(tiles.height), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < tiles.width; ++x) {
      double variance = 0, rays = 0, weight = 0;
      for (int j = std::max(y - radius, 0); j < std::min(y + radius + 1, tiles.height); ++j)
        for (int i = std::max(x - radius, 0); i < std::min(x + radius + 1, tiles.width); ++i) {
          const double w =
              weights[static_cast<std::size_t>(std::abs(j - y))][static_cast<std::size_t>(std::abs(i - x))];
          weight += w;
          const Need& need = tiles.needs[tiles.at(i, j)];
          variance += w * need.variance(x - i, y - j);
          rays += w * need.rays;
        }
      if (variance > 0)
        wishes[tiles.at(x, y)] = of == ErrorOf::picture ? std::sqrt(variance / rays) : variance / weight;
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
      variance += needs[i].variance() / rates[i];
      rays += needs[i].rays * rates[i];
    }
  }
  double cost_without(std::size_t i, const Need& need) const {
    return (variance - need.variance() / rates[i]) * (rays - need.rays * rates[i]);
  }
};

// Every tile takes the candidate that costs all others least.
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

// What is left of variance times rays is least, by Lagrange, where both are in these proportions.
double light_rate(const Candidate& samples, double variance, double rays) {
  if (rays == 0) return 1;
  // No fewer, so that what the pilot missed is met later; not so many that the samples tell nothing of the time.
  constexpr double least = 1, most = 4;
  return std::clamp(std::sqrt(variance * samples.rays / (samples.variance * rays)), least, most);
}

} // namespace

SamplingPlan adaptive_plan(const Film& pilot, double least, ErrorOf of, int threads, const Tiling& tiling) {
  mc::require(least > 0 && least <= 1, "adaptive_plan: the least rate {} must lie in (0, 1]", least);
  const Tiles tiles(pilot, of, tiling);
  std::vector<double> wishes = wishes_of(tiles, of, threads);
  if (std::all_of(wishes.begin(), wishes.end(), [](double w) { return w == 0; })) return {};
  std::vector<double> rates = with_mean_one(wishes, least);
  if (of == ErrorOf::picture) {
    std::vector<Candidate> candidates;
    for (const double power : {0.0, 0.5, 0.75, 1.0, 1.25}) {
      std::vector<double> some = wishes;
      for (double& w : some) w = std::pow(w, power);
      candidates.emplace_back(with_mean_one(some, least), tiles.needs);
    }
    rates = with_mean_one(best_of(candidates, tiles.needs), least);
  }
  SamplingPlan plan;
  plan.light = light_rate(Candidate(rates, tiles.needs), tiles.light, pilot.light_rays());
  plan.rates.reserve(tiles.of_pixels.size());
  for (const std::size_t tile : tiles.of_pixels) plan.rates.push_back(static_cast<float>(rates[tile]));
  return plan;
}

} // namespace render
