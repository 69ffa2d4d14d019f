#include <integrands/box_map.h>
#include <plugin/foreign_rows.h>
#include <plugin/integrands.h>
#include <plugin/plugin.h>
#include <plugin/plugin_integrand.h>

#include <mc/core/cpu_time.h>
#include <mc/core/error.h>
#include <mc/core/text.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace carlo {

using nlohmann::json;

namespace {

json describe(const mc_integrand& f) {
  json one = {{"name", f.name},
              {"title", mc::printable(f.title ? f.title : f.name, 200)},
              {"dim", unit_dimension(f)},
              {"batch", f.eval_many != nullptr},
              {"has_density", f.sample != nullptr},
              {"outputs", json::array()},
              {"lo", json::array()},
              {"hi", json::array()}};
  for (std::size_t k = 0; k < output_count(f); ++k)
    one["outputs"].push_back({{"name", output_name(f, k)}, {"truth", f.has_truth ? json(truth_of(f, k)) : json()}});
  for (int k = 0; k < f.dim; ++k) {
    one["lo"].push_back(f.lo ? f.lo[k] : 0);
    one["hi"].push_back(f.hi ? f.hi[k] : 1);
  }
  return one;
}

// The integrands with these names, or all; each with its index.
std::vector<json> described(const std::string& path, const std::vector<std::string>& names,
                            const WorkerOptions& worker) {
  const json all = call_worker({{"task", "describe integrands"}, {"who", path}}, worker);
  mc::require(!all.empty(), "{}: it contains distributions but no integrands; see carlo validate --plugin", path);
  std::vector<std::string> known;
  for (const json& one : all) known.push_back(one["name"]);
  for (const std::string& name : names)
    mc::require(std::find(known.begin(), known.end(), name) != known.end(), "{}: unknown integrand '{}'{}; it holds {}",
                path, name, mc::did_you_mean(name, known), fmt::join(known, ", "));
  std::vector<json> chosen;
  for (std::size_t index = 0; index < known.size(); ++index) {
    if (!names.empty() && std::find(names.begin(), names.end(), known[index]) == names.end()) continue;
    chosen.push_back(all[index]);
    chosen.back()["index"] = index;
  }
  return chosen;
}

UnitCubeIntegral integral_of(const std::string& path, const json& one, std::size_t output) {
  const json& described = one["outputs"][output];
  UnitCubeIntegral e;
  e.name = described["name"];
  e.title = one["outputs"].size() == 1 ? one["title"].get<std::string>()
                                       : fmt::format("{}: {}", one["title"].get<std::string>(), e.name);
  e.source = path;
  e.dim = one["dim"];
  e.truth = described["truth"].is_null() ? std::numeric_limits<double>::quiet_NaN() : described["truth"].get<double>();
  e.min_fit_n = 0;
  return e;
}

json integrand_check(const std::string& path, std::size_t index) {
  return {{"task", "check integrand"}, {"who", path}, {"index", index}};
}

// An output of an integrand of a plugin.
struct PluginOutput {
  std::string path;
  std::size_t index, output;
};

// `is_checked` records whether the integrand has passed the check, which runs only once.
Replicates run(const PluginOutput& which, const ReplicateTask& task, WorkerOptions worker, bool& is_checked) {
  worker.cancel = task.cancel;
  json r;
  try {
    if (!is_checked) call_worker(integrand_check(which.path, which.index), worker);
    is_checked = true;
    r = call_worker({{"task", "integrand"},
                     {"who", which.path},
                     {"index", which.index},
                     {"output", which.output},
                     {"way", task.method->name},
                     {"file", task.method->points_file},
                     {"rescale", task.method->points_rescale},
                     {"one_by_one", task.method->scalar_calls},
                     {"n", task.n},
                     {"seed", task.seed},
                     {"first", task.first},
                     {"count", task.count}},
                    worker);
  } catch (const Interrupted&) {
    const std::vector<double> nothing(task.count, 0.0);
    return {nothing, nothing, nothing};
  }
  return {r["values"], r["calls"], r["seconds"]};
}

json run_replicates_of(const mc_integrand& f, const json& request, CallMonitor& monitor) {
  ReplicateTask task;
  const std::string file = request["file"];
  SamplingMethod chosen = file.empty() ? sampling_method(request["way"]) : points_file_method(file, request["rescale"]);
  chosen.scalar_calls = request["one_by_one"];
  task.method = &chosen;
  task.n = request["n"];
  task.seed = request["seed"];
  task.first = request["first"];
  task.count = request["count"];
  task.threads = 1;
  JointIntegrand all = joint_of(f, monitor, chosen.scalar_calls);
  bind_outputs(all);
  const Replicates r = run_replicates(all.outputs[request["output"].get<std::size_t>()], task);
  return {{"values", r.values}, {"calls", r.calls}, {"seconds", r.seconds}};
}

RowShape shape_of(const mc_integrand& f) { return {static_cast<std::size_t>(unit_dimension(f)), output_count(f)}; }

// One integrand of a plugin, evaluated in sessions.
JointIntegrand session_integrand(const std::string& path, const json& one, const WorkerOptions& worker) {
  const std::size_t index = one["index"], outputs = one["outputs"].size(), dim = one["dim"];
  call_worker(integrand_check(path, index), worker);
  const auto rows = std::make_shared<ForeignRows>(json{{"task", "integrand session"}, {"who", path}, {"index", index}},
                                                  RowShape{dim, outputs}, worker);
  JointIntegrand all;
  std::vector<VariableBounds> bounds;
  for (std::size_t k = 0; k < one["lo"].size(); ++k)
    bounds.push_back({fmt::format("x{}", k), one["lo"][k], one["hi"][k]});
  for (std::size_t k = 0; k < outputs; ++k) {
    all.outputs.push_back(integral_of(path, one, k));
    if (one["has_density"]) continue; // the box is not the image of the cube
    all.outputs.back().bounds = bounds;
    all.outputs.back().describe_point = [box = BoxMap(bounds)](UnitCubeIntegral::UnitPoint u) {
      return box.describe(u);
    };
  }
  all.f = [rows](UnitCubeIntegral::UnitPoint points, std::span<double> values) { (*rows)(points, values); };
  bind_outputs(all);
  return all;
}

} // namespace

