#pragma once
/// Runs whose units are computed by processes that do not talk to each other, as jobs of a batch queue.

#include <mc/run/executor.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

namespace mc {

/// Thrown by a part where the run goes on only with the results of other parts. No Error: nothing failed.
struct EndOfPart {};

/// Pieces of a program that do not depend on each other: a part that lacks results for one goes on with the next.
class IndependentPieces {
 public:
  /// Runs a piece. Returns false where it ended by EndOfPart.
  template <class F> bool attempt(F&& piece) {
    try {
      piece();
    } catch (const EndOfPart&) {
      is_incomplete_ = true;
      return false;
    }
    return true;
  }
  /// Throws EndOfPart if a piece ended so.
  void end() const {
    if (is_incomplete_) throw EndOfPart();
  }

 private:
  bool is_incomplete_ = false;
};

/// Number of a part, and what it went on from.
struct Part {
  std::uint64_t number = 0; ///< From 1; 0 for the merged results of all parts.
  std::uint64_t count = 0;  ///< Number of parts.
  std::uint64_t round = 1;  ///< Of the parts; merged results have that of their parts. See PartRun.
  bool is_whole = false;    ///< Whether the part came to its end.
  /// The part, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(number, count, round, is_whole); }
};

/// Results of units, and the executor that computes those of one part.
///   units   : part k of n computes every n-th unit of each stage. It skips the others as long as no later stage
///             depends on them; then EndOfPart is thrown.
///   merging : with the results of all parts, the same program runs again, absorbs all results in order, and has the
///             bits of a run without parts. Where units are missing, the run has a barrier: the parts run once more,
///             from the merged results.
///   memory  : a part holds its results. It throws MemoryError as soon as those that it has show that the results of
///             the stage will not fit.
///   file    : the results are saved as a checkpoint, also before an exception of the job. A part that was killed goes
///             on from its file.
class PartRun {
 public:
  /// Units that an executor computes; results that are known are used by all.
  enum class Claim {
    share, ///< Those of this part.
    all,   ///< All: for a piece of the program that one part computes alone.
    none   ///< None: for a piece that another part computes.
  };

  /// The part, and the words of the command by which the program can be run again.
  ///   checkpoint : saves the results; null: none are saved. It must outlive this.
  PartRun(Part part, std::vector<std::string> command, Checkpoint* checkpoint);
  PartRun(const PartRun&) = delete;
  PartRun& operator=(const PartRun&) = delete;

  /// The part.
  const Part& part() const { return part_; }
  /// Adds the results of a file of parts, as read by saved_part().
  void add(const std::string& bytes);
  /// Executor for the jobs of the program. It must not outlive this.
  Executor executor(Claim claim = Claim::share);
  /// Whether a piece of the program is computed by this part, by its number among all pieces.
  bool is_mine(std::uint64_t piece) const { return part_.number != 0 && piece % part_.count == part_.number - 1; }
  /// Number of units that this process computed.
  std::uint64_t computed() const { return computed_; }
  /// Number of units whose results are known.
  std::uint64_t known() const { return results_.size() + base_.size(); }
  /// Saves the results of this part, or those of all files where it is none.
  ///   is_whole : whether the part came to its end.
  void save(bool is_whole);

 private:
  using Key = std::tuple<std::string, std::uint64_t, std::uint64_t>; // job, stage, unit
  using Results = std::map<Key, std::string>;

  bool run(const AnyJob& job, const RunOptions& options, Claim claim);
  void compute_missing(const AnyJob& job, const RunOptions& options, const std::string& name, std::uint64_t stage,
                       std::size_t units, Claim claim);
  // Throws MemoryError unless `more` bytes of results fit beside those that are held, and checkpoints of all.
  void require_room(double more) const;
  const std::string* find(const Key& key) const;
  bool claims(const Key& key, Claim claim) const;

  Part part_;
  std::vector<std::string> command_;
  Checkpoint* checkpoint_;
  std::mutex mutex_;                          // of the results
  Results results_,                           ///< of this part
      base_;                                  ///< of the files that were added
  double held_bytes_ = 0;                     ///< memory of the results of this part, about
  std::map<std::string, std::uint64_t> jobs_; ///< number of jobs of each name so far
  std::uint64_t computed_ = 0;
  Checkpoint::Section section_;
};

/// A file of a part, without its program.
struct SavedPart {
  std::string file;                 ///< Its name.
  RunIdentity identity;             ///< What the results depend on.
  Part part;                        ///< Its number.
  std::vector<std::string> command; ///< Words of the command that wrote it.
  std::string results;              ///< Bytes for PartRun::add().
};

/// Reads a file of PartRun. Throws Error where it is damaged, or no such file.
SavedPart read_part(const std::string& file);

/// Throws Error unless the files are all parts of one run, and at most the merged results that they went on from. Names
/// the parts that are missing, that stand twice, that did not come to their end, and of other runs, with what differs.
void require_all_parts(const std::vector<SavedPart>& parts);

} // namespace mc
