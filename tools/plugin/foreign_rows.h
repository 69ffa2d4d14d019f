#pragma once
/// A function of rows of numbers that external code evaluates in sessions, see worker.h.

#include <plugin/worker.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace carlo {

/// Numbers in one row of the arguments and of the results.
struct RowShape {
  std::size_t in, out;
};

/// carlo's side.
class ForeignRows {
 public:
  /// The task of the request calls answer_rows.
  ForeignRows(const nlohmann::json& request, const RowShape& shape, const WorkerOptions& worker);

  /// Fills one row of `results` for each row of `arguments`. Returns the CPU seconds of the external code. Concurrent
  /// calls use separate processes.
  ///   throws : Error as run_isolated.
  double operator()(std::span<const double> arguments, std::span<double> results);

 private:
  std::unique_ptr<Session> idle_session();

  std::shared_ptr<const nlohmann::json> request_;
  RowShape shape_;
  WorkerOptions worker_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Session>> idle_;
};

/// The child's side: evaluates f(arguments, results) for each question.
///   cpu_seconds : the CPU seconds of the external code so far.
void answer_rows(const nlohmann::json& request, CallMonitor& monitor, const RowShape& shape,
                 const std::function<void(std::span<const double> arguments, std::span<double> results)>& f,
                 const std::function<double()>& cpu_seconds);

} // namespace carlo
