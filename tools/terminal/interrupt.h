#pragma once
/// Ctrl-C as a flag.

#include <atomic>
#include <csignal>

namespace carlo {

/// Turns Ctrl-C into a flag while it lives; a second Ctrl-C ends the program at once.
class Interrupt {
 public:
  Interrupt()
      : old_(std::signal(SIGINT, [](int) {
          raised_ = true;
          std::signal(SIGINT, SIG_DFL);
        })) {
    raised_ = false;
  }
  ~Interrupt() { std::signal(SIGINT, old_); }
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  const std::atomic<bool>* flag() const { return &raised_; }

 private:
  static inline std::atomic<bool> raised_ = false;
  void (*old_)(int);
};

} // namespace carlo
