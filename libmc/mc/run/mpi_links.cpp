#include <mc/core/error.h>
#include <mc/run/mpi_links.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>

namespace mc::detail {

namespace {

constexpr double silent_at_most = 120;      // seconds
constexpr std::size_t most_bytes = 1 << 30; // counts of MPI are ints

void check(int code, int other) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  throw LostRank(fmt::format("no connection to rank {}: {}", other, text.data()));
}

// Whether a process of this host is gone, or a zombie whose parent has not asked for its end.
bool has_died(std::int64_t process) {
  if (kill(static_cast<pid_t>(process), 0) != 0) return errno == ESRCH;
  const std::string path = fmt::format("/proc/{}/stat", process);
  std::FILE* file = std::fopen(path.c_str(), "r");
  if (!file) return false;
  char state = 'R';
  const bool is_read = std::fscanf(file, "%*d (%*[^)]) %c", &state) == 1;
  std::fclose(file);
  return is_read && (state == 'Z' || state == 'X');
}

} // namespace

MpiLinks::MpiLinks(MPI_Comm communicator) {
  MPI_Comm_dup(communicator, &communicator_);
  MPI_Comm_set_errhandler(communicator_, MPI_ERRORS_RETURN);
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &size_);
  int provided = 0;
  MPI_Query_thread(&provided);
  require(provided >= MPI_THREAD_SERIALIZED, "MpiRanks: MPI was started without MPI_THREAD_SERIALIZED");
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  host_ = name.data();
  if (rank_ == 0) others_.resize(static_cast<std::size_t>(size_));
  else send(0, tag_hello, message_of(host_, std::int64_t{getpid()}));
}

MpiLinks::~MpiLinks() { MPI_Comm_free(&communicator_); }

void MpiLinks::send(int to, MpiTag tag, const std::string& bytes) {
  require(bytes.size() <= most_bytes, "MpiRanks: a message of {} bytes; at most {} are possible", bytes.size(),
          most_bytes);
  MPI_Request request = MPI_REQUEST_NULL;
  const auto count = static_cast<int>(bytes.size());
  check(MPI_Isend(bytes.data(), count, MPI_BYTE, to, tag, communicator_, &request), to);
  wait_for(request, to);
}

std::optional<MpiMessage> MpiLinks::receive() {
  int is_there = 0, count = 0;
  MPI_Status status;
  check(MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, communicator_, &is_there, &status), 0);
  if (!is_there) return {};
  MPI_Get_count(&status, MPI_BYTE, &count);
  MpiMessage m{status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(count), '\0')};
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Irecv(m.bytes.data(), count, MPI_BYTE, m.source, m.tag, communicator_, &request), m.source);
  try {
    wait_for(request, m.source); // for ever, if the source dies
  } catch (const LostRank&) {
    abandoned_.push_back(std::move(m.bytes));
    throw;
  }
  return m;
}

void MpiLinks::broadcast(std::string& bytes) {
  std::uint64_t size = bytes.size();
  broadcast(&size, sizeof size);
  bytes.resize(static_cast<std::size_t>(size));
  for (std::size_t done = 0; done < bytes.size(); done += most_bytes)
    broadcast(bytes.data() + done, std::min(most_bytes, bytes.size() - done));
}

std::string MpiLinks::name_of(int rank) const {
  const OtherRank& r = others_[static_cast<std::size_t>(rank)];
  return r.process == 0 ? fmt::format("rank {}", rank)
                        : fmt::format("rank {} (process {} on {})", rank, r.process, r.host);
}

void MpiLinks::require_alive(bool listens) {
  if (seconds_since(looked_) < 0.02) return;
  looked_ = Clock::now();
  for (int r = 1; r < size_; ++r) {
    const OtherRank& other = others_[static_cast<std::size_t>(r)];
    if (other.has_ended) continue;
    const bool is_here = other.process != 0 && other.host == host_;
    const bool is_dead = is_here && has_died(other.process);
    const bool is_silent = listens && seconds_since(std::max(other.heard, listens_since_)) > silent_at_most;
    if (!is_dead && !is_silent) continue;
    is_lost = true;
    throw LostRank(is_dead ? fmt::format("{} died", name_of(r))
                           : fmt::format("{} was silent for {} s", name_of(r), silent_at_most));
  }
}

// Sleeps until the end of an operation: MPI's own functions would take a processor while they wait.
void MpiLinks::wait_for(MPI_Request& request, int other) {
  Pause pause;
  for (int is_done = 0;; pause.wait()) {
    check(MPI_Test(&request, &is_done, MPI_STATUS_IGNORE), other);
    if (is_done) return;
    if (rank_ == 0) require_alive(false); // messages that say so may wait behind this one
  }
}

void MpiLinks::broadcast(void* bytes, std::size_t count) {
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Ibcast(bytes, static_cast<int>(count), MPI_BYTE, 0, communicator_, &request), 0);
  wait_for(request, 0);
}

} // namespace mc::detail
