#include <converge/integral_target.h>

#include <mc/core/cpu_time.h>
#include <mc/core/error.h>
#include <mc/random/hash.h>
#include <mc/run/job.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace carlo {

namespace {

/// Replicates of a task as an mc::Job: each is a unit. estimate(seed, seconds) adds seconds of other processes.
template <class Estimator> struct ReplicateJob {
  struct Result {
    double value = 0, calls = 0, seconds = 0;
    template <class Archive> void archive(Archive& a) { a(value, calls, seconds); }
  };

  const ReplicateTask& task;
  const Estimator& estimate;
  Replicates replicates = {};
  bool has_begun = false;

  std::size_t next_stage() { return std::exchange(has_begun, true) ? 0 : task.count; }
  std::optional<Result> compute(std::size_t i) const {
    const double start = mc::thread_cpu_seconds();
    double elsewhere = 0;
    const MethodEstimate s = estimate(mc::hash(task.seed, task.n, task.first + i), elsewhere);
    return Result{s.value, s.calls, mc::thread_cpu_seconds() - start + elsewhere};
  }
  void absorb(std::size_t, const Result& r) {
    replicates.values.push_back(r.value);
    replicates.calls.push_back(r.calls);
    replicates.seconds.push_back(r.seconds);
  }
  template <class Archive> void archive(Archive& a) { a(has_begun, replicates); }
  template <class Archive> void archive_stage(Archive&) {}
};

template <class Estimator> Replicates replicates(const ReplicateTask& task, const Estimator& estimate) {
  ReplicateJob<Estimator> job{task, estimate};
  mc::run_job(job, {task.threads, task.cancel, task.checkpoint, task.executor, task.name});
  return std::move(job.replicates);
}

} // namespace

void append(Replicates& all, const Replicates& more) {
  all.values.insert(all.values.end(), more.values.begin(), more.values.end());
  all.calls.insert(all.calls.end(), more.calls.begin(), more.calls.end());
  all.seconds.insert(all.seconds.end(), more.seconds.begin(), more.seconds.end());
}

void refuse_constant(const std::string& expression, const ExpressionContext& context) {
  std::vector<std::string> texts = {expression};
  texts.insert(texts.end(), context.lets.begin(), context.lets.end());
  texts.insert(texts.end(), context.conditions.begin(), context.conditions.end());
  std::vector<std::string> names;
  for (const VariableText& v : split_domain(context.domain)) {
    names.push_back(v.name);
    texts.insert(texts.end(), {v.first, v.second});
  }
  for (const std::string& text : texts)
    for (const std::string& used : variables_of(text))
      if (std::find(names.begin(), names.end(), used) != names.end()) return;
  throw mc::Error(fmt::format("'{}' uses none of {}: a constant has no error to measure; put a variable into it, or "
                              "see carlo integrate",
                              abbreviate(expression), fmt::join(names, ", ")));
}

void refuse_scene_among(const std::vector<std::string>& words) {
  for (const std::string& word : words)
    mc::require(words.size() == 1 || !word.ends_with(".xml"),
                "'{}' stands among others: scenes are measured one at a time; give it alone", word);
}

Replicates run_replicates(const UnitCubeIntegral& given, const ReplicateTask& task) {
  UnitCubeIntegral e = given;
  if (task.method->scalar_calls) e.f_batch = {};
  return replicates(task, [&](std::uint64_t seed, double&) { return task.method->estimate(e, task.n, seed); });
}

Replicates run_replicates(const std::function<UnitCubeIntegral(double& seconds)>& bind, const ReplicateTask& task) {
  return replicates(
      task, [&](std::uint64_t seed, double& seconds) { return task.method->estimate(bind(seconds), task.n, seed); });
}

IntegralTarget in_process_target(UnitCubeIntegral integral) {
  const auto shared = std::make_shared<const UnitCubeIntegral>(integral);
  const bool has_batch = integral.f_batch != nullptr;
  return {std::move(integral), [shared](const ReplicateTask& task) { return run_replicates(*shared, task); },
          has_batch};
}

} // namespace carlo
