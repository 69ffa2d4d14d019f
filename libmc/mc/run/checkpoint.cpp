#include <mc/core/file.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>
#include <mc/run/checkpoint.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

namespace mc {

namespace {

// The number is that of the format. The byte order of the machine is part of the first line by its last bytes.
constexpr std::string_view magic = "mc checkpoint 1\n";
constexpr std::uint64_t byte_order = 0x0102030405060708;

// Four sums of every fourth word, which do not wait for each other.
std::uint64_t checksum_of(std::string_view bytes) {
  std::array<std::uint64_t, 4> sums{1, 2, 3, 4};
  const std::size_t size = bytes.size();
  while (!bytes.empty()) {
    std::array<std::uint64_t, 4> words{};
    const std::size_t n = std::min(bytes.size(), sizeof words);
    std::memcpy(words.data(), bytes.data(), n);
    bytes.remove_prefix(n);
    for (std::size_t i = 0; i < words.size(); ++i) {
      sums[i] = (sums[i] ^ words[i]) * 0x9e3779b97f4a7c15ULL;
      sums[i] ^= sums[i] >> 29;
    }
  }
  return hash(size, sums[0], sums[1], sums[2], sums[3]);
}

// Throws Error unless the text is a complete checkpoint. Returns the bytes between the first line and the checksum.
std::string_view checked_body(std::string_view text, const std::string& file) {
  require(text.starts_with(magic.substr(0, magic.size() - 2)), "'{}' is no checkpoint", file);
  require(text.starts_with(magic), "'{}' is a checkpoint of another version of its format; start the run anew", file);
  std::string_view body = text.substr(magic.size());
  std::uint64_t order = 0, sum = 0;
  if (body.size() >= sizeof order + sizeof sum) {
    std::memcpy(&order, body.data(), sizeof order);
    std::memcpy(&sum, body.data() + body.size() - sizeof sum, sizeof sum);
    body.remove_suffix(sizeof sum);
  }
  require(sum == checksum_of(body), "'{}' is damaged: its checksum is wrong; start the run anew", file);
  require(order == byte_order, "'{}' was written on a machine with another byte order", file);
  return body.substr(sizeof order);
}

std::string value_of(const RunIdentity& identity, const std::string& field) {
  const auto found = std::find_if(identity.begin(), identity.end(), [&](const auto& f) { return f.first == field; });
  return found == identity.end() ? "not given" : "'" + printable(found->second, 200) + "'";
}

} // namespace

std::vector<std::string> differences(const RunIdentity& saved, const RunIdentity& asked) {
  std::vector<std::string> fields, all;
  for (const RunIdentity* identity : {&asked, &saved})
    for (const auto& [field, value] : *identity)
      if (std::find(fields.begin(), fields.end(), field) == fields.end()) fields.push_back(field);
  for (const std::string& field : fields)
    if (const std::string was = value_of(saved, field), is = value_of(asked, field); was != is)
      all.push_back(fmt::format("{} was {} and is {} now", printable(field, 200), was, is));
  return all;
}

SavedRun read_checkpoint(const std::string& file) {
  const std::string text = read_file(file);
  ArchiveReader reader(checked_body(text, file));
  SavedRun run;
  with_context(file, [&] { reader(run.identity, run.sections).require_end(); });
  return run;
}

/// Exclusive use of a file that is replaced. The lock is that of the file's inode, so each new file is locked before it
/// gets its name.
class Checkpoint::Lock {
 public:
  explicit Lock(std::string file) : file_(std::move(file)) {
    const int descriptor = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return; // there is no file yet
    if (is_other_run(descriptor)) {
      ::close(descriptor);
      throw Error(fmt::format("another run writes '{}'; name another file, or wait for its end", file_));
    }
    replace(descriptor);
  }
  ~Lock() { replace(-1); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  // Throws Error where another run has replaced the file.
  void require_mine() const {
    const int descriptor = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    struct stat there {
    }, mine{};
    const bool is_mine = descriptor_ >= 0 && fstat(descriptor, &there) == 0 && fstat(descriptor_, &mine) == 0 &&
                         there.st_dev == mine.st_dev && there.st_ino == mine.st_ino;
    const bool is_other = !is_mine && is_other_run(descriptor);
    ::close(descriptor);
    require(!is_other, "another run writes '{}'", file_);
  }
  // Locks the file that will get the name.
  void move_to(std::FILE* stream) {
    const int descriptor = fcntl(fileno(stream), F_DUPFD_CLOEXEC, 0);
    flock(descriptor, LOCK_EX | LOCK_NB);
    next_ = descriptor;
  }
  void moved() { replace(std::exchange(next_, -1)); }

 private:
  // Locks the file unless another description of it is locked.
  static bool is_other_run(int descriptor) { return flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; }
  void replace(int descriptor) {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = descriptor;
  }

  std::string file_;
  int descriptor_ = -1, next_ = -1;
};

/// A file that a thread writes.
class Checkpoint::Writing {
 public:
  Writing(std::string file, std::string bytes, Lock& lock)
      : file_(std::move(file)), bytes_(std::move(bytes)), lock_(lock), thread_([this] { write(); }) {}

