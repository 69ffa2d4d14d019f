#include <options/run_session.h>
#include <terminal/interrupt.h>
#include <terminal/message.h>
#include <terminal/ranks.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>

namespace carlo {

namespace {

// The checkpoint of a part's results, from which the part goes on if its file is there.
std::unique_ptr<mc::Checkpoint> open_part_file(const CheckpointFiles& files, const std::string& output,
                                               const mc::RunIdentity& identity, const mc::Part& part) {
  mc::require(output.ends_with(".ckpt"), "--part: '{}' must be the name of the part's file; give -o part{}.ckpt",
              output, part.number);
  mc::require(files.checkpoint.empty(),
              "--part and --checkpoint exclude each other: a part saves its state to the file "
              "of -o; leave out --checkpoint");
  return mc::with_context("--part", [&] {
    // The file of an earlier round is merged, and is replaced.
    const bool is_there = std::filesystem::exists(output) && mc::read_part(output).part.round >= part.round;
    return std::make_unique<mc::Checkpoint>(
        mc::CheckpointOptions{.file = output,
                              .every = parse_duration("--every", files.every),
                              .resume = is_there ? output : "",
                              .warn = [](const std::string& text) { warn("{}; the run goes on", text); }},
        identity);
  });
}

} // namespace

RunSession::RunSession(const CheckpointFiles& files, const mc::RunIdentity& identity, const std::string& output,
                       const std::string& command)
    : files_(files), output_(output) {
  if (files.part.empty() && files.merged.empty()) {
    checkpoint_ = open_checkpoint(files, identity);
    return;
  }
  mc::require(rank_count() == 1, "--part: the parts of a batch run without MPI; leave out mpirun or --part");
  mc::Part part = files.part.empty() ? mc::Part{} : parse_part(files.part);
  std::vector<mc::SavedPart> saved;
  for (const std::string& file : files.merged) saved.push_back(mc::read_part(file));
  if (!files.resume.empty()) {
    saved.push_back(mc::with_context("--resume", [&] { return mc::read_part(files.resume); }));
    const mc::Part& base = saved.back().part;
    mc::require(base.number == 0,
                "--resume: '{}' is part {}/{}, which goes on by itself; name the file that carlo merge "
                "wrote",
                files.resume, base.number, base.count);
    part.round = base.round + 1;
  }
  for (const mc::SavedPart& one : saved) {
    const std::vector<std::string> different = mc::differences(one.identity, identity);
    mc::require(different.empty(), "'{}' is of another run: {}", one.file, fmt::join(different, "; "));
    if (files.part.empty()) part.round = std::max(part.round, one.part.round);
  }
  std::vector<std::string> words = words_of(command);
  if (files.part.empty()) {
    if (!files.checkpoint.empty())
      checkpoint_ = std::make_unique<mc::Checkpoint>(mc::CheckpointOptions{.file = files.checkpoint}, identity);
  } else checkpoint_ = open_part_file(files, output, identity, part);
  part_ = std::make_unique<mc::PartRun>(part, std::move(words), checkpoint_.get());
  for (const mc::SavedPart& one : saved) part_->add(one.results);
  using Claim = mc::PartRun::Claim;
  parts_ = {.repeated = part_->executor(Claim::all),
            .alone = [run = part_.get()](
                         std::uint64_t piece) { return run->executor(run->is_mine(piece) ? Claim::all : Claim::none); },
            .shared = part_->executor()};
}

mc::Executor RunSession::executor() const { return part_ ? part_->executor() : ranks_executor(); }

void RunSession::before_results() const {
  if (part_ && part_->part().number != 0) throw mc::EndOfPart();
}

int RunSession::run(const std::function<int()>& work) {
  try {
    return work();
  } catch (const mc::EndOfPart&) {
    return end_part();
  }
}

int RunSession::end_part() {
  const bool is_interrupted = Interrupt::signal() != 0;
  const mc::Part& part = part_->part();
  if (part.number == 0) {
    if (is_interrupted) return exit_interrupted;
    part_->save(true);
    fmt::print("the run goes on from the results of all parts, which decide what comes next: {}\n",
               files_.checkpoint.empty() ? "merge them again with --checkpoint ALL.ckpt"
                                         : fmt::format("run the parts again with --resume '{}', then merge them and "
                                                       "this file",
                                                       files_.checkpoint));
    return exit_failed;
  }
  part_->save(!is_interrupted);
  fmt::print("part {}/{}: {} units, of which {} were computed now, are in '{}'; {}\n", part.number, part.count,
             part_->known(), part_->computed(), output_,
             is_interrupted ? "interrupted: the same command goes on from here"
                            : "carlo merge puts all parts together");
  return is_interrupted ? exit_interrupted : exit_ok;
}

mc::Part parse_part(const std::string& text) {
  mc::Part part;
  const char* end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, part.number);
  bool is_right = error == std::errc() && slash != end && *slash == '/';
  if (is_right) {
    const auto [last, failure] = std::from_chars(slash + 1, end, part.count);
    is_right = failure == std::errc() && last == end;
  }
  mc::require(is_right && part.number >= 1 && part.number <= part.count && part.count <= 1'000'000,
              "--part '{}' must be K/N with 1 <= K <= N <= 1000000, such as 3/100", text);
  return part;
}

std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  bool is_quoted = false, is_word = false;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (c == ' ' && !is_quoted) {
      is_word = false;
      continue;
    }
    if (!is_word) words.emplace_back();
    is_word = true;
    if (c == '\'') is_quoted = !is_quoted;
    else words.back() += c == '\\' && !is_quoted && i + 1 < command.size() ? command[++i] : c;
  }
  return words;
}

std::vector<std::string> without_option(const std::vector<std::string>& words, const std::vector<std::string>& names) {
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto is_it = [&](const std::string& name) {
      return word == name || (name.starts_with("--") ? word.starts_with(name + "=") : word.starts_with(name));
    };
    if (std::none_of(names.begin(), names.end(), is_it)) kept.push_back(word);
    else if (std::find(names.begin(), names.end(), word) != names.end()) ++i; // its value
  }
  return kept;
}

} // namespace carlo
