#include <converge/replicate_log.h>

#include <mc/core/error.h>
#include <mc/run/job.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace carlo {

namespace {

// Replicates of foreign code as an mc::Job. A unit is a few of them, since each starts a process.
struct ForeignJob {
  using Result = Replicates;
  static constexpr std::uint64_t size = 8;

  const IntegralTarget& target;
  const ReplicateTask& task;
  Replicates replicates = {};
  bool has_begun = false;

  std::size_t next_stage() { return std::exchange(has_begun, true) ? 0 : (task.count + size - 1) / size; }
  std::optional<Replicates> compute(std::size_t unit) const {
    ReplicateTask share = task;
    share.first += unit * size;
    share.count = std::min(size, task.count - unit * size);
    Replicates result = target.run(share);
    return task.cancel && *task.cancel ? std::nullopt : std::optional(std::move(result));
  }
  void absorb(std::size_t, const Replicates& more) { append(replicates, more); }
  template <class Archive> void archive(Archive& a) { a(has_begun, replicates); }
};

} // namespace

ReplicateLog::ReplicateLog(mc::Checkpoint* checkpoint, mc::Executor executor)
    : checkpoint_(checkpoint), executor_(std::move(executor)),
      section_(checkpoint, "replicates", [this](auto& a) { a(entries_); }) {}

Replicates ReplicateLog::compute(const IntegralTarget& target, ReplicateTask task, const std::string& name) const {
  task.name = name;
  if (!target.is_foreign || !executor_) {
    task.checkpoint = checkpoint_;
    task.executor = executor_;
    return target.run(task);
  }
  ForeignJob job{target, task};
  mc::run_job(job, {1, task.cancel, nullptr, executor_, name}); // a unit takes all threads
  return std::move(job.replicates);
}

Replicates ReplicateLog::result_of(Entry entry) {
  earlier_ = entry.elapsed;
  start_ = Clock::now();
  if (!entry.error.empty()) throw mc::Error(entry.error);
  return std::move(entry.replicates);
}

Replicates ReplicateLog::run(const IntegralTarget& target, ReplicateTask task) {
  const std::string key = fmt::format("{} {}{} {} {} {} {}", target.integral.name, task.method->name,
                                      task.method->scalar_calls ? " 1" : "", task.n, task.seed, task.first, task.count);
  if (next_ < entries_.size() && entries_[next_].task != key) { // the clock decided otherwise
    entries_.resize(next_);
    if (checkpoint_) checkpoint_->forget_inner_sections();
  }
  if (next_ == entries_.size()) {
    Entry entry{.task = key, .replicates = {}, .error = {}};
    const std::uint64_t saves = checkpoint_ ? checkpoint_->saves() : 0;
    try {
      entry.replicates = compute(target, task, key);
    } catch (const mc::Error& e) {
      entry.error = e.what();
    }
    entry.elapsed =
        mc::shared_value(earlier_ + std::chrono::duration<double>(Clock::now() - start_).count(), executor_);
    if (task.cancel && *task.cancel) { // not complete; units of this process were saved, those of a plugin are not
      if (checkpoint_ && checkpoint_->saves() == saves) checkpoint_->save_and_wait();
      return entry.replicates;
    }
    if (!checkpoint_) return result_of(std::move(entry));
    entries_.push_back(std::move(entry));
    if (checkpoint_->is_due()) checkpoint_->save();
  }
  return result_of(entries_[next_++]);
}

void ReplicateLog::save() {
  if (checkpoint_) checkpoint_->save_and_wait();
}

} // namespace carlo
