#pragma once
/// Ctrl-C and SIGTERM as a flag.

#include <atomic>
#include <csignal>

namespace carlo {

/// During its lifetime, Ctrl-C (SIGINT) and the SIGTERM of timeout and batch queues set a flag. A second Ctrl-C ends
/// the program immediately. A second SIGTERM has no effect, since timeout sends two.
class Interrupt {
 public:
  Interrupt() : old_interrupt_(std::signal(SIGINT, raise)), old_terminate_(std::signal(SIGTERM, raise)) {
    raised_ = terminated_ = false;
  }
  ~Interrupt() {
    std::signal(SIGINT, old_interrupt_);
    std::signal(SIGTERM, old_terminate_);
  }
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  const std::atomic<bool>* flag() const { return &raised_; }
  /// Whether SIGTERM set the flag.
  static bool is_terminated() { return terminated_; }

 private:
  static void raise(int signal) {
    if (!raised_) terminated_ = signal == SIGTERM;
    raised_ = true;
    std::signal(SIGINT, SIG_DFL);
  }

  static inline std::atomic<bool> raised_ = false, terminated_ = false;
  void (*old_interrupt_)(int);
  void (*old_terminate_)(int);
};

} // namespace carlo
