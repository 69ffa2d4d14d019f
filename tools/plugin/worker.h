#pragma once
/// Requests to a separate process that runs external code. The process is another instance of carlo.
///
/// carlo, which has several threads, starts `carlo worker` with posix_spawn, so that none of its code runs between fork
/// and exec. It writes one request to the worker's input and reads one answer from its output. The worker has a single
/// thread, so that it may fork. It runs the external code in a child under limits, and ends every process that the code
/// started, see run_isolated.h. If carlo itself is killed, the worker's input closes, and the worker ends these
/// processes as well.
///
/// A session is a worker that stays: after the request it answers questions until its input closes. Their numbers are
/// in memory that carlo and the worker's child share. A question and its answer are numbers of 8 bytes in the pipes.
///
/// Both messages are CBOR preceded by their length, 8 bytes in the byte order of the machine:
///   request : {"task": NAME, "who": prefix of errors, "limits": {...}, and further fields of the task}.
///   answer  : {"result": ...} or {"error": one line}.

#include <plugin/run_isolated.h>
#include <process/child.h>
#include <terminal/interrupt.h>

#include <nlohmann/json_fwd.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace carlo {

/// Settings for running external code.
struct WorkerOptions {
  ResourceLimits limits;
  std::string program = "/proc/self/exe";    ///< a carlo executable
  const std::atomic<bool>* cancel = nullptr; ///< when it becomes true, call_worker throws Interrupted
};

/// The result of the request, to which `limits` are added.
///   throws : Error with the worker's message, Interrupted.
nlohmann::json call_worker(nlohmann::json request, const WorkerOptions& options);

/// Numbers in memory that processes share by a file.
class SharedNumbers {
 public:
  /// `who` begins the message.
  ///   throws : Error where the system refuses the memory.
  SharedNumbers(const std::string& who, std::size_t count);
  ~SharedNumbers();
  SharedNumbers(const SharedNumbers&) = delete;
  SharedNumbers& operator=(const SharedNumbers&) = delete;

  std::span<double> numbers() { return {numbers_, count_}; }
  int file() const { return file_; }

 private:
  std::size_t count_;
  int file_;
  double* numbers_ = nullptr;
};

/// A worker that answers questions. The task of its request calls answer_questions.
class Session {
 public:
  /// `numbers`: length of the shared memory.
  Session(nlohmann::json request, std::size_t numbers, const WorkerOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  std::span<double> memory() { return memory_.numbers(); }
  /// Asks about the contents of the memory, and returns when the answer is there.
  ///   throws : Error with the worker's message; no later question is allowed.
  void ask(std::uint64_t question);

 private:
  std::string who_;
  SharedNumbers memory_;
  ChildProcess worker_;
};

/// In the child of a session: calls answer(question, memory) for each question until the input ends.
void answer_questions(const nlohmann::json& request, CallMonitor& monitor,
                      const std::function<void(std::uint64_t question, std::span<double> memory)>& answer);

/// Reads a request from standard input, answers it with `run` in a child, and writes the answer to standard output.
void serve(nlohmann::json (*run)(const nlohmann::json& request, CallMonitor& monitor));

} // namespace carlo
