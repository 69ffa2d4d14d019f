#include <options/memory_option.h>
#include <options/subcommand.h>
#include <terminal/result_writer.h>

#include <render/io/image/image_io.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>
#include <mc/stats/t_test.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

namespace carlo {

namespace {

struct CompareCommandOptions {
  std::string a, b;
  std::string metric;           ///< empty: all
  std::string diff;             ///< file for the difference image; empty: none
  std::optional<double> alpha;  ///< family-wise; none: usual_alpha
  double tolerance = 0;         ///< relative difference that still counts as agreement
  std::optional<double> memory; ///< [GiB]
};

constexpr double default_alpha = 0.01;

using render::Image;

constexpr std::array channel_names = {"red", "green", "blue"};

struct Metric {
  std::string_view name;
  double value;
};

std::vector<Metric> metrics(const Image& a, const Image& b) {
  double square = 0, absolute = 0, relative = 0, peak = 0, mean_a = 0, mean_b = 0;
  const double n = 3.0 * double(a.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double x = double(a.pixels[i][c]), y = double(b.pixels[i][c]), d = x - y;
      square += d * d;
      absolute += std::abs(d);
      relative += d * d / (y * y + 0.01);
      peak = std::max(peak, std::abs(d));
      mean_a += x;
      mean_b += y;
    }
  return {{"mse", square / n},   {"rmse", std::sqrt(square / n)},
          {"mae", absolute / n}, {"relmse", relative / n},
          {"max", peak},         {"mean_ratio", mean_a == mean_b ? 1 : mean_a / mean_b}};
}

// The noise of an image: whether variances are known, their degrees of freedom, and the number of correlated pixels.
struct ImageNoise {
  bool known;
  double dof, area;
  explicit ImageNoise(const Image& image)
      : known(!image.variance.empty()), dof(std::max(2.0, double(image.estimates)) - 1), area(image.noise_area) {}
};

struct LargestDeviation {
  double p = 1, t = 0, dof = 0, difference = 0, error = 0;
  int x = 0, y = 0, channel = 0;
};

/// Sums over a rectangle of pixels, or one pixel, with the variances of these sums.
struct BlockSums {
  double pixels = 0, difference = 0, reference = 0, variance_a = 0, variance_b = 0;
  mc::VarianceSum all; ///< variances of both
};

class Comparison {
 public:
  Comparison(const Image& a, const Image& b, double tolerance)
      : a_(a), b_(b), noise_a_(a), noise_b_(b), tolerance_(tolerance),
        max_pixel_dof_(std::min(noise_a_.dof + noise_b_.dof, 3.0)) {}

  bool have_variances() const { return noise_a_.known && noise_b_.known; }

  // Tests pixels and blocks of 16x16 pixels. A pixel takes the mean variance of its 3x3 neighbourhood, since a pixel
  // that missed a rare bright path underestimates its own variance. Its degrees of freedom are those of the
  // neighbourhood, but at most the sum of the two pixels' own, and at most 3. One rare bright path can dominate a
  // pixel, so its noise is far from normal; Student's t with 3 degrees of freedom has heavy tails. Blocks detect
  // differences that are small in every pixel.
  void run() {
    for (int c = 0; c < 3; ++c) {
      // A pixel without any rare event has variance 0; a floor keeps differences far below the typical noise from
      // counting.
      const BlockSums whole = sum(0, 0, a_.width, a_.height, c);
      floor_ = 1e-6 * (whole.variance_a + whole.variance_b) / double(a_.pixels.size());
      for (int y = 0; y < a_.height; ++y)
        for (int x = 0; x < a_.width; ++x) {
          BlockSums sums = sum(x, y, x + 1, y + 1, c);
          const int x0 = std::max(x - 1, 0), y0 = std::max(y - 1, 0), x1 = std::min(x + 2, a_.width),
                    y1 = std::min(y + 2, a_.height);
          const BlockSums around = sum(x0, y0, x1, y1, c);
          sums.variance_a = around.variance_a / around.pixels / noise_a_.area;
          sums.variance_b = around.variance_b / around.pixels / noise_b_.area;
          sums.all = around.all;
          test(sums, x, y, c, pixel);
        }
      for (int y = 0; y < a_.height; y += block_size)
        for (int x = 0; x < a_.width; x += block_size) {
          const int x1 = std::min(x + block_size, a_.width), y1 = std::min(y + block_size, a_.height);
          test(sum(x, y, x1, y1, c), x, y, c, block);
        }
    }
  }

