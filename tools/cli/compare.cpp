#include <options/memory_option.h>
#include <options/subcommand.h>
#include <picture/difference.h>
#include <report/view_page.h>
#include <terminal/result_writer.h>

#include <render/io/image/image_io.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carlo {

namespace {

struct CompareCommandOptions {
  std::string a, b;
  std::string metric; ///< empty: all
  std::string diff;   ///< file for the difference image; empty: none
  std::string report; ///< folder of a page; empty: none
  std::string command;
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
           output_folder({"--report", "FOLDER", &o.report,
                          "Write a page to this folder (index.html) that flips between the images, splits them and "
                          "subtracts them."},
                         {"index.html"}),
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
            "Difference relative to B that counts as agreement. Images without variances are judged by it alone: in "
            "every pixel, where pixels darker than the mean of B count as the mean.",
            false,
            {judged}},
           memory_option(o.memory),
       }},
  });
}

// What a comparison found, and its exit code.
struct Verdict {
  std::string text;
  int code = exit_ok;
};

// Without variances, only a tolerance gives a verdict.
Verdict judge_by_tolerance(const CompareCommandOptions& o, const Image& a, const Image& b) {
  mc::require(!o.alpha,
              "--alpha: the images carry no variance, so that there are no tests; give --tolerance, or render "
              "to .exr with two samples or more in every pixel");
  if (o.tolerance == 0)
    return {"none: the images carry no variance; give --tolerance, or render to .exr with two samples or more in every "
            "pixel"};
  const LargestRatio worst = largest_ratio(a, b);
  const bool agree = worst.ratio <= o.tolerance;
  return {
      fmt::format("{}: the largest difference is {:.3g} of B (dark pixels: of its mean), at ({}, {}) {}; tolerance {}",
                  agree ? "agree" : "DIFFER", worst.ratio, worst.x, worst.y,
                  channel_names[static_cast<std::size_t>(worst.channel)], o.tolerance),
      agree ? exit_ok : exit_failed};
}

Verdict judge(const CompareCommandOptions& o, const Image& a, const Image& b, double alpha) {
  if (a.variance.empty() && b.variance.empty()) return judge_by_tolerance(o, a, b);
  std::string exact;
  for (const auto& [name, image] : {std::pair(&o.a, &a), std::pair(&o.b, &b)})
    if (image->variance.empty()) exact = fmt::format("; '{}' has no variance and counts as exact", *name);
    else require_variance(*name, *image);
  const DifferenceTests comparison = test_difference(a, b, o.tolerance);
  for (const auto& [what, w] : {std::pair("pixels", &comparison.pixel), std::pair("blocks", &comparison.block)})
    fmt::print("{:<10} worst at ({}, {}) {}: difference {:.3g}, {:.2f} standard errors, {:.3g} degrees of freedom, p = "
               "{:.2g}\n",
               what, w->x, w->y, channel_names[static_cast<std::size_t>(w->channel)], w->difference, w->t, w->dof,
               w->p);
  const double p = comparison.family_p();
  const std::string tolerance = o.tolerance > 0 ? fmt::format(", tolerance {} of the reference", o.tolerance) : "";
  return {fmt::format("{}: family-wise p = {:.3g} over {:.0f} tests, alpha = {:g}{}{}", p >= alpha ? "agree" : "DIFFER",
                      p, comparison.tests, alpha, tolerance, exact),
          p >= alpha ? exit_ok : exit_failed};
}

void write_difference(const std::string& path, const Image& a, const Image& b, ResultWriter& results) {
  Image difference(a.width, a.height);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) difference.pixels[i] = a.pixels[i] - b.pixels[i];
  results.write(path, false, [&](const std::string& file) { render::write_image(file, difference); });
}

int run_compare(const CompareCommandOptions& options) {
  limit_memory(options.memory);
  const double alpha = options.alpha.value_or(default_alpha);
  mc::require(alpha > 0 && alpha < 1, "--alpha {} must lie in (0, 1)", alpha);
  mc::require(options.tolerance >= 0, "--tolerance {} must be >= 0", options.tolerance);
  if (!options.diff.empty()) mc::require_writable(options.diff);
  std::filesystem::path folder;
  if (!options.report.empty()) folder = mc::make_output_folder(options.report, "index.html");
  const Image a = render::read_image(options.a), b = render::read_image(options.b);
  require_comparable(options.a, a, options.b, b);
  if (!options.report.empty()) require_viewable(options.a, a, "compare parts by carlo view --crop");
  if (!options.diff.empty())
    mc::require_memory(double(sizeof(render::Spectrum)) * double(a.pixels.size()),
                       fmt::format("--diff: {}x{} pixels", a.width, a.height), "leave it out");

  const std::vector<Metric> all = difference_metrics(a, b);
  if (options.metric.empty())
    for (const Metric& m : all) fmt::print("{:<10} {:.6g}\n", m.name, m.value);
  else {
    std::vector<std::string_view> names(all.size());
    std::transform(all.begin(), all.end(), names.begin(), [](const Metric& m) { return m.name; });
    fmt::print("{:.6g}\n", all[mc::index_of("metric", options.metric, names)].value);
  }

  ResultWriter results;
  if (!options.diff.empty()) write_difference(options.diff, a, b, results);
  const Verdict verdict = options.metric.empty() ? judge(options, a, b, alpha) : Verdict{};
  if (!verdict.text.empty()) fmt::print("verdict    {}\n", verdict.text);
  if (!options.report.empty())
    results.write((folder / "index.html").string(), false,
                  to_html(ViewPage{.tool = "carlo compare",
                                   .title = options.a + " and " + options.b,
                                   .command = options.command,
                                   .verdict = verdict.text,
                                   .pictures = {{options.a, &a}, {options.b, &b}}}));
  results.finish();
  return verdict.code;
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
       .sections =
           {{"Verdict",
             {{"", "carlo render writes the variance of every pixel into an EXR. Welch's t-test then compares "
                   "each pixel, and each block of 16x16 pixels, of the two images. All tests share --alpha. An image "
                   "without variances counts as exact; two of them need --tolerance."}}}}},
      rows, run_compare);
}

} // namespace carlo
