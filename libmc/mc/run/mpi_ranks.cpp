#include <mc/core/error.h>
#include <mc/run/mpi_ranks.h>
#include <mc/run/work_on_threads.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <deque>
#include <set>
#include <thread>
#include <vector>

namespace mc {

namespace {

using Clock = std::chrono::steady_clock;

enum Tag : int {
  tag_hello,   // to rank 0: host and process
  tag_request, // to rank 0: job and wanted number of units
  tag_result,  // to rank 0: results of units
  tag_failure, // to rank 0: why a unit or the rank failed
  tag_alive,   // to rank 0: no more than that
  tag_bye,     // to rank 0: the last message of a rank
  tag_reply    // of rank 0 to a request
};

enum class Reply : std::uint8_t { units, stage, end, failure, stop };

constexpr double alive_every = 5, silent_at_most = 120, finish_within = 10; // seconds
// Units that a rank asks for: so many for each thread that it never waits for rank 0, and so few that it ends with the
// others.
constexpr std::size_t least_ahead = 2, most_ahead = 32;
constexpr double seconds_ahead = 0.05;

double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

// Sleeps between looks for messages: short at first, so that messages do not wait, and longer while there are none.
class Pause {
 public:
  void reset() { pause_ = shortest; }
  void wait() {
    std::this_thread::sleep_for(pause_);
    pause_ = std::min(2 * pause_, longest);
  }

 private:
  using Time = std::chrono::microseconds;
  static constexpr Time shortest{20}, longest{1000};
  Time pause_ = shortest;
};

template <class... T> std::string packed(const T&... values) {
  ArchiveWriter writer;
  writer(values...);
  return writer.take();
}

struct Message {
  int source, tag;
  std::string bytes;
};

} // namespace

/// Messages of one rank. Every message is a string of bytes.
class MpiRanks::Links {
 public:
  explicit Links(MPI_Comm communicator) {
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
    else send(0, tag_hello, packed(host_, std::int64_t{getpid()}));
  }
  ~Links() { MPI_Comm_free(&communicator_); }
  Links(const Links&) = delete;
  Links& operator=(const Links&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  void send(int to, Tag tag, const std::string& bytes) {
    require(bytes.size() <= most_bytes, "MpiRanks: a message of {} bytes; at most {} are possible", bytes.size(),
            most_bytes);
    MPI_Request request = MPI_REQUEST_NULL;
    const auto count = static_cast<int>(bytes.size());
    check(MPI_Isend(bytes.data(), count, MPI_BYTE, to, tag, communicator_, &request), to);
    wait_for(request, to);
  }

  std::optional<Message> receive() {
    int is_there = 0, count = 0;
    MPI_Status status;
    check(MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, communicator_, &is_there, &status), 0);
    if (!is_there) return {};
    MPI_Get_count(&status, MPI_BYTE, &count);
    Message m{status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(count), '\0')};
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Irecv(m.bytes.data(), count, MPI_BYTE, m.source, m.tag, communicator_, &request), m.source);
    try {
      wait_for(request, m.source); // for ever, if the source dies
    } catch (const LostRank&) {
      abandoned_.push_back(std::move(m.bytes)); // MPI may still write to it
      throw;
    }
    return m;
  }

  // Bytes of rank 0 to all ranks. Every rank calls it.
  void broadcast(std::string& bytes) {
    std::uint64_t size = bytes.size();
    broadcast(&size, sizeof size);
    bytes.resize(static_cast<std::size_t>(size));
    for (std::size_t done = 0; done < bytes.size(); done += most_bytes)
      broadcast(bytes.data() + done, std::min(most_bytes, bytes.size() - done));
  }

  // State of another rank, on rank 0.
  struct OtherRank {
    std::string host, job;         // job: "number name" of its request
    std::int64_t process = 0;      // 0: no hello yet
    std::uint64_t wanted = 0;      // units of a request that is not answered; 0: none
    std::set<std::size_t> units{}; // that it computes
    bool has_ended = false;
    Clock::time_point heard = Clock::now();
  };

  std::string name_of(int rank) const {
    const OtherRank& r = others_[static_cast<std::size_t>(rank)];
    return r.process == 0 ? fmt::format("rank {}", rank)
                          : fmt::format("rank {} (process {} on {})", rank, r.process, r.host);
  }

  // Begins to wait for messages of other ranks; before it, they waited for this rank.
  void listen() { listens_since_ = Clock::now(); }
  // Throws LostRank for a rank that died on this host, or that was silent for long while this rank listened.
  void require_alive(bool listens = true) {
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

  std::vector<OtherRank>& others() { return others_; }
  std::uint64_t jobs = 0; // so far
  bool is_lost = false;   // whether a rank died

 private:
  static constexpr std::size_t most_bytes = 1 << 30; // counts of MPI are ints

  // Sleeps until the end of an operation: MPI's own functions would take a processor while they wait.
  void wait_for(MPI_Request& request, int other) {
    Pause pause;
    for (int is_done = 0;; pause.wait()) {
      check(MPI_Test(&request, &is_done, MPI_STATUS_IGNORE), other);
      if (is_done) return;
      if (rank_ == 0) require_alive(false); // messages that say so may wait behind this one
    }
  }
  void broadcast(void* bytes, std::size_t count) {
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Ibcast(bytes, static_cast<int>(count), MPI_BYTE, 0, communicator_, &request), 0);
    wait_for(request, 0);
  }
  void check(int code, int other) const {
    if (code == MPI_SUCCESS) return;
    std::array<char, MPI_MAX_ERROR_STRING> text{};
    int length = 0;
    MPI_Error_string(code, text.data(), &length);
    throw LostRank(fmt::format("no connection to rank {}: {}", other, text.data()));
  }
  // Whether a process of this host is gone, or a zombie whose parent has not asked for its end.
  static bool has_died(std::int64_t process) {
    if (kill(static_cast<pid_t>(process), 0) != 0) return errno == ESRCH;
    const std::string path = fmt::format("/proc/{}/stat", process);
    std::FILE* file = std::fopen(path.c_str(), "r");
    if (!file) return false;
    char state = 'R';
    const bool is_read = std::fscanf(file, "%*d (%*[^)]) %c", &state) == 1;
    std::fclose(file);
    return is_read && (state == 'Z' || state == 'X');
  }

  MPI_Comm communicator_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  std::string host_;
  std::vector<OtherRank> others_;
  std::vector<std::string> abandoned_;
  Clock::time_point looked_ = Clock::now(), listens_since_ = looked_;
};

