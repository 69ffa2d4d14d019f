#include <converge/pictures.h>

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/random/hash.h>
#include <mc/stats/t_test.h>
#include <render/integrator/directions.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

using ::render::Image;

constexpr double dark = 0.01; ///< as carlo compare's relmse

double relmse(const Image& image, const Image& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const Eigen::Array3d y = truth.pixels[i].cast<double>(), off = image.pixels[i].cast<double>() - y;
    sum += (off.square() / (y.square() + dark)).sum();
  }
  return sum / (3.0 * double(truth.pixels.size()));
}

// The relmse that an image's own noise makes.
double noise(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    sum += (image.variance[i].cast<double>() / (image.pixels[i].cast<double>().square() + dark)).sum();
  return sum / (3.0 * double(image.pixels.size()));
}

/// Pictures of one way at one number of samples.
struct Series {
  double spp = 0;
  std::vector<Image> images;
  Replicates replicates;
};

mc::RmsError error_of(const Series& s, const Image& reference, double reference_noise) {
  mc::Moments squares;
  for (const Image& image : s.images) squares.add(relmse(image, reference) - reference_noise);
  const double half = squares.std_error() * mc::student_quantile(0.05, double(squares.count() - 1));
  std::vector<double> seconds = s.replicates.seconds;
  std::nth_element(seconds.begin(), seconds.begin() + std::ptrdiff_t(seconds.size() / 2), seconds.end());
  const auto root = [](double x) { return std::sqrt(std::max(x, 0.0)); };
  return {s.spp, root(squares.mean()), root(squares.mean() - half), root(squares.mean() + half),
          seconds[seconds.size() / 2]};
}

// The variance of the logarithm of an error of R repetitions is 1 / (2 R): how many make it that of these pictures.
std::uint32_t repetitions(const std::vector<mc::RmsError>& errors) {
  double most = 1e-6;
  for (const mc::RmsError& e : errors) most = std::max(most, mc::sqr(std::log(e.hi / e.rms) / 2));
  return static_cast<std::uint32_t>(std::clamp(1 / (2 * most), 2.0, 1e6));
}

Curve curve_of(const Way& way, const std::vector<Series>& all, const Image& reference, double reference_noise) {
  Curve curve;
  curve.way = &way;
  double logs = 0;
  for (const Series& s : all) {
    curve.errors.push_back(error_of(s, reference, reference_noise));
    curve.replicates.push_back(s.replicates);
    logs += std::log(s.spp) / double(all.size());
  }
  curve.middle = std::exp(logs);
  const bool fits = std::all_of(curve.errors.begin(), curve.errors.end(), [](const auto& e) { return e.rms > 0; });
  if (fits && curve.errors.size() >= 3) curve.law = mc::fit_power_law(curve.errors, repetitions(curve.errors));
  return curve;
}

// The relmse of the expectation and of the noise of one picture, without the picture `out`: the mean picture of R has
// an R-th of the noise.
std::pair<double, double> bias_and_noise(const Series& s, const Image& reference, double reference_noise,
                                         std::size_t out) {
  Image mean(reference.width, reference.height);
  double each = 0, count = 0;
  for (std::size_t r = 0; r < s.images.size(); ++r) {
    if (r == out) continue;
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] += s.images[r].pixels[i];
    each += relmse(s.images[r], reference);
    ++count;
  }
  for (::render::Spectrum& p : mean.pixels) p /= ::render::Float(count);
  const double of_mean = relmse(mean, reference);
  each /= count;
  return {(count * of_mean - each) / (count - 1) - reference_noise, (each - of_mean) * count / (count - 1)};
}

// The interval by the jackknife, wide enough for `ways` of them at once.
Bias bias_of(const Series& s, const Image& reference, double reference_noise, std::size_t ways) {
  const auto [square, noise] = bias_and_noise(s, reference, reference_noise, s.images.size());
  mc::Moments parts;
  for (std::size_t r = 0; r < s.images.size(); ++r) parts.add(bias_and_noise(s, reference, reference_noise, r).first);
  const double dof = double(s.images.size() - 1);
  const double half = mc::student_quantile(0.05 / double(ways), dof) * parts.std_error() * dof;
  const auto root = [](double x) { return std::sqrt(std::max(x, 0.0)); };
  return {{root(square), root(square - half), root(square + half)}, root(noise), s.spp, {}};
}

// Seconds times relmse of the noise do not depend on N: at the error e a way takes seconds noise^2 / (e^2 - bias^2).
void tell_where_they_pay(std::vector<Bias>& biases, const std::vector<Curve>& curves) {
  const auto cost = [&](std::size_t i) { return mc::sqr(biases[i].noise) * curves[i].errors.back().seconds; };
  double best = mc::infinity<double>;
  for (std::size_t i = 0; i < biases.size(); ++i)
    if (!(biases[i].bias.lo > 0)) best = std::min(best, cost(i));
  for (std::size_t i = 0; i < biases.size(); ++i)
    if (biases[i].bias.lo > 0 && cost(i) < best)
      biases[i].pays_above = biases[i].bias.value * (std::isfinite(best) ? std::sqrt(best / (best - cost(i))) : 1.0);
}

bool is_black(const Image& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(),
                     [](const ::render::Spectrum& p) { return ::render::is_black(p); });
}

/// A measurement under way.
class Session {
 public:
  Session(const ::render::SceneFile& file, const std::vector<PictureWay>& ways, const PictureOptions& options)
      : file_(file), ways_(ways), options_(options), series_(ways.size()) {}

