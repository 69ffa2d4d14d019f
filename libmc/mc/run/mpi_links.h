#pragma once
/// Messages between the ranks of MPI, and whether the other ranks live. Only in builds with MC_MPI.

#include <mc/run/archive.h>
#include <mc/run/executor.h>

#include <mpi.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace mc::detail {

/// Kinds of messages.
enum MpiTag : int {
  tag_hello,   ///< To rank 0: host and process.
  tag_request, ///< To rank 0: job and wanted number of units.
  tag_result,  ///< To rank 0: results of units.
  tag_failure, ///< To rank 0: why a unit or the rank failed.
  tag_alive,   ///< To rank 0: no more than that.
  tag_bye,     ///< To rank 0: the last message of a rank.
  tag_reply    ///< Of rank 0 to a request.
};

/// A message that arrived.
struct MpiMessage {
  int source;        ///< Rank of the sender.
  int tag;           ///< An MpiTag.
  std::string bytes; ///< Content.
};

/// Sleeps between looks for messages: short at first, so that messages do not wait, and longer while there are none.
class Pause {
 public:
  /// Begins anew with a short sleep.
  void reset() { pause_ = shortest; }
  /// Sleeps.
  void wait() {
    std::this_thread::sleep_for(pause_);
    pause_ = std::min(2 * pause_, longest);
  }

 private:
  using Time = std::chrono::microseconds;
  static constexpr Time shortest{20}, longest{1000};
  Time pause_ = shortest;
};

/// Messages of one rank. Every message is a string of bytes. One thread at a time may use it.
///   throws : LostRank where another rank died on this host, or MPI has no connection to it.
class MpiLinks {
 public:
  using Clock = std::chrono::steady_clock;

  /// Collective. The communicator must outlive this.
  explicit MpiLinks(MPI_Comm communicator);
  ~MpiLinks();
  MpiLinks(const MpiLinks&) = delete;
  MpiLinks& operator=(const MpiLinks&) = delete;

  /// Number of this process in the communicator.
  int rank() const { return rank_; }
  /// Number of processes.
  int size() const { return size_; }

  /// Sends a message, and waits until it left.
  void send(int to, MpiTag tag, const std::string& bytes);
  /// The next message, if one arrived.
  std::optional<MpiMessage> receive();
  /// Bytes of rank 0 to all ranks. Every rank calls it.
  void broadcast(std::string& bytes);

  /// State of another rank, on rank 0.
  struct OtherRank {
    std::string host, job;                  ///< Host, and "number name" of the job of its request.
    std::int64_t process = 0;               ///< 0: no hello yet.
    std::uint64_t wanted = 0;               ///< Units of a request that is not answered; 0: none.
    std::set<std::size_t> units{};          ///< Units that it computes.
    bool has_ended = false;                 ///< Whether its last message has come.
    Clock::time_point heard = Clock::now(); ///< Time of its last message.
  };
  /// The ranks, by their numbers; empty on other ranks than 0.
  std::vector<OtherRank>& others() { return others_; }
  /// "rank 3 (process 1234 on node7)"
  std::string name_of(int rank) const;

  /// Begins to wait for messages of other ranks; before it, they waited for this rank.
  void listen() { listens_since_ = Clock::now(); }
  /// Throws LostRank for a rank that died on this host, or that was silent for long while this rank listened.
  void require_alive(bool listens = true);

  std::uint64_t jobs = 0; ///< Number of jobs so far.
  bool is_lost = false;   ///< Whether a rank died.

 private:
  void wait_for(MPI_Request& request, int other);
  void broadcast(void* bytes, std::size_t count);

  MPI_Comm communicator_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  std::string host_;
  std::vector<OtherRank> others_;
  std::vector<std::string> abandoned_; ///< Messages of ranks that died; MPI may still write to them.
  Clock::time_point looked_ = Clock::now(), listens_since_ = looked_;
};

/// Values as the bytes of a message.
template <class... T> std::string message_of(const T&... values) {
  ArchiveWriter writer;
  writer(values...);
  return writer.take();
}

/// Seconds since a time.
inline double seconds_since(MpiLinks::Clock::time_point t) {
  return std::chrono::duration<double>(MpiLinks::Clock::now() - t).count();
}

} // namespace mc::detail