/// A job on rank 0.
class MpiRanks::First {
 public:
  First(Links& links, const AnyJob& job, const RunOptions& options)
      : links_(links), job_(job), options_(options), title_(fmt::format("{} {}", ++links.jobs, job.name)) {}

  bool run() {
    bool is_done = false;
    try {
      is_done = detail::run_stages(job_, options_, [this](detail::UnitQueue& queue) { run_stage(queue); });
    } catch (const LostRank&) {
      throw;
    } catch (const Error& e) {
      end(Reply::failure, e.what());
      throw;
    }
    ArchiveWriter writer;
    writer(is_done);
    job_.write(writer);
    end(Reply::end, writer.take());
    return is_done;
  }

 private:
  void run_stage(detail::UnitQueue& queue) {
    wait_for_requests();
    if (queue.is_cancelled()) return;
    ArchiveWriter writer;
    job_.write_stage(writer);
    answer_all(Reply::stage, writer.take());
    const std::size_t workers = std::min(static_cast<std::size_t>(detail::threads_of(options_)), queue.left());
    queue.open(workers * static_cast<std::size_t>(links_.size()));
    std::exception_ptr failure, failure_of_messages;
    is_own_work_done_ = false;
    {
      const std::jthread messages([&] {
        try {
          serve(queue);
        } catch (...) {
          failure_of_messages = std::current_exception();
          queue.close();
        }
      });
      try {
        detail::work_on_threads(job_, options_.threads, workers, queue);
      } catch (...) {
        failure = std::current_exception();
      }
      is_own_work_done_ = true;
    }
    if (!failure) failure = failure_of_messages;
    if (!failure) return;
    if (options_.checkpoint && !queue.has_failed()) options_.checkpoint->save_and_wait();
    std::rethrow_exception(failure);
  }