  double family_p() const {
    return -std::expm1(tests * std::log1p(-std::min(std::min(pixel.p, block.p), 1 - 0x1p-53)));
  }

  LargestDeviation pixel, block;
  double tests = 0;
  static constexpr int block_size = 16;

 private:
  BlockSums sum(int x0, int y0, int x1, int y1, int c) const {
    BlockSums sums;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const std::size_t i = a_.index(x, y);
        ++sums.pixels;
        sums.difference += double(a_.pixels[i][c]) - double(b_.pixels[i][c]);
        sums.reference += double(b_.pixels[i][c]);
        // Correlated pixels count as fewer independent variances.
        const double va = double(a_.variance[i][c]) * noise_a_.area, vb = double(b_.variance[i][c]) * noise_b_.area;
        sums.variance_a += va;
        sums.variance_b += vb;
        sums.all.add(va, noise_a_.dof, noise_a_.area);
        sums.all.add(vb, noise_b_.dof, noise_b_.area);
      }
    return sums;
  }

  // Welch's t-test of the mean of the pixels.
  void test(const BlockSums& sums, int x, int y, int c, LargestDeviation& worst) {
    const double n = sums.pixels;
    ++tests;
    const double variance = std::max((sums.variance_a + sums.variance_b) / n, floor_) / n;
    const double difference = sums.difference / n;
    const double excess = std::max(0.0, std::abs(difference) - tolerance_ * std::abs(sums.reference / n));
    if (excess == 0) return;
    double p = 0, t = mc::infinity<double>;
    const double dof = n == 1 ? std::min(sums.all.dof(), max_pixel_dof_) : sums.all.dof();
    if (variance > 0) {
      t = excess / std::sqrt(variance);
      p = mc::student_tail(t, dof);
    }
    if (p < worst.p || (p == worst.p && t > worst.t)) worst = {p, t, dof, difference, std::sqrt(variance), x, y, c};
  }

  const Image &a_, &b_;
  ImageNoise noise_a_, noise_b_;
  double tolerance_, max_pixel_dof_, floor_ = 0;
};

std::vector<Option> rows(CompareCommandOptions& o) {
  const Exclusion judged{"--metric", "--metric prints one number and no verdict"};
  return in_groups({
      {common_options,
       {
           input_file({"A", "FILE", &o.a, "Image: .exr, .pfm, .hdr, .png or .jpg.", true}),
           input_file({"B", "FILE", &o.b, "Image of the same size; the reference of relative metrics.", true}),
           {"--metric", "NAME", &o.metric,
            "Print only this number: mse, rmse, mae, relmse, max or mean_ratio. Default: all of them, and the "
            "verdict."},
           output_file({"--diff", "FILE", &o.diff, "Write the image A - B to this file."}),
       }},
      {expert_options,
       {
           {"--alpha",
            "PROBABILITY",
            &o.alpha,
            "Probability of calling two correct images different, over all tests together. Default: 0.01.",
            false,
            {judged}},
           {"--tolerance",
            "RATIO",
            &o.tolerance,
            "Difference relative to B that counts as agreement.",
            false,
            {judged}},
           memory_option(o.memory),
       }},
  });
}

// Throws Error where the t-tests lack a usable variance.
void require_variance(const std::string& path, const Image& image) {
  double largest = 0, noise = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double variance = double(image.variance[i][c]);
      mc::require(
          std::isfinite(variance) && variance >= 0,
          "'{}': the variance of pixel ({}, {}) in {} is {:.3g}; it must be finite and >= 0 (--metric needs none)",
          path, i % static_cast<std::size_t>(image.width), i / static_cast<std::size_t>(image.width),
          channel_names[static_cast<std::size_t>(c)], variance);
      largest = std::max(largest, std::abs(double(image.pixels[i][c])));
      noise = std::max(noise, variance);
    }
  mc::require(noise > 0 || largest == 0 || largest >= 1e-18,
              "'{}': the largest value is {:.3g}, too small for its variance to be a float; render with brighter light",
              path, largest);
}

// The subject of a message: "'a.png' carries", or "the images carry".
std::string without_variance(const CompareCommandOptions& options, const Image& a, const Image& b) {
  if (a.variance.empty() && b.variance.empty()) return "the images carry";
  return fmt::format("'{}' carries", a.variance.empty() ? options.a : options.b);
}

