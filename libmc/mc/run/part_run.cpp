#include <mc/core/error.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>
#include <mc/run/part_run.h>
#include <mc/run/work_on_threads.h>

#include <algorithm>

namespace mc {

namespace {

// The units of a list, for threads in any order.
struct UnitList {
  const std::vector<std::size_t>& units;
  const std::atomic<bool>* cancel;
  std::function<void(std::size_t, AnyResult)> deliver;
  std::atomic<std::size_t> next = 0;

  std::optional<std::size_t> take() {
    if (cancel && cancel->load()) return {};
    const std::size_t i = next++;
    return i < units.size() ? std::optional(units[i]) : std::nullopt;
  }
  void close() { next = units.size(); }
};

// Memory of a result in a map, about.
double bytes_of_result(const std::string& text) {
  constexpr double node = 160; // with the key and what the allocator adds
  return double(text.size()) + node;
}

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t all = text.size();
  for (const char c : text) all = hash(all, static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  return all;
}

// "3, 7-9" of sorted numbers.
std::string ranges(const std::vector<std::uint64_t>& numbers) {
  std::string text;
  for (std::size_t i = 0, j = 0; i < numbers.size(); i = j) {
    for (j = i + 1; j < numbers.size() && numbers[j] == numbers[j - 1] + 1;) ++j;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", numbers[i]);
    if (j > i + 1) text += fmt::format("-{}", numbers[j - 1]);
  }
  return text;
}

} // namespace

PartRun::PartRun(Part part, std::vector<std::string> command, Checkpoint* checkpoint)
    : part_(part), command_(std::move(command)), checkpoint_(checkpoint), section_(checkpoint, "part", [this](auto& a) {
        Part saved = part_;
        std::vector<std::string> words = command_;
        a(saved, words);
        if constexpr (std::remove_cvref_t<decltype(a)>::is_reader)
          require(saved.number == part_.number && saved.count == part_.count && saved.round == part_.round,
                  "it is part {}/{} of round {}, and this is part {}/{} of round {}", saved.number, saved.count,
                  saved.round, part_.number, part_.count, part_.round);
        else a.reserve(static_cast<std::size_t>(held_bytes_));
        a(part_.number == 0 ? base_ : results_);
      }) {
  require(part.number <= part.count, "part {}/{} must be one of 1 to {}", part.number, part.count, part.count);
}

void PartRun::add(const std::string& bytes) {
  require_memory(double(bytes.size()), "the results of a part");
  Results more;
  ArchiveReader reader(bytes);
  reader(more).require_end();
  base_.merge(more);
}

Executor PartRun::executor(Claim claim) {
  return [this, claim](const AnyJob& job, const RunOptions& options) { return run(job, options, claim); };
}

const std::string* PartRun::find(const Key& key) const {
  for (const Results* results : {&base_, &results_})
    if (const auto found = results->find(key); found != results->end()) return &found->second;
  return nullptr;
}

bool PartRun::claims(const Key& key, Claim claim) const {
  if (part_.number == 0 || claim == Claim::none) return false;
  const auto& [job, stage, unit] = key;
  // Stages of one unit must not all go to the first part.
  return claim == Claim::all || (hash(hash_of(job), stage) % part_.count + unit) % part_.count == part_.number - 1;
}

void PartRun::require_room(double more) const {
  const double copies = checkpoint_ ? 2 * (held_bytes_ + more) : 0; // a new one, and the memory of the one before
  require_memory(more + copies, fmt::format("the results of part {}/{}", part_.number, part_.count),
                 "more parts need less each; MPI keeps no results");
}

void PartRun::compute_missing(const AnyJob& job, const RunOptions& options, const std::string& name,
                              std::uint64_t stage, std::size_t units, Claim claim) {
  std::vector<std::size_t> missing;
  for (std::size_t unit = 0; unit < units; ++unit)
    if (const Key key(name, stage, unit); claims(key, claim) && !find(key)) missing.push_back(unit);
  double done = 0, bytes = 0; // of this stage
  held_bytes_ = 0;
  for (const auto& [key, text] : results_) held_bytes_ += bytes_of_result(text);
  UnitList list{missing, options.cancel, [&](std::size_t unit, const AnyResult& result) {
                  if (!result) return;
                  ArchiveWriter writer;
                  job.write_result(writer, result);
                  const std::lock_guard lock(mutex_);
                  done += 1;
                  bytes += bytes_of_result(writer.text());
                  require_room(bytes / done * (double(missing.size()) - done));
                  held_bytes_ += bytes_of_result(writer.text());
                  results_.emplace(Key(name, stage, unit), writer.text()); // without the writer's unused memory
                  ++computed_;
                  if (checkpoint_ && checkpoint_->is_due()) checkpoint_->save();
                }};
  detail::work_on_threads(job, options.threads,
                          std::min(static_cast<std::size_t>(detail::threads_of(options)), missing.size()), list);
}

bool PartRun::run(const AnyJob& job, const RunOptions& options, Claim claim) {
  const std::string name = fmt::format("{} {}", job.name, jobs_[job.name]++);
  bool is_complete = true;
  std::size_t units = 0;
  for (std::uint64_t stage = 0; (units = job.next_stage()) > 0; ++stage) {
    try {
      compute_missing(job, options, name, stage, units, claim);
    } catch (...) {
      save(false); // what is known before the failure
      throw;
    }
    if (options.cancel && options.cancel->load()) throw EndOfPart();
    for (std::size_t unit = 0; unit < units; ++unit) {
      if (const std::string* bytes = find(Key(name, stage, unit))) {
        ArchiveReader reader(*bytes);
        job.absorb(unit, job.read_result(reader));
        reader.require_end();
        continue;
      }
      is_complete = false;
      if (!job.skip) throw EndOfPart();
      job.skip(unit);
    }
    if (!is_complete && job.needs_results()) throw EndOfPart();
  }
  if (!is_complete) throw EndOfPart();
  return true;
}

void PartRun::save(bool is_whole) {
  part_.is_whole = is_whole;
  if (checkpoint_) checkpoint_->save_and_wait();
}

SavedPart read_part(const std::string& file) {
  const SavedRun run = read_checkpoint(file);
  require(run.sections.size() == 1 && run.sections.front().first == "part",
          "'{}' is a checkpoint of a whole run, and no part of one; --resume goes on from it", file);
  SavedPart saved{.file = file, .identity = run.identity, .part = {}, .command = {}, .results = {}};
  with_context(file, [&] {
    ArchiveReader reader(run.sections.front().second);
    reader(saved.part, saved.command);
    saved.results = reader.rest();
  });
  return saved;
}

void require_all_parts(const std::vector<SavedPart>& parts) {
  require(!parts.empty(), "no part is given");
  const SavedPart& first = parts.front();
  std::map<std::uint64_t, const SavedPart*> by_number;
  std::uint64_t count = 0, round = 0;
  for (const SavedPart& one : parts) {
    const std::vector<std::string> different = differences(first.identity, one.identity);
    require(different.empty(), "'{}' is of another run than '{}': {}", one.file, first.file,
            fmt::join(different, "; "));
    const auto [place, is_new] = by_number.emplace(one.part.number, &one);
    require(is_new, "'{}' and '{}' are both {}; name one of them", place->second->file, one.file,
            one.part.number == 0 ? "merged results" : fmt::format("part {}/{}", one.part.number, one.part.count));
    if (one.part.number == 0) continue;
    require(count == 0 || count == one.part.count, "'{}' is part {}/{}, and others are of {} parts", one.file,
            one.part.number, one.part.count, count);
    require(round == 0 || round == one.part.round, "'{}' is of round {}, and others are of round {}; run it again",
            one.file, one.part.round, round);
    require(one.part.is_whole, "'{}' did not come to its end; run the command of part {}/{} again", one.file,
            one.part.number, one.part.count);
    count = one.part.count;
    round = one.part.round;
  }
  std::vector<std::uint64_t> missing;
  for (std::uint64_t k = 1; k <= count; ++k)
    if (!by_number.contains(k)) missing.push_back(k);
  require(missing.empty(), "part{} {} of {} {} missing; run all parts, and name their files",
          missing.size() == 1 ? "" : "s", ranges(missing), count, missing.size() == 1 ? "is" : "are");
  const SavedPart* base = by_number.contains(0) ? by_number.at(0) : nullptr;
  const std::uint64_t before = count == 0 ? 0 : round - 1;
  require(count == 0 || before == 0 || base, "the parts are of round {}: name the merged file of round {}, too", round,
          before);
  require(count == 0 || !base || base->part.round == before,
          "'{}' has the results of round {}, and the parts are of round {}", base ? base->file : "",
          base ? base->part.round : 0, round);
}

} // namespace mc
