#include "interruptible.h"

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>

namespace bindings {

namespace py = pybind11;

bool run_interruptible(const std::function<void()>& work, std::atomic<bool>& cancel) {
  using namespace std::chrono_literals;
  bool interrupted = false;
  std::exception_ptr of_handler;
  std::future<void> done;
  {
    const py::gil_scoped_release release;
    done = std::async(std::launch::async, work);
    while (done.wait_for(20ms) != std::future_status::ready) {
      const py::gil_scoped_acquire lock;
      if (PyErr_CheckSignals() == 0) continue;
      cancel = true;
      if (PyErr_ExceptionMatches(PyExc_KeyboardInterrupt)) {
        PyErr_Clear();
        interrupted = true;
      } else of_handler = std::make_exception_ptr(py::error_already_set());
    }
  }
  if (of_handler) std::rethrow_exception(of_handler);
  done.get();
  return interrupted;
}

} // namespace bindings
