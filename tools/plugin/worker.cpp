#include <plugin/worker.h>
#include <process/child.h>

#include <mc/core/error.h>

#include <nlohmann/json.hpp>

#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>
#include <vector>

namespace carlo {

using nlohmann::json;

namespace {

using Bytes = std::vector<std::uint8_t>;

bool send(int file, const json& message) {
  const Bytes bytes = json::to_cbor(message);
  const std::uint64_t size = bytes.size();
  return write_all(file, &size, sizeof size) && write_all(file, bytes.data(), bytes.size());
}

// Appends the available bytes. Returns false at the end of the file.
bool read_some(int file, Bytes& bytes) {
  std::uint8_t buffer[1 << 16];
  const ssize_t n = read(file, buffer, sizeof buffer);
  if (n > 0) bytes.insert(bytes.end(), buffer, buffer + n);
  return n > 0 || (n < 0 && errno == EINTR);
}

bool read_exactly(int file, void* to, std::size_t size) {
  for (std::size_t got = 0; got < size;) {
    const ssize_t n = read(file, static_cast<char*>(to) + got, size - got);
    if (n == 0 || (n < 0 && errno != EINTR)) return false;
    if (n > 0) got += static_cast<std::size_t>(n);
  }
  return true;
}

bool is_whole(const Bytes& bytes) {
  std::uint64_t size = 0;
  if (bytes.size() < sizeof size) return false;
  std::memcpy(&size, bytes.data(), sizeof size);
  return bytes.size() - sizeof size >= size;
}

json message_in(const Bytes& bytes) {
  return json::from_cbor(bytes.begin() + static_cast<std::ptrdiff_t>(sizeof(std::uint64_t)), bytes.end());
}

} // namespace

namespace {

constexpr std::uint64_t answered = ~std::uint64_t{0}; // no length of a message

json with_limits(json request, const ResourceLimits& limits) {
  request["limits"] = {{"seconds", limits.seconds},
                       {"gigabytes", limits.gigabytes},
                       {"files", limits.files},
                       {"less", limits.reduce_option}};
  return request;
}

[[noreturn]] void complain(const std::string& who, ChildProcess& worker) {
  const int code = worker.wait();
  throw mc::Error(fmt::format("{}: the process that runs it ended with code {} and no answer", who, code));
}

} // namespace

json call_worker(json request, const WorkerOptions& options) {
  ChildProcess worker({{options.program, "worker"}});
  send(worker.input(), with_limits(request, options.limits));
  Bytes answer;
  bool cancelled = false;
  for (bool open = true; open && !is_whole(answer);) {
    if (!cancelled && options.cancel && *options.cancel) {
      cancelled = true;
      worker.close_input(); // the worker then ends its processes and exits
    }
    pollfd p{worker.output(), POLLIN, 0};
    if (poll(&p, 1, 50) > 0) open = read_some(worker.output(), answer);
  }
  if (cancelled) {
    worker.wait();
    throw Interrupted{};
  }
  if (!is_whole(answer)) complain(request["who"], worker);
  json message = message_in(answer);
  if (message.contains("error")) throw mc::Error(message["error"].get<std::string>());
  return std::move(message["result"]);
}

SharedNumbers::SharedNumbers(const std::string& who, std::size_t count)
    : count_(count), file_(memfd_create("session", MFD_CLOEXEC)) {
  const std::size_t bytes = count * sizeof(double);
  const bool sized = file_ >= 0 && ftruncate(file_, static_cast<off_t>(bytes)) == 0;
  void* const at = sized ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0) : MAP_FAILED;
  const int reason = errno;
  if (at == MAP_FAILED && file_ >= 0) close(file_);
  mc::require(at != MAP_FAILED, "{}: no shared memory: {}", who, std::strerror(reason));
  numbers_ = static_cast<double*>(at);
}

SharedNumbers::~SharedNumbers() {
  munmap(numbers_, count_ * sizeof(double));
  close(file_);
}

Session::Session(json request, std::size_t numbers, const WorkerOptions& options)
    : who_(request["who"]), memory_(who_, numbers),
      worker_(LaunchOptions{.arguments = {options.program, "worker"}, .shared = memory_.file()}) {
  request["session"] = numbers;
  send(worker_.input(), with_limits(request, options.limits));
}

// The worker ends its processes when its input closes.
Session::~Session() {
  worker_.close_input();
  worker_.wait();
}

void Session::ask(std::uint64_t question) {
  write_all(worker_.input(), &question, sizeof question); // a worker that has ended has left a message
  Bytes answer;
  std::uint64_t first = 0;
  do {
    if (!read_some(worker_.output(), answer)) complain(who_, worker_);
    if (answer.size() >= sizeof first) std::memcpy(&first, answer.data(), sizeof first);
  } while (first != answered && !is_whole(answer));
  if (first == answered) return;
  const json message = message_in(answer);
  throw mc::Error(message.contains("error") ? message["error"].get<std::string>()
                                            : fmt::format("{}: it ended before its input", who_));
}

void answer_questions(const json& request, CallMonitor& monitor,
                      const std::function<void(std::uint64_t question, std::span<double> memory)>& answer) {
  const std::size_t numbers = request["session"];
  void* const at = mmap(nullptr, numbers * sizeof(double), PROT_READ | PROT_WRITE, MAP_SHARED, session_memory, 0);
  mc::require(at != MAP_FAILED, "no shared memory: {}", std::strerror(errno));
  for (;;) {
    std::uint64_t question = 0;
    monitor.set_idle(true);
    if (!read_exactly(session_input, &question, sizeof question)) return;
    monitor.set_idle(false);
    answer(question, {static_cast<double*>(at), numbers});
    if (!write_all(session_output, &answered, sizeof answered)) return;
  }
}

void serve(json (*run)(const json& request, CallMonitor& monitor)) {
  // Exactly one message: the first question of a session may follow it.
  std::uint64_t size = 0;
  Bytes bytes;
  bool has_request = read_exactly(STDIN_FILENO, &size, sizeof size) && size < (1u << 30);
  if (has_request) {
    bytes.resize(size);
    has_request = read_exactly(STDIN_FILENO, bytes.data(), size);
  }
  mc::require(has_request, "worker: only carlo itself starts this subcommand");
  const json request = json::from_cbor(bytes);
  const json& l = request["limits"];
  const ResourceLimits limits{l["seconds"], l["gigabytes"], l["files"], l["less"]};
  const std::string who = request["who"];
  json answer;
  try {
    const auto work = [&](CallMonitor& monitor) {
      const Bytes cbor = json::to_cbor(run(request, monitor));
      return std::string(cbor.begin(), cbor.end());
    };
    const std::string result = run_isolated(who, limits, STDIN_FILENO, work, request.contains("session"));
    answer["result"] = json::from_cbor(result);
  } catch (const std::exception& e) {
    answer["error"] = e.what();
  }
  send(STDOUT_FILENO, answer);
}

} // namespace carlo