int run_compare(const CompareCommandOptions& options) {
  limit_memory(options.memory);
  const double alpha = options.alpha.value_or(default_alpha);
  mc::require(alpha > 0 && alpha < 1, "--alpha {} must lie in (0, 1)", alpha);
  mc::require(options.tolerance >= 0, "--tolerance {} must be >= 0", options.tolerance);
  if (!options.diff.empty()) mc::require_writable(options.diff);
  const Image a = render::read_image(options.a), b = render::read_image(options.b);
  mc::require(a.width == b.width && a.height == b.height, "'{}' is {}x{} but '{}' is {}x{}; the sizes must agree",
              options.a, a.width, a.height, options.b, b.width, b.height);
  for (const auto* image : {&a, &b})
    for (std::size_t i = 0; i < image->pixels.size(); ++i)
      mc::require(image->pixels[i].isFinite().all(), "'{}': pixel ({}, {}) is not finite",
                  image == &a ? options.a : options.b, i % static_cast<std::size_t>(a.width),
                  i / static_cast<std::size_t>(a.width));

  const auto all = metrics(a, b);
  if (options.metric.empty())
    for (const Metric& m : all) std::printf("%-10s %.6g\n", std::string(m.name).c_str(), m.value);
  else {
    std::vector<std::string_view> names(all.size());
    std::transform(all.begin(), all.end(), names.begin(), [](const Metric& m) { return m.name; });
    std::printf("%.6g\n", all[mc::index_of("metric", options.metric, names)].value);
  }

  if (!options.diff.empty()) {
    Image difference(a.width, a.height);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) difference.pixels[i] = a.pixels[i] - b.pixels[i];
    ResultWriter results;
    results.write(options.diff, false, [&](const std::string& file) { render::write_image(file, difference); });
    results.finish();
  }
  if (!options.metric.empty()) return exit_ok;

  Comparison comparison(a, b, options.tolerance);
  if (!comparison.have_variances()) {
    const std::string subject = without_variance(options, a, b);
    const char* remedy = "render to .exr with two samples or more in every pixel";
    const char* judged = options.tolerance > 0 ? "--tolerance" : "--alpha";
    mc::require(options.tolerance == 0 && !options.alpha, "{}: {} no variance, so that there is no verdict; {}", judged,
                subject, remedy);
    fmt::print("verdict    none: {} no variance; {}\n", subject, remedy);
    return exit_ok;
  }
  require_variance(options.a, a);
  require_variance(options.b, b);
  comparison.run();
  const auto print = [&](const char* what, const LargestDeviation& w) {
    std::printf(
        "%-10s worst at (%d, %d) %s: difference %.3g, %.2f standard errors, %.3g degrees of freedom, p = %.2g\n", what,
        w.x, w.y, channel_names[static_cast<std::size_t>(w.channel)], w.difference, w.t, w.dof, w.p);
  };
  print("pixels", comparison.pixel);
  print("blocks", comparison.block);
  const double p = comparison.family_p();
  const bool agree = p >= alpha;
  std::printf("verdict    %s: family-wise p = %.3g over %.0f tests, alpha = %g%s\n", agree ? "agree" : "DIFFER", p,
              comparison.tests, alpha,
              options.tolerance > 0 ? fmt::format(", tolerance {} of the reference", options.tolerance).c_str() : "");
  return agree ? exit_ok : exit_failed;
}

} // namespace

Subcommand compare_subcommand() {
  return make_subcommand<CompareCommandOptions>(
      {.name = "compare",
       .summary = "Tell whether two images agree: error metrics, and t-tests where the variance of pixels is known",
       .examples = {{"carlo compare a.exr b.exr", "tests two renders of one scene for differences beyond noise"},
                    {"carlo compare a.exr b.exr --metric rmse", "prints one number"},
                    {"carlo compare a.png b.png --diff d.exr", "prints metrics, and writes the difference"}},
       .failure = "the images differ",
       .sections = {{"Verdict",
                     {{"",
                       "carlo render writes the variance of every pixel into an EXR. Welch's t-test then compares "
                       "each pixel, and each block of 16x16 pixels, of the two images. All tests share --alpha."}}}}},
      rows, run_compare);
}

} // namespace carlo
