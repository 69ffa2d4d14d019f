#include <input/file_hash.h>
#include <integrands/find.h>
#include <integrands/genz.h>
#include <integrands/rate_integrals.h>
#include <options/checkpoint_options.h>
#include <options/expression_options.h>
#include <options/integral_options.h>
#include <options/pixels.h>
#include <picture/picture.h>
#include <terminal/message.h>
#include <terminal/progress.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>
#include <render/integrator/light_tracer.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <tuple>

namespace carlo {

namespace {

struct IntegrandGroup {
  const char *name, *title;
  const std::vector<UnitCubeIntegral>& (*list)();
};
constexpr IntegrandGroup groups[] = {{"books", "the integrals of the books", textbook_integrals},
                                     {"genz", "Genz's families", genz_integrals},
                                     {"rates", "each class of smoothness in 1 to 8 dimensions", rate_integrals}};

std::vector<int> depths_of(const std::string& text, int own) {
  if (text.empty()) return {own};
  std::vector<int> depths;
  for (const std::string_view word : mc::split(text, ',')) {
    int depth = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), depth);
    mc::require(error == std::errc() && end == word.data() + word.size() && (depth == -1 || depth >= 1),
                "--max-depths: '{}' in '{}' must be -1 or at least 1", word, text);
    depths.push_back(depth);
  }
  return depths;
}

// The named strategies; without names, the strategies that find every light, of all or of four.
std::vector<render::Strategy> strategies_of(const SceneOptions& o, bool all, const render::SceneFile& file) {
  std::vector<render::Strategy> strategies;
  if (!o.strategies.empty()) {
    for (const std::string_view name : mc::split(o.strategies, ',')) strategies.push_back(render::strategy_from(name));
    return strategies;
  }
  constexpr std::array<std::string_view, 4> four = {"mixture", "nee", "mis", "mis+lt"};
  for (const render::Strategy& s : complete_strategies(file.scene))
    if (all || std::find(four.begin(), four.end(), s.name) != four.end()) strategies.push_back(s);
  return strategies;
}

bool supports_allocation(SampleAllocation allocation, const render::SceneFile& file) {
  const render::Filter& filter = file.scene.filter();
  if (allocation == SampleAllocation::splat)
    return filter.radius() <= render::SplatFilter::max_radius && render::SplatFilter(filter).is_wide();
  return !uses_tiles(allocation) || (file.defaults.aov.kind == render::Aov::radiance && !file.scene.has_volumes());
}

std::vector<RenderMethod> methods_of(const SceneOptions& o, const SceneMeasureRequest& run,
                                     const render::SceneFile& file) {
  const std::string samplers = run.samplers.empty() ? "independent,stratified,sobol" : run.samplers;
  std::vector<RenderMethod> methods;
  for (const SampleAllocation allocation :
       {SampleAllocation::uniform, SampleAllocation::adaptive, SampleAllocation::splat, SampleAllocation::tiles,
        SampleAllocation::adaptive_tiles}) {
    if (allocation != SampleAllocation::uniform && !run.for_trade && !run.all) continue;
    if (!supports_allocation(allocation, file)) continue;
    for (const int depth : depths_of(o.depths, file.defaults.max_depth))
      for (const render::Strategy& strategy : strategies_of(o, run.all, file))
        for (const std::string_view sampler : mc::split(samplers, ','))
          methods.push_back({strategy, render::sampler_from(sampler), depth, allocation});
  }
  const std::optional<RenderMethod> plain = run.for_trade ? plain_mc_method(file) : std::nullopt;
  const auto is_plain = [&](const RenderMethod& method) { return method.name() == plain->name(); };
  if (plain && std::none_of(methods.begin(), methods.end(), is_plain)) methods.push_back(*plain);
  return methods;
}

} // namespace

