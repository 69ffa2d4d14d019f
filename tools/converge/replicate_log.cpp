#include <converge/replicate_log.h>

#include <mc/core/error.h>

#include <fmt/format.h>

namespace carlo {

ReplicateLog::ReplicateLog(mc::Checkpoint* checkpoint)
    : checkpoint_(checkpoint), section_(checkpoint, "replicates", [this](auto& a) { a(entries_); }) {}

double ReplicateLog::elapsed() const { return earlier_ + std::chrono::duration<double>(Clock::now() - start_).count(); }

Replicates ReplicateLog::run(const IntegralTarget& target, ReplicateTask task) {
  const std::string key = fmt::format("{} {}{} {} {} {} {}", target.integral.name, task.method->name,
                                      task.method->scalar_calls ? " 1" : "", task.n, task.seed, task.first, task.count);
  if (next_ < entries_.size() && entries_[next_].task != key) { // the clock decided otherwise
    entries_.resize(next_);
    if (checkpoint_) checkpoint_->forget_inner_sections();
  }
  if (next_ == entries_.size()) {
    Entry entry{.task = key, .replicates = {}, .error = {}};
    task.checkpoint = checkpoint_;
    const std::uint64_t saves = checkpoint_ ? checkpoint_->saves() : 0;
    try {
      entry.replicates = target.run(task);
    } catch (const mc::Error& e) {
      entry.error = e.what();
    }
    entry.elapsed = elapsed();
    if (task.cancel && *task.cancel) { // not complete; units of this process were saved, those of a plugin are not
      if (checkpoint_ && checkpoint_->saves() == saves) checkpoint_->save_and_wait();
      return entry.replicates;
    }
    entries_.push_back(std::move(entry));
    if (checkpoint_ && checkpoint_->is_due()) checkpoint_->save();
  }
  const Entry& entry = entries_[next_++];
  earlier_ = entry.elapsed;
  start_ = Clock::now();
  if (!entry.error.empty()) throw mc::Error(entry.error);
  return entry.replicates;
}

void ReplicateLog::save() {
  if (checkpoint_) checkpoint_->save_and_wait();
}

} // namespace carlo