  bool is_finished() const { return is_finished_; }
  /// Waits for the end. Returns the reason of a failure, or "".
  const std::string& wait() {
    if (thread_.joinable()) thread_.join();
    return failure_;
  }
  /// The memory of the bytes, after wait().
  std::string memory() { return std::move(bytes_); }
  ~Writing() { wait(); }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;

 private:
  void write() {
    try {
      const std::uint64_t sum = checksum_of(std::string_view(bytes_).substr(magic.size()));
      bytes_.append(reinterpret_cast<const char*>(&sum), sizeof sum);
      lock_.require_mine();
      replace_file(file_, [&](std::FILE* stream) {
        write_bytes(stream, bytes_);
        lock_.move_to(stream);
      });
      lock_.moved();
    } catch (const std::exception& e) {
      failure_ = e.what();
    }
    is_finished_ = true;
  }

  std::string file_, bytes_, failure_;
  Lock& lock_;
  std::atomic<bool> is_finished_ = false;
  std::thread thread_; // after the data that it uses
};

Checkpoint::Checkpoint(CheckpointOptions options, RunIdentity identity)
    : options_(std::move(options)), identity_(std::move(identity)) {
  require(options_.every >= 0, "checkpoint: {} seconds between two must be >= 0", options_.every);
  if (!options_.resume.empty()) {
    SavedRun saved = read_checkpoint(options_.resume);
    saved_ = std::move(saved.sections);
    const std::vector<std::string> different = differences(saved.identity, identity_);
    require(different.empty(), "'{}' is of another run: {}; ask for the same, or start anew", options_.resume,
            fmt::join(different, "; "));
  }
  if (options_.file.empty()) return;
  require_writable(options_.file);
  lock_ = std::make_unique<Lock>(options_.file);
}

Checkpoint::~Checkpoint() { report_finished_writing(); }

bool Checkpoint::is_due() const {
  if (options_.file.empty() || (writing_ && !writing_->is_finished())) return false;
  return std::chrono::duration<double>(Clock::now() - last_).count() >= options_.every;
}

void Checkpoint::report_finished_writing() {
  if (!writing_) return;
  const std::string& failure = writing_->wait();
  if (!failure.empty() && options_.warn) options_.warn(failure);
  memory_ = writing_->memory();
  writing_.reset();
}

void Checkpoint::save() {
  ++saves_;
  if (options_.file.empty()) return;
  report_finished_writing();
  ArchiveWriter writer(std::move(memory_));
  writer.bytes(magic.data(), magic.size());
  writer(byte_order, identity_, std::uint64_t{open_.size()});
  for (const auto& [name, archive] : open_) {
    writer(name);
    writer.nested(archive);
  }
  writing_ = std::make_unique<Writing>(options_.file, writer.take(), *lock_);
  last_ = Clock::now();
}

void Checkpoint::save_and_wait() {
  save();
  report_finished_writing();
}

std::optional<std::string> Checkpoint::open(const std::string& name, Save save) {
  const std::size_t depth = open_.size();
  open_.emplace_back(name, std::move(save));
  if (depth >= saved_.size()) return {};
  auto& [saved_name, bytes] = saved_[depth];
  require(saved_name == name, "'{}' was saved in '{}', and the run is in '{}'{}", options_.resume,
          printable(saved_name), name, saved_name == "part" ? "; it is a part of a run" : "");
  return std::move(bytes);
}

void Checkpoint::close() {
  open_.pop_back();
  forget_inner_sections(); // the closed one and those within it: the next at its depth is new
}

void Checkpoint::forget_inner_sections() {
  if (saved_.size() > open_.size()) saved_.resize(open_.size());
}

} // namespace mc
