#include <input/points_file.h>
#include <sampling/point_sets.h>
#include <sampling/sampling_methods.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/estimate/integrate.h>
#include <mc/random/hash.h>
#include <mc/random/uniform.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace carlo {

namespace {

SamplingMethod point_set_method(const std::string& name, const std::string& title, const PointSet::Mean& mean) {
  SamplingMethod w;
  w.name = name;
  w.title = title;
  w.estimate = [mean](const UnitCubeIntegral& e, std::uint64_t n, std::uint64_t seed) {
    return MethodEstimate{mean(e, static_cast<std::uint32_t>(n), seed), static_cast<double>(n)};
  };
  return w;
}

MethodEstimate integrate_with(const UnitCubeIntegral& e, mc::Method method, std::uint64_t n, std::uint64_t seed) {
  mc::IntegrateOptions o;
  o.rel_error = 0;
  o.max_calls = n;
  o.method = method;
  o.seed = seed;
  o.threads = 1;
  const auto f = [&](std::span<const double> points, std::span<double> values) { evaluate(e, points, values); };
  const mc::Integral r = mc::integrate_unit(mc::BatchIntegrand{f}, e.dim, o);
  return {r.estimate.value, static_cast<double>(r.calls)};
}

// The mean over the points of a file, all shifted modulo 1 by a random vector.
double mean_of_shifted(const CsvTable& points, const UnitCubeIntegral& e, std::uint64_t n, std::uint64_t seed) {
  const auto dim = static_cast<std::size_t>(e.dim);
  return mean_over(e, n, [&](std::uint64_t first, std::span<double> u) {
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double moved = points.row(first + i / dim)[i % dim] + mc::uniform<double>(mc::hash(seed, i % dim));
      u[i] = std::clamp(moved - std::floor(moved), 0x1p-54, 1 - 0x1p-53);
    }
  });
}

SamplingMethod integrate_method(std::string name, std::string title, mc::Method method, std::uint64_t least) {
  SamplingMethod w;
  w.name = std::move(name);
  w.title = std::move(title);
  w.min_calls = least;
  w.is_adaptive = method == mc::Method::vegas || method == mc::Method::tree || method == mc::Method::automatic;
  w.estimate = [method](const UnitCubeIntegral& e, std::uint64_t n, std::uint64_t seed) {
    return integrate_with(e, method, n, seed);
  };
  return w;
}

std::vector<SamplingMethod> make() {
  std::vector<SamplingMethod> all;
  for (const PointSet& set : point_sets()) all.push_back(point_set_method(set.name, set.title, set.mean));
  all.push_back(
      integrate_method("stratified_rounds", "integrate(): rounds of jittered grids", mc::Method::stratified, 1024));
  all.push_back(integrate_method("rqmc", "integrate(): replicated scrambled Sobol' sequences", mc::Method::rqmc, 1024));
  all.push_back(
      integrate_method("vegas", "integrate(): the same through a learned importance grid", mc::Method::vegas, 2048));
  all.push_back(
      integrate_method("tree", "integrate(): vegas with a tree of boxes within its grid", mc::Method::tree, 2048));
  all.push_back(integrate_method("auto", "integrate(): the best of rqmc, vegas and tree", mc::Method::automatic, 2048));
  return all;
}

std::vector<SamplingMethod> make_float() {
  std::vector<SamplingMethod> all;
  for (const PointSet& set : point_sets())
    all.push_back(point_set_method(set.name + "_float", set.title + "; coordinates in float", set.mean_in_float));
  return all;
}

} // namespace

const std::vector<SamplingMethod>& float_sampling_methods() {
  static const std::vector<SamplingMethod> all = make_float();
  return all;
}

const std::vector<SamplingMethod>& sampling_methods() {
  static const std::vector<SamplingMethod> all = make();
  return all;
}

const SamplingMethod& sampling_method(const std::string& name) {
  std::vector<std::string> names;
  for (const auto* list : {&sampling_methods(), &float_sampling_methods()})
    for (const SamplingMethod& w : *list) {
      if (w.name == name) return w;
      names.push_back(w.name);
    }
  throw mc::Error(
      fmt::format("unknown method '{}'{}; use {}", name, mc::did_you_mean(name, names), fmt::join(names, ", ")));
}

SamplingMethod points_file_method(const std::string& file, const std::string& rescale) {
  PointsFile read = read_points(file, {64, std::size_t{1} << 28, 1024, rescale});
  const auto points = std::make_shared<const CsvTable>(std::move(read.table));
  SamplingMethod w;
  w.name = std::filesystem::path(file).filename().string();
  const auto has_its_name = [&](const SamplingMethod& known) { return known.name == w.name; };
  if (std::any_of(sampling_methods().begin(), sampling_methods().end(), has_its_name)) w.name = "./" + w.name;
  w.title = "the points of this file, shifted at random";
  w.points_file = std::filesystem::absolute(file).string();
  w.points_rescale = rescale;
  w.note = read.note;
  w.max_calls = points->rows();
  w.max_dimensions = static_cast<int>(points->columns);
  w.estimate = [points](const UnitCubeIntegral& e, std::uint64_t n, std::uint64_t seed) {
    return MethodEstimate{mean_of_shifted(*points, e, n, seed), static_cast<double>(n)};
  };
  return w;
}

} // namespace carlo
