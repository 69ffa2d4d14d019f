#pragma once
/// Units that another process hands out, and their results.

#include <mc/run/executor.h>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace mc::detail {

/// A queue for work_on_threads(): one thread adds units and sends the results, the others compute.
class UnitStore {
 public:
  /// Waits for a unit. Nothing once the store is closed.
  std::optional<std::size_t> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_closed_ || !units_.empty(); });
    if (is_closed_) return {};
    const std::size_t unit = units_.front();
    units_.pop_front();
    return unit;
  }
  /// Keeps the result of a unit.
  void deliver(std::size_t unit, AnyResult result) {
    const std::lock_guard lock(mutex_);
    ++delivered_;
    results_.emplace_back(unit, std::move(result));
  }
  /// Gives out no further unit.
  void close() {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
    changed_.notify_all();
  }
  /// Adds units, in order.
  void add(const std::vector<std::uint64_t>& units) {
    const std::lock_guard lock(mutex_);
    for (const std::uint64_t unit : units) units_.push_back(static_cast<std::size_t>(unit));
    changed_.notify_all();
  }
  /// Number of results so far.
  std::size_t delivered() {
    const std::lock_guard lock(mutex_);
    return delivered_;
  }
  /// Number of units that were not taken.
  std::size_t waiting() {
    const std::lock_guard lock(mutex_);
    return units_.size();
  }
  /// Whether close() was called.
  bool is_closed() {
    const std::lock_guard lock(mutex_);
    return is_closed_;
  }
  /// The results since the last call.
  std::vector<std::pair<std::size_t, AnyResult>> take_results() {
    const std::lock_guard lock(mutex_);
    return std::exchange(results_, {});
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::size_t> units_;
  std::vector<std::pair<std::size_t, AnyResult>> results_;
  std::size_t delivered_ = 0;
  bool is_closed_ = false;
};

} // namespace mc::detail
