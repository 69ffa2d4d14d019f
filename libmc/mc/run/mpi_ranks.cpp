#include <mc/core/error.h>
#include <mc/run/mpi_links.h>
#include <mc/run/mpi_ranks.h>
#include <mc/run/unit_store.h>
#include <mc/run/work_on_threads.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace mc {

namespace {

using detail::message_of, detail::MpiLinks, detail::MpiMessage, detail::Pause, detail::seconds_since;
using Clock = MpiLinks::Clock;

enum class Reply : std::uint8_t { units, stage, end, failure, stop };

constexpr double alive_every = 5, finish_within = 10; // seconds
// Units that a rank asks for: so many for each thread that it never waits for rank 0, and so few that it ends with the
// others.
constexpr std::size_t least_ahead = 2, most_ahead = 32;
constexpr double seconds_ahead = 0.05;

} // namespace

/// A job on rank 0.
class MpiRanks::First {
 public:
  First(MpiLinks& links, const AnyJob& job, const RunOptions& options)
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
  // Saves what is done where a rank is lost, at any point of the stage.
  void run_stage(detail::UnitQueue& queue) {
    try {
      run_opened_stage(queue);
    } catch (const LostRank&) {
      if (options_.checkpoint && !queue.has_failed()) options_.checkpoint->save_and_wait();
      throw;
    }
  }

  void run_opened_stage(detail::UnitQueue& queue) {
    wait_for_requests();
    if (queue.is_cancelled()) return;
    ArchiveWriter writer;
    job_.write_stage(writer);
    answer_all(Reply::stage, writer.take());
    const std::size_t workers = std::min(static_cast<std::size_t>(detail::threads_of(options_)), queue.left());
    // Twice what a rank asks for: it leaves as much to the others.
    queue.open(2 * most_ahead * workers * static_cast<std::size_t>(links_.size()));
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
    if (failure) std::rethrow_exception(failure);
  }

