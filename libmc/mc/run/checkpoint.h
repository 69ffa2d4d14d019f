#pragma once
/// Files from which an ended or killed run goes on.

#include <mc/run/archive.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mc {

/// Everything that a result depends on, as fields with the user's words: {"--seed", "1"}, {"the integrand", "x*y"}.
using RunIdentity = std::vector<std::pair<std::string, std::string>>;

/// "--seed was '1' and is '2' now" for every field that differs.
std::vector<std::string> differences(const RunIdentity& before, const RunIdentity& now);

/// The content of a checkpoint.
struct SavedRun {
  RunIdentity identity;                                      ///< Of the run that wrote it.
  std::vector<std::pair<std::string, std::string>> sections; ///< Names and bytes of its sections, the outermost first.
};

/// Reads a checkpoint. Throws Error where it is missing, damaged or none.
SavedRun read_checkpoint(const std::string& file);

/// Files and time of checkpoints.
struct CheckpointOptions {
  std::string file = {};                             ///< File to write.
  double every = 60;                                 ///< Seconds between checkpoints, at least 0.
  std::string resume = {};                           ///< File to go on from; empty: a new run.
  std::function<void(const std::string&)> warn = {}; ///< Called with the reason where a checkpoint was not written.
};

/// Saves the state of a run to a file, and restores it.
///   sections : The state consists of the sections that are open, the outermost first: a program opens a section for
///              its own state, and each loop within it a further one. See Section.
///   writing  : A file is written beside the old one by a thread of its own, synced and renamed. It has a checksum. A
///              crash, a killed process or a full disk leaves the old file.
///   identity : A file of another run is refused, with every field that differs.
///   lock     : While this object exists, no other one may write the same file, of any process. On file systems without
///              locks this is not checked.
///   threads  : One thread at a time may use this object.
class Checkpoint {
 public:
  /// Reads options.resume if it is given.
  ///   throws : Error if this file is missing, damaged, no checkpoint, or of a run with another identity; if
  ///            options.file cannot be written, or another run writes it; if `every` is negative.
  Checkpoint(CheckpointOptions options, RunIdentity identity);
  /// Waits for the thread that writes. Does not save.
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  /// Whether the time for the next checkpoint has come.
  bool is_due() const;
  /// Copies the state and begins to write it.
  void save();
  /// Number of calls of save() and save_and_wait().
  std::uint64_t saves() const { return saves_; }
  /// Saves the state, and waits until the file is written.
  void save_and_wait();

  /// Forgets what the file to go on from contains within the open sections: the next section within them is new.
  void forget_inner_sections();

  /// State of a part of a run, during its lifetime.
  class Section {
   public:
    /// Opens a section within the open ones. If the file to go on from was saved within the same sections, restores
    /// the state. `archive(a)` is called with an ArchiveWriter for each checkpoint, and with an ArchiveReader to
    /// restore. A null checkpoint has no effect.
    ///   throws : Error if the file contains another section at this place.
    template <class Archive> Section(Checkpoint* checkpoint, const std::string& name, Archive archive) {
      if (!checkpoint) return;
      const std::optional<std::string> bytes =
          checkpoint->open(name, [archive](ArchiveWriter& writer) { archive(writer); });
      checkpoint_ = checkpoint;
      if (!bytes) return;
      ArchiveReader reader(*bytes);
      archive(reader);
      reader.require_end();
      is_restored_ = true;
    }
    ~Section() {
      if (checkpoint_) checkpoint_->close();
    }
    Section(const Section&) = delete;
    Section& operator=(const Section&) = delete;

    /// Whether the state was restored.
    bool is_restored() const { return is_restored_; }
    /// Whether no other section contains this one.
    bool is_outermost() const { return checkpoint_ && checkpoint_->open_.size() == 1; }

   private:
    Checkpoint* checkpoint_ = nullptr;
    bool is_restored_ = false;
  };

 private:
  using Clock = std::chrono::steady_clock;
  using Save = std::function<void(ArchiveWriter&)>;
  class Writing;
  class Lock;

  // Moves out the saved bytes of the section, if there are any.
  std::optional<std::string> open(const std::string& name, Save save);
  void close();
  void report_finished_writing();

  CheckpointOptions options_;
  RunIdentity identity_;
  std::vector<std::pair<std::string, Save>> open_; ///< Open sections, the outermost first.
  /// Sections of the file to go on from that may still be restored.
  std::vector<std::pair<std::string, std::string>> saved_;
  std::unique_ptr<Lock> lock_; ///< Of the file to write.
  std::unique_ptr<Writing> writing_;
  std::string memory_; ///< Of the checkpoint before, for the next.
  Clock::time_point last_ = Clock::now();
  std::uint64_t saves_ = 0;
};

} // namespace mc
