#include <options/memory_option.h>
#include <options/subcommand.h>
#include <picture/difference.h>
#include <terminal/result_writer.h>

#include <render/io/image/image_io.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>

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
  require_comparable(options.a, a, options.b, b);

  const std::vector<Metric> all = difference_metrics(a, b);
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

  if (a.variance.empty() || b.variance.empty()) {
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
  const DifferenceTests comparison = test_difference(a, b, options.tolerance);
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
