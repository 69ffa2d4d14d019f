#include <plugin/foreign_rows.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace carlo {

namespace {

constexpr std::size_t most_rows = 256; // of one question

// Shared memory of a session: the CPU seconds of the last answer, the arguments, the results.
struct SharedRows {
  std::span<double> memory;
  RowShape shape;

  static std::size_t numbers(const RowShape& shape) { return 1 + most_rows * (shape.in + shape.out); }
  double& seconds() const { return memory[0]; }
  std::span<double> arguments(std::size_t rows) const { return memory.subspan(1, rows * shape.in); }
  std::span<double> results(std::size_t rows) const {
    return memory.subspan(1 + most_rows * shape.in, rows * shape.out);
  }
};

} // namespace

ForeignRows::ForeignRows(const nlohmann::json& request, const RowShape& shape, const WorkerOptions& worker)
    : request_(std::make_shared<const nlohmann::json>(request)), shape_(shape), worker_(worker) {}

std::unique_ptr<Session> ForeignRows::idle_session() {
  const std::lock_guard lock(mutex_);
  if (idle_.empty()) return std::make_unique<Session>(*request_, SharedRows::numbers(shape_), worker_);
  std::unique_ptr<Session> session = std::move(idle_.back());
  idle_.pop_back();
  return session;
}

double ForeignRows::operator()(std::span<const double> arguments, std::span<double> results) {
  std::unique_ptr<Session> session = idle_session(); // destroyed if it throws
  const SharedRows shared{session->memory(), shape_};
  const std::size_t count = results.size() / shape_.out;
  double seconds = 0;
  for (std::size_t first = 0; first < count; first += most_rows) {
    const std::size_t rows = std::min(most_rows, count - first);
    std::ranges::copy(arguments.subspan(first * shape_.in, rows * shape_.in), shared.arguments(rows).begin());
    session->ask(rows);
    std::ranges::copy(shared.results(rows), results.begin() + static_cast<std::ptrdiff_t>(first * shape_.out));
    seconds += shared.seconds();
  }
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(session));
  return seconds;
}

void answer_rows(const nlohmann::json& request, CallMonitor& monitor, const RowShape& shape,
                 const std::function<void(std::span<const double> arguments, std::span<double> results)>& f,
                 const std::function<double()>& cpu_seconds) {
  double before = cpu_seconds();
  answer_questions(request, monitor, [&](std::uint64_t rows, std::span<double> memory) {
    const SharedRows shared{memory, shape};
    f(shared.arguments(rows), shared.results(rows));
    const double now = cpu_seconds();
    shared.seconds() = now - before;
    before = now;
  });
}

} // namespace carlo