json run_integrand_task(const json& request, CallMonitor& monitor) {
  const Plugin plugin = load_plugin(request["who"], monitor);
  const std::string task = request["task"];
  if (task == "describe integrands") {
    json all = json::array();
    for (const mc_integrand& f : plugin.integrands) all.push_back(describe(f));
    return all;
  }
  const mc_integrand& f = plugin.integrands[request["index"].get<std::size_t>()];
  if (task == "integrand") return run_replicates_of(f, request, monitor);
  if (task == "check integrand") require_pure(f, monitor);
  if (task == "integrand session")
    answer_rows(request, monitor, shape_of(f), joint_of(f, monitor).f, mc::thread_cpu_seconds);
  return {};
}

std::vector<IntegralTarget> plugin_targets(const std::string& path, const std::vector<std::string>& names,
                                           const WorkerOptions& worker) {
  std::vector<IntegralTarget> targets;
  for (const json& one : described(path, names, worker)) {
    const auto is_checked = std::make_shared<bool>(false);
    for (std::size_t k = 0; k < one["outputs"].size(); ++k) {
      IntegralTarget t;
      t.is_foreign = true;
      t.integral = integral_of(path, one, k);
      t.has_batch = one["batch"];
      t.run = [which = PluginOutput{path, one["index"], k}, worker, is_checked](const ReplicateTask& task) {
        return run(which, task, worker, *is_checked);
      };
      targets.push_back(std::move(t));
    }
  }
  return targets;
}

JointIntegrand plugin_integrand(const std::string& path, const std::vector<std::string>& names,
                                const WorkerOptions& worker) {
  const std::vector<json> chosen = described(path, names, worker);
  std::vector<std::string> known;
  known.reserve(chosen.size());
  for (const json& one : chosen) known.push_back(one["name"]);
  mc::require(!names.empty() || chosen.size() == 1, "{}: it contains {} integrands; name one of {}", path,
              chosen.size(), fmt::join(known, ", "));
  std::vector<JointIntegrand> parts;
  parts.reserve(chosen.size());
  for (const json& one : chosen) parts.push_back(session_integrand(path, one, worker));
  return joined(std::move(parts));
}

} // namespace carlo