  // Answers requests until no unit is left, and every rank has delivered its own.
  void serve(detail::UnitQueue& queue) {
    Pause pause;
    for (;;) {
      while (const std::optional<Message> m = links_.receive()) {
        handle(*m, &queue);
        pause.reset();
      }
      bool is_waiting = false;
      for (int r = 1; r < links_.size(); ++r) {
        if (other_rank(r).wanted > 0) give_units(queue, r);
        is_waiting = is_waiting || !other_rank(r).units.empty();
      }
      // After a cancellation, the state is saved before the others have answered.
      if (is_own_work_done_ && (queue.is_cancelled() || (queue.is_over() && !is_waiting))) return;
      links_.require_alive();
      pause.wait();
    }
  }

  void give_units(detail::UnitQueue& queue, int r) {
    Links::OtherRank& other = other_rank(r);
    std::vector<std::uint64_t> units;
    while (units.size() < other.wanted) {
      const std::optional<std::size_t> unit = queue.try_take();
      if (!unit) break;
      units.push_back(*unit);
      other.units.insert(*unit);
    }
    if (units.empty()) return;
    other.wanted = 0;
    links_.send(r, tag_reply, packed(Reply::units, units));
  }

  // A message; results only during a stage.
  void handle(const Message& m, detail::UnitQueue* queue) {
    Links::OtherRank& other = other_rank(m.source);
    other.heard = Clock::now();
    ArchiveReader reader(m.bytes);
    if (m.tag == tag_hello) reader(other.host, other.process);
    other.has_ended = other.has_ended || m.tag == tag_bye;
    if (is_ending_) {
      if (m.tag == tag_request) reader(other.job, other.wanted);
      return;
    }
    if (m.tag == tag_bye) {
      throw Error(fmt::format("{} ended before the work was done", links_.name_of(m.source)));
    }
    if (m.tag == tag_failure) {
      std::string reason;
      bool is_of_unit = false;
      reader(is_of_unit, reason);
      throw Error(is_of_unit ? reason : fmt::format("{}: {}", links_.name_of(m.source), reason));
    }
    if (m.tag == tag_request) {
      reader(other.job, other.wanted);
      require(other.job == title_, "{} runs the job '{}', and rank 0 the job '{}': the ranks have different inputs",
              links_.name_of(m.source), other.job, title_);
    }
    if (m.tag != tag_result) return;
    std::uint64_t results = 0, unit = 0;
    bool has_result = false;
    reader(results);
    for (std::uint64_t i = 0; i < results; ++i) {
      reader(unit, has_result);
      other.units.erase(static_cast<std::size_t>(unit));
      AnyResult result = has_result ? job_.read_result(reader) : nullptr;
      if (queue) queue->deliver(static_cast<std::size_t>(unit), std::move(result));
    }
  }

  // Waits until every rank asks for more.
  void wait_for_requests() {
    Pause pause;
    links_.listen();
    const auto has_asked = [](const Links::OtherRank& r) { return r.wanted > 0 || r.has_ended; };
    while (!std::all_of(links_.others().begin() + 1, links_.others().end(), has_asked)) {
      const std::optional<Message> m = links_.receive();
      if (m) handle(*m, nullptr);
      else {
        links_.require_alive();
        pause.wait();
      }
    }
  }

  void answer_all(Reply reply, std::string bytes) {
    for (int r = 1; r < links_.size(); ++r) {
      links_.send(r, tag_reply, packed(reply));
      other_rank(r).wanted = 0;
      other_rank(r).units.clear();
    }
    links_.broadcast(bytes);
  }

