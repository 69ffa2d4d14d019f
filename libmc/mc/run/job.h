#pragma once
/// Work in units, with the same bits for any number of threads, ranks and parts.

#include <mc/run/executor.h>

#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

namespace mc {

/// A sequence of stages. A stage is a number of units. A stage begins after all results of the stage before it were
/// absorbed, so it may depend on them, as a sampling plan depends on a pilot.
///   next_stage() : begins a stage and returns its number of units; 0 where the job is done, also if called again.
///   compute(i)   : result of unit i: a pure function of the job's input, the stage and i. Several threads call it at a
///                  time, so it reads nothing that absorb() changes. Returns nullopt only where it gave up because the
///                  run is cancelled.
///   absorb(i, r) : adds the result of unit i to the state. Called for i = 0, 1, 2, ... and by one thread at a time.
///                  Therefore the state has the same bits for any number of threads.
///   archive(a)   : the state between two calls of absorb(). See archive.h; results have an archive, too.
///   may_start()  : optional; false where no further unit of the stage may start, as after a time limit. The units that
///                  were started are absorbed, and the next stage begins.
///   archive_stage(a)    : optional; everything that compute() reads of the state. Default: archive(a).
///   skip(i)             : optional, with needs_results(); in place of absorb(): goes on without the result of unit i.
///   needs_results()     : whether the next stage depends on results of earlier units: a barrier between parts. Without
///                         skip(), every stage does. A job of which units were skipped has no result.
template <class J>
concept Job = requires(J& job, const J& fixed, std::size_t unit, typename J::Result result, ArchiveWriter& writer,
                       ArchiveReader& reader) {
  { job.next_stage() } -> std::convertible_to<std::size_t>;
  { fixed.compute(unit) } -> std::convertible_to<std::optional<typename J::Result>>;
  job.absorb(unit, std::move(result));
  job.archive(writer);
  job.archive(reader);
};

namespace detail {

/// A job that outlives the returned object, without its type.
template <Job J> AnyJob any_job(J& job, std::string name) {
  using Result = typename J::Result;
  AnyJob any;
  any.name = std::move(name);
  any.next_stage = [&job] { return static_cast<std::size_t>(job.next_stage()); };
  any.compute = [&job](std::size_t unit) -> AnyResult {
    std::optional<Result> result = std::as_const(job).compute(unit);
    return result ? std::make_shared<Result>(std::move(*result)) : nullptr;
  };
  any.absorb = [&job](std::size_t unit, const AnyResult& result) {
    job.absorb(unit, std::move(*static_cast<Result*>(result.get())));
  };
  any.may_start = any.needs_results = [] { return true; };
  if constexpr (requires { job.may_start(); }) any.may_start = [&job] { return bool(job.may_start()); };
  if constexpr (requires { job.needs_results(); }) any.needs_results = [&job] { return bool(job.needs_results()); };
  if constexpr (requires { job.skip(std::size_t{0}); }) any.skip = [&job](std::size_t unit) { job.skip(unit); };
  any.write_result = [](ArchiveWriter& a, const AnyResult& result) { a(*static_cast<const Result*>(result.get())); };
  any.read_result = [](ArchiveReader& a) -> AnyResult {
    auto result = std::make_shared<Result>();
    a(*result);
    return result;
  };
  any.write = [&job](ArchiveWriter& a) { a(job); };
  any.read = [&job](ArchiveReader& a) { a(job); };
  any.write_stage = any.write;
  any.read_stage = any.read;
  if constexpr (requires(ArchiveWriter & a) { job.archive_stage(a); }) {
    any.write_stage = [&job](ArchiveWriter& a) { job.archive_stage(a); };
    any.read_stage = [&job](ArchiveReader& a) { job.archive_stage(a); };
  }
  return any;
}

// A job without units, whose state is a value.
template <class T> struct ValueJob {
  using Result = bool;
  T& value;
  std::size_t next_stage() { return 0; }
  std::optional<bool> compute(std::size_t) const { return true; }
  void absorb(std::size_t, bool) {}
  template <class Archive> void archive(Archive& a) { a(value); }
};

} // namespace detail

/// Runs a job to its end, or until it is cancelled. With a checkpoint, goes on from the state of the file; saves the
/// state when it is due, at a cancellation, and at the end of a run that is not within another section. Returns whether
/// the job is done. When cancelled, the job has absorbed every result, in order, but some in between may be missing.
///   throws : the first exception of the job.
template <Job J> bool run_job(J& job, const RunOptions& options) {
  const AnyJob any = detail::any_job(job, options.name);
  return options.executor ? options.executor(any, options) : run_on_threads(any, options);
}

/// A value of the first rank, which all ranks get. For decisions by a clock, which must be the same everywhere.
template <class T> T shared_value(T value, const Executor& executor) {
  detail::ValueJob<T> job{value};
  run_job(job, {.executor = executor, .name = "value"});
  return value;
}

} // namespace mc
