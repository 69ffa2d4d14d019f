#include <converge/target.h>

#include <mc/core/parallel.h>
#include <mc/random/hash.h>

#include <ctime>
#include <memory>

namespace carlo {

namespace {

double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

} // namespace

Replicates run_here(const Experiment& given, const Task& task) {
  Experiment e = given;
  if (task.way->one_by_one) e.many = {};
  Replicates r;
  for (auto* numbers : {&r.values, &r.calls, &r.seconds}) numbers->resize(task.count);
  mc::parallel_for(task.count, task.threads, [&](std::size_t i) {
    if (task.cancel && *task.cancel) return;
    const double start = thread_cpu_seconds();
    const Sampled s = task.way->estimate(e, task.n, mc::hash(task.seed, task.n, task.first + i));
    r.values[i] = s.value;
    r.calls[i] = s.calls;
    r.seconds[i] = thread_cpu_seconds() - start;
  });
  return r;
}

Target here(Experiment integral) {
  const auto shared = std::make_shared<const Experiment>(integral);
  const bool has_batch = integral.many != nullptr;
  return {std::move(integral), [shared](const Task& task) { return run_here(*shared, task); }, has_batch};
}

} // namespace carlo
