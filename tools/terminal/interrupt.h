#pragma once
/// Signals that ask carlo to end, as a flag.

#include <atomic>

namespace carlo {

/// Thrown where such a signal ends work.
struct Interrupted {};

/// During its lifetime, the signals that ask a program to end set a flag, so that its results are not lost:
///   SIGINT             : Ctrl-C. A second one ends the program immediately.
///   SIGTERM            : of timeout, kill and batch queues. A second one has no effect, since timeout sends two.
///   SIGHUP             : the terminal was closed. Later output to it goes to /dev/null instead of failing.
///   SIGUSR1, SIGXCPU   : of batch queues before their time limit.
/// A signal that is ignored when the lifetime begins, as SIGHUP under nohup, stays ignored.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  const std::atomic<bool>* flag() const { return &raised; }
  /// Number of the signal that set the flag; 0 if none did.
  static int signal() { return first_signal; }

 private:
  static void raise(int signal);

  static inline std::atomic<bool> raised = false;
  static inline std::atomic<int> first_signal = 0;
};

} // namespace carlo