  // Ends the job on all ranks. Where one has left the program, finish() ends the others.
  void end(Reply reply, std::string bytes) {
    is_ending_ = true;
    wait_for_requests();
    const auto has_ended = [](const Links::OtherRank& r) { return r.has_ended; };
    if (std::none_of(links_.others().begin(), links_.others().end(), has_ended)) answer_all(reply, std::move(bytes));
  }

  Links::OtherRank& other_rank(int r) { return links_.others()[static_cast<std::size_t>(r)]; }

  Links& links_;
  const AnyJob& job_;
  const RunOptions& options_;
  std::string title_;
  std::atomic<bool> is_own_work_done_ = false;
  bool is_ending_ = false;
};

/// A job on another rank.
class MpiRanks::Other {
 public:
  Other(Links& links, const AnyJob& job, const RunOptions& options)
      : links_(links), job_(job), options_(options), title_(fmt::format("{} {}", ++links.jobs, job.name)) {}

  bool run() {
    for (;;) {
      wait_for_reply();
      const Reply reply = *std::exchange(reply_, std::nullopt);
      if (reply == Reply::stop) throw EndOfRanks();
      std::string bytes;
      links_.broadcast(bytes);
      if (reply == Reply::failure) throw Error(bytes);
      ArchiveReader reader(bytes);
      if (reply == Reply::end) {
        bool is_done = false;
        reader(is_done);
        job_.read(reader);
        return is_done;
      }
      job_.read_stage(reader);
      run_stage();
    }
  }

 private:
  // Units and results between the threads and the messages.
  class Store {
   public:
    std::optional<std::size_t> take() {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_closed_ || !units_.empty(); });
      if (is_closed_) return {};
      const std::size_t unit = units_.front();
      units_.pop_front();
      return unit;
    }
    void deliver(std::size_t unit, AnyResult result) {
      const std::lock_guard lock(mutex_);
      ++delivered_;
      results_.emplace_back(unit, std::move(result));
    }
    void close() {
      const std::lock_guard lock(mutex_);
      is_closed_ = true;
      changed_.notify_all();
    }
    void add(const std::vector<std::uint64_t>& units) {
      const std::lock_guard lock(mutex_);
      for (const std::uint64_t unit : units) units_.push_back(static_cast<std::size_t>(unit));
      changed_.notify_all();
    }
    std::size_t delivered() {
      const std::lock_guard lock(mutex_);
      return delivered_;
    }
    std::size_t waiting() {
      const std::lock_guard lock(mutex_);
      return units_.size();
    }
    bool is_closed() {
      const std::lock_guard lock(mutex_);
      return is_closed_;
    }
    std::vector<std::pair<std::size_t, AnyResult>> results() {
      const std::lock_guard lock(mutex_);
      return std::exchange(results_, {});
    }

   private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::size_t> units_;
    std::vector<std::pair<std::size_t, AnyResult>> results_;
    std::size_t delivered_ = 0;
    bool is_closed_ = false;
  };

  std::size_t threads() const { return static_cast<std::size_t>(detail::threads_of(options_)); }

  void request() {
    links_.send(0, tag_request, packed(title_, std::uint64_t{ahead_ * threads()}));
    is_asking_ = true;
  }

  // Chooses the number of units to ask for by the time of those that were computed.
  void choose_ahead(Store& store) {
    const auto done = static_cast<double>(store.delivered());
    const double of_unit = seconds_since(stage_begin_) * static_cast<double>(threads()) / std::max(done, 1.0);
    ahead_ = static_cast<std::size_t>(std::clamp(seconds_ahead / of_unit, double(least_ahead), double(most_ahead)));
  }

  // Takes a reply if there is one: units, or the end of the stage.
  void receive(Store* store) {
    const std::optional<Message> m = links_.receive();
    if (!m || m->tag != tag_reply) return;
    is_asking_ = false;
    ArchiveReader reader(m->bytes);
    Reply reply{};
    reader(reply);
    if (reply != Reply::units) {
      reply_ = reply;
      return;
    }
    std::vector<std::uint64_t> units;
    reader(units);
    if (store) store->add(units); // else a unit of this rank failed, and the job ends
  }

  void wait_for_reply() {
    Pause pause;
    while (!reply_) {
      if (!is_asking_) request();
      receive(nullptr);
      say_alive();
      if (!reply_) pause.wait();
    }
  }

  void say_alive() {
    if (seconds_since(said_) < alive_every) return;
    said_ = Clock::now();
    links_.send(0, tag_alive, {});
  }

  void run_stage() {
    Store store;
    stage_begin_ = Clock::now();
    std::exception_ptr failure;
    std::atomic<bool> is_work_done = false;
    {
      const std::jthread messages([&] { exchange_messages(store, is_work_done); });
      try {
        detail::work_on_threads(job_, options_.threads, threads(), store);
      } catch (...) {
        failure = std::current_exception();
      }
      is_work_done = true;
    }
    if (!failure) return;
    try {
      std::rethrow_exception(failure);
    } catch (const Error& e) {
      links_.send(0, tag_failure, packed(true, std::string(e.what())));
    }
  }

  void exchange_messages(Store& store, const std::atomic<bool>& is_work_done) {
    Pause pause;
    while (!is_work_done) {
      if (send_results(store)) pause.reset();
      choose_ahead(store);
      if (!is_asking_ && !reply_ && !store.is_closed() && 2 * store.waiting() < ahead_ * threads()) request();
      receive(&store);
      if (reply_) store.close();
      say_alive();
      pause.wait();
    }
    send_results(store);
  }

  bool send_results(Store& store) {
    const std::vector<std::pair<std::size_t, AnyResult>> results = store.results();
    if (results.empty() || reply_) return false; // after a reply, rank 0 is in another stage
    ArchiveWriter writer;
    writer(std::uint64_t{results.size()});
    for (const auto& [unit, result] : results) {
      writer(std::uint64_t{unit}, result != nullptr);
      if (result) job_.write_result(writer, result);
    }
    links_.send(0, tag_result, writer.take());
    return true;
  }

  Links& links_;
  const AnyJob& job_;
  const RunOptions& options_;
  std::string title_;
  bool is_asking_ = false;
  std::optional<Reply> reply_; // that ends the stage
  Clock::time_point said_ = Clock::now(), stage_begin_ = Clock::now();
  std::size_t ahead_ = least_ahead;
};

