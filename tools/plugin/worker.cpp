#include <plugin/worker.h>
#include <process/child.h>

#include <mc/core/error.h>

#include <nlohmann/json.hpp>

#include <poll.h>
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

json call_worker(json request, const WorkerOptions& options) {
  const ResourceLimits& limits = options.limits;
  request["limits"] = {{"seconds", limits.seconds},
                       {"gigabytes", limits.gigabytes},
                       {"files", limits.files},
                       {"less", limits.reduce_option}};
  ChildProcess worker({{options.program, "worker"}});
  send(worker.input(), request);
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
  if (!is_whole(answer)) {
    const int code = worker.wait();
    throw mc::Error(fmt::format("{}: the process that runs it ended with code {} and no answer",
                                request["who"].get<std::string>(), code));
  }
  json message = message_in(answer);
  if (message.contains("error")) throw mc::Error(message["error"].get<std::string>());
  return std::move(message["result"]);
}

void serve(json (*run)(const json& request, CallMonitor& monitor)) {
  Bytes bytes;
  while (!is_whole(bytes))
    if (!read_some(STDIN_FILENO, bytes)) throw mc::Error("worker: only carlo itself starts this subcommand");
  const json request = message_in(bytes);
  const json& l = request["limits"];
  const ResourceLimits limits{l["seconds"], l["gigabytes"], l["files"], l["less"]};
  const std::string who = request["who"];
  json answer;
  try {
    const std::string result = run_isolated(who, limits, STDIN_FILENO, [&](CallMonitor& monitor) {
      const Bytes cbor = json::to_cbor(run(request, monitor));
      return std::string(cbor.begin(), cbor.end());
    });
    answer["result"] = json::from_cbor(result);
  } catch (const std::exception& e) {
    answer["error"] = e.what();
  }
  send(STDOUT_FILENO, answer);
}

} // namespace carlo