std::vector<Option> integral_option_rows(IntegralOptions& o, const std::string& names) {
  return {
      {"INTEGRAND", "", &o.integrands, names + ", an expression, e.g. \"exp(-x*x)*cos(y)\", or a scene file (.xml)."},
      domain_option(o.expression),
      {"--max-n", "N", &o.max_n, "Largest number of evaluations of an integrand."},
      {"--list", "", &o.list, "List the integrands and the methods, and stop."},
  };
}

std::vector<IntegralTarget> targets_of(const IntegralOptions& o) {
  mc::require(o.max_n >= 64 && o.max_n <= (1u << 28), "--max-n {} must lie between 64 and 2^28", o.max_n);
  resource_limits(o.foreign.timeout, o.foreign.memory, o.foreign.is_given());
  mc::require(!o.foreign.dim || o.foreign.is_given(), "--dim is for a --command");
  if (o.foreign.is_given()) return foreign_targets(o.foreign, o.integrands, o.expression);
  if (!o.expression.domain.empty())
    for (const std::string& word : o.integrands)
      if (is_domain(word)) find_integrand(word, o.expression); // throws: bounds are one argument
  mc::require(o.expression.domain.empty() || o.integrands.size() == 1, "--domain belongs to one expression");
  std::vector<IntegralTarget> targets;
  const std::vector<std::string> words = o.integrands.empty() ? std::vector<std::string>{"books"} : o.integrands;
  for (const std::string& word : words) {
    const IntegrandGroup* group = nullptr;
    for (const IntegrandGroup& g : groups)
      if (word == g.name) group = &g;
    if (!group) targets.push_back(in_process_target(find_integrand(word, o.expression)));
    else
      for (const UnitCubeIntegral& e : group->list()) targets.push_back(in_process_target(e));
  }
  return targets;
}

int list_integrals() {
  for (const IntegrandGroup& g : groups) {
    fmt::print("{}: {}\n", g.name, g.title);
    for (const UnitCubeIntegral& e : g.list()) fmt::print("  {:<24} {}\n", e.name, e.title);
  }
  fmt::print("methods (point sets and estimators):\n");
  for (const SamplingMethod& w : sampling_methods()) fmt::print("  {:<24} {}\n", w.name, w.title);
  return exit_ok;
}

OptionGroup scene_group(SceneOptions& o) {
  return {
      "Scenes",
      {
          {"--strategies", "NAMES", &o.strategies,
           "Strategies, comma-separated, see carlo render --list-strategies. Default: those of mixture, nee, mis and "
           "mis+lt that find every light."},
          {"--max-depths", "LIST", &o.depths,
           "Longest paths in edges, comma-separated; -1 is no limit. Default: the scene's."},
          {"--size", "WxH", &o.size, "Size of the pictures in pixels. Default: 48 wide."},
          {"--max-spp", "N", &o.max_spp, "Most samples per pixel."},
          {"--cost", "WHAT", &o.cost,
           "Unit of cost: cpu, seconds of processor time, or rays, millions of rays, the same on every machine."},
      }};
}

void refuse_scene_options(const SceneOptions& o) {
  mc::require(o == SceneOptions(), "--strategies, --max-depths, --size, --max-spp and --cost are for a scene (.xml)");
}

void refuse_integral_options(const IntegralOptions& o) {
  IntegralOptions none;
  none.integrands = o.integrands;
  mc::require(o == none,
              "--domain, --plugin, --command, --dim, --timeout, --memory and --max-n are for an integrand; a "
              "scene (.xml) takes --max-spp and --size");
}

bool is_scene(const std::vector<std::string>& words) { return words.size() == 1 && words[0].ends_with(".xml"); }

IntegralTarget scene_target(const std::string& path) {
  IntegralTarget target;
  target.integral.name = target.integral.title = std::filesystem::path(path).stem().string();
  target.integral.source = path;
  target.integral.dim = 0;
  target.integral.truth = 0;
  target.integral.min_fit_n = 0;
  return target;
}