  // Answers requests until no unit is left, and every rank has delivered its own.
  void serve(detail::UnitQueue& queue) {
    Pause pause;
    for (;;) {
      while (const std::optional<MpiMessage> m = links_.receive()) {
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
    MpiLinks::OtherRank& other = other_rank(r);
    std::vector<std::uint64_t> units;
    while (units.size() < other.wanted) {
      const std::optional<std::size_t> unit = queue.try_take();
      if (!unit) break;
      units.push_back(*unit);
      other.units.insert(*unit);
    }
    if (units.empty()) return;
    other.wanted = 0;
    links_.send(r, detail::tag_reply, message_of(Reply::units, units));
  }

  // A message; results only during a stage.
  void handle(const MpiMessage& m, detail::UnitQueue* queue) {
    MpiLinks::OtherRank& other = other_rank(m.source);
    other.heard = Clock::now();
    ArchiveReader reader(m.bytes);
    if (m.tag == detail::tag_hello) reader(other.host, other.process);
    other.has_ended = other.has_ended || m.tag == detail::tag_bye;
    if (is_ending_) {
      if (m.tag == detail::tag_request) reader(other.job, other.wanted);
      return;
    }
    if (m.tag == detail::tag_bye) {
      throw Error(fmt::format("{} ended before the work was done", links_.name_of(m.source)));
    }
    if (m.tag == detail::tag_failure) {
      std::string reason;
      bool is_of_unit = false;
      reader(is_of_unit, reason);
      throw Error(is_of_unit ? reason : fmt::format("{}: {}", links_.name_of(m.source), reason));
    }
    if (m.tag == detail::tag_request) {
      reader(other.job, other.wanted);
      require(other.job == title_, "{} runs the job '{}', and rank 0 the job '{}': the ranks have different inputs",
              links_.name_of(m.source), other.job, title_);
    }
    if (m.tag != detail::tag_result) return;
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
    const auto has_asked = [](const MpiLinks::OtherRank& r) { return r.wanted > 0 || r.has_ended; };
    while (!std::all_of(links_.others().begin() + 1, links_.others().end(), has_asked)) {
      const std::optional<MpiMessage> m = links_.receive();
      if (m) handle(*m, nullptr);
      else {
        links_.require_alive();
        pause.wait();
      }
    }
  }

  void answer_all(Reply reply, std::string bytes) {
    for (int r = 1; r < links_.size(); ++r) {
      links_.send(r, detail::tag_reply, message_of(reply));
      other_rank(r).wanted = 0;
      other_rank(r).units.clear();
    }
    links_.broadcast(bytes);
  }

  // Ends the job on all ranks. Where one has left the program, finish() ends the others.
  void end(Reply reply, std::string bytes) {
    is_ending_ = true;
    wait_for_requests();
    const auto has_ended = [](const MpiLinks::OtherRank& r) { return r.has_ended; };
    if (std::none_of(links_.others().begin(), links_.others().end(), has_ended)) answer_all(reply, std::move(bytes));
  }

  MpiLinks::OtherRank& other_rank(int r) { return links_.others()[static_cast<std::size_t>(r)]; }

  MpiLinks& links_;
  const AnyJob& job_;
  const RunOptions& options_;
  std::string title_;
  std::atomic<bool> is_own_work_done_ = false;
  bool is_ending_ = false;
};

/// A job on another rank.
class MpiRanks::Other {
 public:
  Other(MpiLinks& links, const AnyJob& job, const RunOptions& options)
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
  std::size_t threads() const { return static_cast<std::size_t>(detail::threads_of(options_)); }

  void request() {
    links_.send(0, detail::tag_request, message_of(title_, std::uint64_t{ahead_ * threads()}));
    is_asking_ = true;
  }

  // Chooses the number of units to ask for by the time of those that were computed.
  void choose_ahead(detail::UnitStore& store) {
    const auto done = static_cast<double>(store.delivered());
    const double of_unit = seconds_since(stage_begin_) * static_cast<double>(threads()) / std::max(done, 1.0);
    ahead_ = static_cast<std::size_t>(std::clamp(seconds_ahead / of_unit, double(least_ahead), double(most_ahead)));
  }

  // Takes a reply if there is one: units, or the end of the stage.
  void receive(detail::UnitStore* store) {
    const std::optional<MpiMessage> m = links_.receive();
    if (!m || m->tag != detail::tag_reply) return;
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
    links_.send(0, detail::tag_alive, {});
  }

  void run_stage() {
    detail::UnitStore store;
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
      links_.send(0, detail::tag_failure, message_of(true, std::string(e.what())));
    }
  }

  void exchange_messages(detail::UnitStore& store, const std::atomic<bool>& is_work_done) {
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

  bool send_results(detail::UnitStore& store) {
    const std::vector<std::pair<std::size_t, AnyResult>> results = store.take_results();
    if (results.empty() || reply_) return false; // after a reply, rank 0 is in another stage
    ArchiveWriter writer;
    writer(std::uint64_t{results.size()});
    for (const auto& [unit, result] : results) {
      writer(std::uint64_t{unit}, result != nullptr);
      if (result) job_.write_result(writer, result);
    }
    links_.send(0, detail::tag_result, writer.take());
    return true;
  }

  MpiLinks& links_;
  const AnyJob& job_;
  const RunOptions& options_;
  std::string title_;
  bool is_asking_ = false;
  std::optional<Reply> reply_; // that ends the stage
  Clock::time_point said_ = Clock::now(), stage_begin_ = Clock::now();
  std::size_t ahead_ = least_ahead;
};

MpiRanks::MpiRanks(MPI_Comm communicator) : links_(std::make_unique<MpiLinks>(communicator)) {}
MpiRanks::~MpiRanks() = default;

int MpiRanks::rank() const { return links_->rank(); }
int MpiRanks::size() const { return links_->size(); }

Executor MpiRanks::executor() {
  return [links = links_.get()](const AnyJob& job, const RunOptions& options) {
    return links->rank() == 0 ? First(*links, job, options).run() : Other(*links, job, options).run();
  };
}

void MpiRanks::report_failure(const std::string& reason) {
  if (rank() != 0) links_->send(0, detail::tag_failure, message_of(false, reason));
}

bool MpiRanks::finish() {
  if (rank() != 0) {
    links_->send(0, detail::tag_bye, {});
    return true;
  }
  if (links_->is_lost) return false;
  const Clock::time_point start = Clock::now();
  const auto has_ended = [](const MpiLinks::OtherRank& r) { return r.has_ended; };
  std::vector<MpiLinks::OtherRank>& others = links_->others();
  Pause pause;
  for (auto& other : others)
    if (std::exchange(other.wanted, 0) > 0)
      links_->send(static_cast<int>(&other - others.data()), detail::tag_reply, message_of(Reply::stop));
  while (!std::all_of(others.begin() + 1, others.end(), has_ended)) {
    const std::optional<MpiMessage> m = links_->receive();
    if (m && m->tag == detail::tag_bye) others[static_cast<std::size_t>(m->source)].has_ended = true;
    if (m && m->tag == detail::tag_request) links_->send(m->source, detail::tag_reply, message_of(Reply::stop));
    if (m) continue;
    if (seconds_since(start) > finish_within) return false;
    pause.wait();
  }
  return !links_->is_lost;
}

} // namespace mc
