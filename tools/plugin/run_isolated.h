#pragma once
/// Runs external code in a separate process.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace carlo {

/// The current call of the external code, in memory shared by both processes, so that a crash or a hang can be located.
class CallMonitor {
 public:
  static constexpr int max_arguments = 6;

  /// Call enter() before and leave() after every call. `function` and `argument` ("u", "x", "") are string literals.
  void enter(const char* function, const char* argument = "", const double* values = nullptr, int n = 0) {
    argument_ = argument;
    n_ = n;
    wanted_ = 0;
    for (int i = 0; i < n; ++i) values_[i] = values[i];
    function_.store(function, std::memory_order_relaxed);
  }
  /// For an answer that arrives in parts: how many of its numbers have arrived.
  void answered(std::size_t numbers, std::size_t wanted) {
    answered_ = numbers;
    wanted_ = wanted;
  }
  void leave() {
    function_.store(nullptr, std::memory_order_relaxed);
    calls_.store(calls_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  /// Whether the code waits for the next question of a session. The time limit does not run then.
  void set_idle(bool idle) { idle_.store(idle, std::memory_order_relaxed); }
  bool is_idle() const { return idle_.load(std::memory_order_relaxed); }

  std::uint64_t calls() const { return calls_.load(std::memory_order_relaxed); }
  bool inside() const { return function_.load(std::memory_order_relaxed) != nullptr; }
  /// " in sample at u = (0.25, 0.5)". If a part of the answer has arrived, also ", where 2 of 3 numbers have come
  /// (doubles of 8 bytes)". Outside of any call " after 12 calls".
  std::string where() const;

 private:
  std::atomic<const char*> function_{nullptr};
  const char* argument_ = "";
  std::atomic<std::uint64_t> calls_{0};
  std::atomic<bool> idle_{false};
  int n_ = 0;
  std::size_t answered_ = 0, wanted_ = 0;
  double values_[max_arguments] = {};
};

/// Resource limits of external code. Exceeding one ends it.
struct ResourceLimits {
  double seconds = 60;  ///< wall-clock: for the whole work, or in a session for one call
  double gigabytes = 4; ///< in units of 2^30 bytes, see run_isolated; ignored under a sanitizer, which reserves
                        ///< terabytes
  int files = 256;      ///< open at the same time
  std::string reduce_option = "--samples"; ///< the command-line option that reduces the amount of work
};

/// The default limits, replaced by --timeout and --memory if given.
///   throws : Error for invalid values, and for either option without external code.
ResourceLimits resource_limits(std::optional<double> timeout, std::optional<double> memory, bool has_foreign_code);

/// Descriptors of a session, see run_isolated.
constexpr int session_input = 4, session_output = 5, session_memory = 6;

/// Runs `work` in a forked child and returns its result. The child's standard output goes to standard error. On return,
/// the child and every process that it started have ended. The memory limit applies to the address space of each
/// process, and to the total memory of all of them, which is checked ten times a second.
///   needs  : a process with a single thread, see worker.h.
///   hangup : a descriptor; the work is ended when its other end is closed, since nothing waits for the result then.
///   stays  : the work is a session that answers questions until its input ends. It receives the standard input and
///            output and descriptor 3 of this process as session_input, session_output and session_memory. Its time
///            limit is for one call.
///   throws : Error "who: ..." in one line with the place, if the work throws, crashes, ends the process or exceeds a
///            limit.
std::string run_isolated(const std::string& who, const ResourceLimits& limits, int hangup,
                         const std::function<std::string(CallMonitor&)>& work, bool stays = false);

} // namespace carlo
