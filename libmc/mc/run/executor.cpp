#include <mc/core/parallel.h>
#include <mc/run/executor.h>
#include <mc/run/work_on_threads.h>

#include <algorithm>

namespace mc {

namespace {

constexpr std::size_t ahead_of_thread = 8; // units

} // namespace

namespace detail {

bool UnitQueue::begin_stage() {
  units_ = job_.next_stage();
  absorbed_ = 0;
  results_.clear(); // where no further unit might start, results of a checkpoint may lack one before them
  return units_ > 0;
}

void UnitQueue::open(std::size_t most_ahead) {
  const std::lock_guard lock(mutex_);
  next_ = absorbed_;
  most_ahead_ = most_ahead;
}

void UnitQueue::close() {
  const std::lock_guard lock(mutex_);
  next_ = units_;
  absorbed_more_.notify_all();
}

// Finds the next unit. Returns false where none will be given out.
bool UnitQueue::find_next() {
  next_ = std::max(next_, absorbed_);
  while (results_.contains(next_)) ++next_; // of a checkpoint
  return next_ < units_ && !is_cancelled() && job_.may_start();
}

std::optional<std::size_t> UnitQueue::take() {
  std::unique_lock lock(mutex_);
  while (find_next()) {
    if (next_ < absorbed_ + most_ahead_) return next_++;
    absorbed_more_.wait(lock);
  }
  return {};
}

std::optional<std::size_t> UnitQueue::try_take() {
  const std::lock_guard lock(mutex_);
  const bool may_take = find_next() && next_ < absorbed_ + most_ahead_;
  return may_take ? std::optional(next_++) : std::nullopt;
}

bool UnitQueue::is_over() {
  const std::lock_guard lock(mutex_);
  return !find_next();
}

void UnitQueue::deliver(std::size_t unit, AnyResult result) {
  const std::lock_guard lock(mutex_);
  if (has_failed_) return;
  if (result) {
    results_.emplace(unit, std::move(result));
    absorb_results();
  } else gave_up_ = true;
  absorbed_more_.notify_all();
}

void UnitQueue::absorb_results() {
  try {
    for (auto first = results_.begin(); first != results_.end() && first->first == absorbed_;
         first = results_.erase(first), ++absorbed_)
      job_.absorb(absorbed_, std::move(first->second));
  } catch (...) {
    has_failed_ = true;
    next_ = units_;
    absorbed_more_.notify_all();
    throw;
  }
  if (options_.checkpoint && options_.checkpoint->is_due()) options_.checkpoint->save();
}

void UnitQueue::absorb_all() {
  for (auto& [unit, result] : results_) job_.absorb(unit, std::move(result));
}

void UnitQueue::write(ArchiveWriter& a) {
  a(std::uint64_t{units_}, std::uint64_t{absorbed_}, std::uint64_t{results_.size()});
  for (const auto& [unit, result] : results_) {
    a(std::uint64_t{unit});
    job_.write_result(a, result);
  }
  job_.write(a);
}

void UnitQueue::read(ArchiveReader& a) {
  std::uint64_t units = 0, absorbed = 0, results = 0, unit = 0;
  a(units, absorbed, results);
  units_ = units;
  absorbed_ = absorbed;
  for (std::uint64_t i = 0; i < results; ++i) {
    a(unit);
    results_.emplace(unit, job_.read_result(a));
  }
  job_.read(a);
}

bool run_stages(const AnyJob& job, const RunOptions& options, const std::function<void(UnitQueue&)>& run_stage) {
  UnitQueue queue(job, options);
  const Checkpoint::Section section(options.checkpoint, "job", [&queue](auto& a) {
    if constexpr (std::remove_cvref_t<decltype(a)>::is_reader) queue.read(a);
    else queue.write(a);
  });
  bool is_done = queue.left() == 0 && !queue.begin_stage();
  while (!is_done && !queue.is_cancelled()) {
    run_stage(queue);
    if (queue.left() == 0 || queue.is_cut_short()) is_done = !queue.begin_stage();
  }
  if (options.checkpoint && (!is_done || section.is_outermost())) options.checkpoint->save_and_wait();
  queue.absorb_all();
  return is_done;
}

int threads_of(const RunOptions& options) { return options.threads != 0 ? options.threads : hardware_threads(); }

} // namespace detail

std::size_t max_waiting_results(int threads) {
  return ahead_of_thread * static_cast<std::size_t>(detail::threads_of({.threads = threads}));
}

bool run_on_threads(const AnyJob& job, const RunOptions& options) {
  return detail::run_stages(job, options, [&](detail::UnitQueue& queue) {
    const std::size_t workers = std::min(static_cast<std::size_t>(detail::threads_of(options)), queue.left());
    queue.open(ahead_of_thread * workers);
    detail::work_on_threads(job, options.threads, workers, queue);
  });
}

} // namespace mc
