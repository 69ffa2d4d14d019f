#include <mc/core/error.h>
#include <mc/run/job_log.h>

namespace mc {

JobLog::JobLog(Checkpoint* checkpoint, Executor executor)
    : checkpoint_(checkpoint), executor_(executor ? std::move(executor) : Executor(run_on_threads)),
      section_(checkpoint, "jobs", [this](auto& a) { a(entries_); }) {}

Executor JobLog::executor() {
  return [this](const AnyJob& job, const RunOptions& options) { return run(job, options); };
}

bool JobLog::run(const AnyJob& job, RunOptions options) {
  if (next_ < entries_.size()) {
    const Entry& entry = entries_[next_++];
    require(entry.name == job.name, "the checkpoint has the job '{}' where the run has '{}'", entry.name, job.name);
    ArchiveReader reader(entry.state);
    job.read(reader);
    reader.require_end();
    return true;
  }
  options.checkpoint = checkpoint_;
  if (!executor_(job, options)) return false;
  if (!checkpoint_) return true;
  ArchiveWriter writer;
  job.write(writer);
  entries_.push_back({job.name, writer.take()});
  ++next_;
  if (checkpoint_->is_due()) checkpoint_->save();
  return true;
}

void JobLog::save() {
  if (checkpoint_) checkpoint_->save_and_wait();
}

} // namespace mc