  Pictures run() {
    Pictures result;
    if (options_.cost_rays) result.measurement.cost = ray_cost;
    const auto plain = plain_way(file_);
    result.measurement.plain = plain ? plain->name() : "";
    for (int spp = 4; spp <= options_.max_spp; spp *= 2)
      if (!take(spp)) {
        result.measurement.interrupted = true;
        return result;
      }
    result.reference = reference(result);
    if (result.measurement.interrupted) return result;
    const double its_noise = noise(result.reference);
    result.reference_error = std::sqrt(its_noise);
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      Way way;
      way.name = way.title = ways_[i].name();
      result.ways.push_back(way);
      Curve curve = curve_of(result.ways.back(), series_[i], result.reference, its_noise);
      const Bias bias = bias_of(series_[i].back(), result.reference, its_noise, ways_.size());
      const bool is_plain = ways_[i].sampler == ::render::PixelSampler::independent && !ways_[i].adaptive;
      if (is_plain && !(bias.bias.lo > 0)) curve.theory = Rate{0.5, 0, "independent samples"};
      result.measurement.curves.push_back(std::move(curve));
      result.biases.push_back(bias);
      result.pictures.push_back(series_[i].back().images.front());
    }
    tell_where_they_pay(result.biases, result.measurement.curves);
    return result;
  }

 private:
  ::render::RenderResult render(const PictureWay& way, int spp, std::uint64_t seed) const {
    ::render::RenderOptions o;
    o.width = options_.width;
    o.height = options_.height;
    o.spp = spp;
    o.strategy = way.strategy;
    o.sampler = way.sampler;
    o.max_depth = way.max_depth;
    o.shown = file_.defaults.shown;
    o.adaptive = way.adaptive;
    o.seed = seed;
    o.threads = options_.threads;
    o.cancel = options_.cancel;
    return ::render::render(file_.scene, o);
  }

  // A picture of every way in turn, again and again. Returns whether it was done.
  bool take(int spp) {
    const auto is_due = [&](const PictureWay& way) { return !way.adaptive || spp >= 32; };
    for (std::size_t i = 0; i < ways_.size(); ++i)
      if (is_due(ways_[i])) series_[i].push_back({double(spp), {}, {}});
    for (int r = 0; r < options_.replicates; ++r)
      for (std::size_t i = 0; i < ways_.size(); ++i) {
        if (!is_due(ways_[i])) continue;
        const std::uint64_t seed = mc::hash(options_.seed, i, std::uint64_t(spp), std::uint64_t(r));
        ::render::RenderResult result = render(ways_[i], spp, seed);
        if (result.partial) return false;
        Series& s = series_[i].back();
        s.replicates.values.push_back(std::sqrt(noise(result.image)));
        s.replicates.calls.push_back(result.spp);
        s.replicates.seconds.push_back(options_.cost_rays ? 1e-6 * double(result.rays) : result.cpu_seconds);
        s.images.push_back(std::move(result.image));
        if (options_.progress)
          options_.progress(0.7 * spp / options_.max_spp, fmt::format("{} at {} spp", ways_[i].name(), spp));
      }
    return true;
  }

  Image reference(Pictures& result) const {
    double smallest = mc::infinity<double>;
    for (const auto& all : series_)
      for (const double x : all.back().replicates.values)
        if (x > 0) smallest = std::min(smallest, mc::sqr(x));
    const PictureWay best{.max_depth = file_.defaults.max_depth, .adaptive = true};
    const std::uint64_t seed = mc::hash(options_.seed, 77);
    const Image first = render(best, options_.max_spp, seed).image;
    mc::require(!is_black(first), "the picture is black: without light there is no error to measure");
    mc::require(std::isfinite(smallest), "no picture has any noise: there is no error to measure");
    const double spp = options_.max_spp * std::max(1.0, noise(first) / (smallest / 100));
    if (options_.progress) options_.progress(0.75, fmt::format("the reference, {:.0f} spp", spp));
    const ::render::RenderResult r = render(best, static_cast<int>(std::min(spp, 1e8)), seed);
    result.measurement.interrupted = r.partial;
    result.reference_spp = r.spp;
    return r.image;
  }

  const ::render::SceneFile& file_;
  const std::vector<PictureWay>& ways_;
  const PictureOptions& options_;
  std::vector<std::vector<Series>> series_; ///< of every way
};

} // namespace

std::string PictureWay::name() const {
  std::string text = fmt::format("{} {}", strategy.name, ::render::name(sampler));
  if (max_depth > 0) text += fmt::format(" depth {}", max_depth);
  return adaptive ? text + " adaptive" : text;
}

std::optional<PictureWay> plain_way(const ::render::SceneFile& file) {
  const ::render::Strategy& strategy = ::render::strategy_from("bsdf");
  if (!finds_all_lights(file.scene, strategy)) return {};
  return PictureWay{strategy, ::render::PixelSampler::independent, file.defaults.max_depth};
}

Pictures measure_pictures(const ::render::SceneFile& file, const std::vector<PictureWay>& ways,
                          const PictureOptions& options) {
  mc::require(!ways.empty(), "no way to render is named");
  mc::require(options.replicates >= 3, "{} pictures behind each error; at least 3 are needed", options.replicates);
  mc::require(options.max_spp >= 16, "{} samples per pixel at most; at least 16 are needed", options.max_spp);
  return Session(file, ways, options).run();
}

} // namespace carlo