mc::RunIdentity measurement_identity(const std::vector<Option>& options, const std::vector<std::string>& words) {
  mc::RunIdentity identity =
      run_identity(options, {"--list", "--threads", "--resume", "--every", "--timeout", "--memory"});
  if (is_scene(words))
    identity.emplace_back("the content of the scene's files", hash_of_files(render::read_mitsuba(words[0]).files));
  return identity;
}

PictureMeasurement measure_scene(const SceneOptions& o, const SceneMeasureRequest& run) {
  mc::require(o.cost == "cpu" || o.cost == "rays", "--cost '{}' must be cpu or rays", o.cost);
  mc::require(o.max_spp >= 16, "--max-spp {} must be at least 16", o.max_spp);
  const bool adaptive = run.for_trade || run.all;
  mc::require(!adaptive || o.max_spp >= 32, "--max-spp {} must be at least 32 for adaptive spending", o.max_spp);
  const render::SceneFile file = render::read_mitsuba(run.path);
  warn_about_scene_file(file);
  warn_if_imprecise(run.path, file.scene);
  const render::RenderDefaults& own = file.defaults;
  const std::string missing = missing_light_text(file, RenderMethod().strategy, own.max_depth);
  if (!missing.empty()) warn("{}; it is missing in the reference, too", missing);
  PictureOptions p{.width = 48, .height = std::max(1, 48 * own.height / own.width), .max_spp = o.max_spp};
  if (!o.size.empty()) std::tie(p.width, p.height) = parse_size(o.size);
  p.replicates = run.pictures;
  p.seconds = run.seconds;
  p.cost_rays = o.cost == "rays";
  p.seed = run.seed;
  p.threads = run.threads;
  p.cancel = run.cancel;
  p.checkpoint = run.checkpoint;
  p.executor = run.executor;
  ProgressLine progress;
  p.progress = [&](double done, const std::string& where) { progress.show(done, where); };
  PictureMeasurement measured =
      mc::with_context(run.path, [&] { return measure_pictures(file, methods_of(o, run, file), p); });
  measured.missing_light = missing;
  if (!measured.cut_short.empty()) warn("{}: larger numbers of samples are left out", measured.cut_short);
  return measured;
}

namespace {

// "pays for errors above .1 [.09, .2]": where a biased method is cheaper than the unbiased ones.
std::string break_even_text(const std::optional<IntervalEstimate>& above) {
  if (!above) return "never pays";
  if (!std::isfinite(above->value)) return fmt::format("if it pays, for errors above {:.3g} at least", above->lo);
  return fmt::format("pays for errors above {:.3g} [{:.3g}, {}]", above->value, above->lo,
                     std::isfinite(above->hi) ? fmt::format("{:.3g}", above->hi) : "never");
}

} // namespace

std::string bias_summary(const PictureMeasurement& pictures) {
  std::string text = fmt::format("  errors are roots of relmse, with mean^2 / 10 for its 0.01, from a reference of "
                                 "{:.0f} samples per pixel with an error of {:.2g}\n",
                                 pictures.reference_spp, pictures.reference_error);
  for (std::size_t i = 0; i < pictures.biases.size(); ++i) {
    const Bias& b = pictures.biases[i];
    if (!(b.bias.lo > 0)) continue;
    text +=
        fmt::format("  {}: bias {:.3g} [{:.3g}, {:.3g}], noise {:.3g} at N = {:.0f}; {}\n", pictures.methods[i].name,
                    b.bias.value, b.bias.lo, b.bias.hi, b.noise, b.n, break_even_text(b.break_even_error));
  }
  return text;
}

std::string interruption_summary(const PictureMeasurement& pictures) {
  if (pictures.methods.empty()) return "interrupted: no method was finished at 4 samples per pixel, the least number";
  return fmt::format("interrupted: errors up to {:.0f} samples per pixel are known", pictures.biases.front().n);
}

} // namespace carlo
