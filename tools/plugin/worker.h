#pragma once
/// Requests to a separate process that runs external code. The process is another instance of carlo.
///
/// carlo, which has several threads, starts `carlo worker` with posix_spawn, so that none of its code runs between fork
/// and exec. It writes one request to the worker's input and reads one answer from its output. The worker has a single
/// thread, so that it may fork. It runs the external code in a child under limits, and ends every process that the code
/// started, see run_isolated.h. If carlo itself is killed, the worker's input closes, and the worker ends these
/// processes as well.
///
/// Both messages are CBOR preceded by their length, 8 bytes in the byte order of the machine:
///   request : {"task": NAME, "who": prefix of errors, "limits": {...}, and further fields of the task}.
///   answer  : {"result": ...} or {"error": one line}.

#include <plugin/run_isolated.h>

#include <nlohmann/json_fwd.hpp>

#include <atomic>
#include <string>

namespace carlo {

/// Settings for running external code.
struct WorkerOptions {
  ResourceLimits limits;
  std::string program = "/proc/self/exe";    ///< a carlo executable
  const std::atomic<bool>* cancel = nullptr; ///< when it becomes true, call_worker throws Interrupted
};

/// Thrown when WorkerOptions::cancel ended the work.
struct Interrupted {};

/// The result of the request, to which `limits` are added.
///   throws : Error with the worker's message, Interrupted.
nlohmann::json call_worker(nlohmann::json request, const WorkerOptions& options);

/// Reads a request from standard input, answers it with `run` in a child, and writes the answer to standard output.
void serve(nlohmann::json (*run)(const nlohmann::json& request, CallMonitor& monitor));

} // namespace carlo
