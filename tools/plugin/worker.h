#pragma once
/// Requests to a process of its own that runs foreign code, which this carlo is the program of too.
///
/// carlo, with its threads, starts `carlo worker` (posix_spawn: nothing of ours runs between fork and exec), writes one
/// request to its input and reads one answer from its output. The worker has a single thread, so that it may fork: it
/// runs the foreign code in a child under limits, and ends every process that came of it, see run_isolated.h. Should carlo
/// itself be killed, the worker's input closes, and it does the same.
///
/// Both messages are CBOR behind their length, 8 bytes in this machine's order:
///   request : {"task": NAME, "who": what errors begin with, "limits": {...}, and what the task takes}
///   answer  : {"result": ...} or {"error": one line}

#include <plugin/run_isolated.h>

#include <nlohmann/json_fwd.hpp>

#include <atomic>
#include <string>

namespace carlo {

/// How foreign code is run.
struct WorkerOptions {
  ResourceLimits limits;
  std::string program = "/proc/self/exe";    ///< a carlo
  const std::atomic<bool>* cancel = nullptr; ///< set: call_worker throws Interrupted
};

/// The work was given up because of WorkerOptions::cancel.
struct Interrupted {};

/// The result of the request, to which `limits` are added.
///   throws : Error with the worker's line, Interrupted
nlohmann::json call_worker(nlohmann::json request, const WorkerOptions& options);

/// Reads a request from standard input, has `run` answer it in a child, and writes the answer to standard output.
void serve(nlohmann::json (*run)(const nlohmann::json& request, CallMonitor& monitor));

} // namespace carlo
