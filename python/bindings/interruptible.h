#pragma once
/// Long work in C++ that Ctrl-C ends.

#include <atomic>
#include <functional>

namespace bindings {

/// Runs work() in another thread, without the interpreter's lock. Meanwhile handles signals: a KeyboardInterrupt sets
/// `cancel`. Returns whether one came. Call it with the lock held.
///   throws : the exceptions of work(), and of other signal handlers, after the end of the work.
bool run_interruptible(const std::function<void()>& work, std::atomic<bool>& cancel);

} // namespace bindings
