#pragma once
/// Code that is not ours, run in a process of its own.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace carlo {

/// What the foreign code is doing, in memory that both processes see, so that a crash or a hang can be placed.
class CallMonitor {
 public:
  static constexpr int max_arguments = 6;

  /// Around every call: enter before, leave after it. `function` and `argument` ("u", "x", "") are string literals.
  void enter(const char* function, const char* argument = "", const double* values = nullptr, int n = 0) {
    argument_ = argument;
    n_ = n;
    wanted_ = 0;
    for (int i = 0; i < n; ++i) values_[i] = values[i];
    function_.store(function, std::memory_order_relaxed);
  }
  /// Of an answer that comes in parts: how many of its numbers have come.
  void answered(std::size_t numbers, std::size_t wanted) {
    answered_ = numbers;
    wanted_ = wanted;
  }
  void leave() {
    function_.store(nullptr, std::memory_order_relaxed);
    calls_.store(calls_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  std::uint64_t calls() const { return calls_.load(std::memory_order_relaxed); }
  bool inside() const { return function_.load(std::memory_order_relaxed) != nullptr; }
  /// " in sample at u = (0.25, 0.5)", with ", where 2 of 3 numbers have come (doubles of 8 bytes)" where a part of the
  /// answer has; outside of any call " after 12 calls".
  std::string where() const;

 private:
  std::atomic<const char*> function_{nullptr};
  const char* argument_ = "";
  std::atomic<std::uint64_t> calls_{0};
  int n_ = 0;
  std::size_t answered_ = 0, wanted_ = 0;
  double values_[max_arguments] = {};
};

/// What foreign code may use before it is ended.
struct ResourceLimits {
  double seconds = 60;  ///< wall-clock
  double gigabytes = 4; ///< of 2^30 bytes, see run_isolated; not under a sanitizer, which reserves terabytes
  int files = 256;      ///< open at once
  std::string reduce_option = "--samples"; ///< the option of the command that makes the work smaller
};

/// Limits with what --timeout and --memory give, where they are given.
///   throws : Error where they mean nothing, and for either where no foreign code is there that it could limit
ResourceLimits resource_limits(std::optional<double> timeout, std::optional<double> memory, bool has_foreign_code);

/// Runs work in a forked child and returns what it returned. Its standard output goes to standard error. When it
/// returns, the child and every process that it started have ended. The limit of memory is one of the address space of
/// each process, and one of the memory that all of them hold together, looked at ten times a second.
///   needs  : a process with a single thread, see worker.h
///   hangup : a descriptor whose other end is open as long as anyone waits for the result; closed, the work is ended
///   throws : Error "who: ..." in one line when the work throws, crashes, ends the process or goes beyond a limit,
///            saying where
std::string run_isolated(const std::string& who, const ResourceLimits& limits, int hangup,
                         const std::function<std::string(CallMonitor&)>& work);

} // namespace carlo