MpiRanks::MpiRanks(MPI_Comm communicator) : links_(std::make_unique<Links>(communicator)) {}
MpiRanks::~MpiRanks() = default;

int MpiRanks::rank() const { return links_->rank(); }
int MpiRanks::size() const { return links_->size(); }

Executor MpiRanks::executor() {
  return [links = links_.get()](const AnyJob& job, const RunOptions& options) {
    return links->rank() == 0 ? First(*links, job, options).run() : Other(*links, job, options).run();
  };
}

void MpiRanks::report_failure(const std::string& reason) {
  if (rank() != 0) links_->send(0, tag_failure, packed(false, reason));
}

bool MpiRanks::finish() {
  if (rank() != 0) {
    links_->send(0, tag_bye, {});
    return true;
  }
  if (links_->is_lost) return false;
  const Clock::time_point start = Clock::now();
  const auto has_ended = [](const Links::OtherRank& r) { return r.has_ended; };
  std::vector<Links::OtherRank>& others = links_->others();
  Pause pause;
  for (auto& other : others)
    if (std::exchange(other.wanted, 0) > 0)
      links_->send(static_cast<int>(&other - others.data()), tag_reply, packed(Reply::stop));
  while (!std::all_of(others.begin() + 1, others.end(), has_ended)) {
    const std::optional<Message> m = links_->receive();
    if (m && m->tag == tag_bye) others[static_cast<std::size_t>(m->source)].has_ended = true;
    if (m && m->tag == tag_request) links_->send(m->source, tag_reply, packed(Reply::stop));
    if (m) continue;
    if (seconds_since(start) > finish_within) return false;
    pause.wait();
  }
  return !links_->is_lost;
}

} // namespace mc
