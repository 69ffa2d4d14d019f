/// carlo merge: the results of a run from the files of its parts.

#include <options/files.h>
#include <options/run_session.h>
#include <options/subcommand.h>
#include <terminal/ranks.h>

#include <mc/core/error.h>
#include <mc/run/part_run.h>

#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace carlo {

namespace {

struct MergeCommandOptions {
  std::vector<std::string> parts;
  std::string output, checkpoint;
};

std::vector<Option> rows(MergeCommandOptions& o) {
  return in_groups({
      {common_options,
       {
           state_file({"PART", "FILE", &o.parts,
                       "Files of all parts; where the parts ran with --resume, also the file of that option.", true}),
           {"-o,--output", "PATH", &o.output,
            "Picture or folder, as -o of the command of the parts. Default: that command's."},
       }},
      {expert_options,
       {
           state_file({"--checkpoint", "FILE", &o.checkpoint,
                       "Where the parts must run again, write the merged results to this file, for their --resume. The "
                       "exit code is then 1."}),
       }},
  });
}

// Runs the command of the parts once more, with their results in place of the work. Does not return.
[[noreturn]] void run_again(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv("/proc/self/exe", arguments.data());
  throw mc::Error(fmt::format("merge: cannot start '{}' again: {}", words.front(), std::strerror(errno)));
}

int run_merge(const MergeCommandOptions& o) {
  mc::require(rank_count() == 1, "merge: it runs on one rank; leave out mpirun");
  std::vector<mc::SavedPart> parts;
  for (const std::string& file : o.parts) {
    parts.push_back(mc::read_part(file));
    parts.back().results.clear(); // only the run that follows needs them
    parts.back().results.shrink_to_fit();
  }
  mc::require_all_parts(parts);
  std::vector<std::string> words = parts.front().command;
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"--part"}, {"--resume"}, {"--every"}, {"--checkpoint"}, {"-o", "--output"}})
    words = without_option(words, names);
  if (!o.output.empty()) words.insert(words.end(), {"-o", o.output});
  if (!o.checkpoint.empty()) words.insert(words.end(), {"--checkpoint", o.checkpoint});
  for (const std::string& file : o.parts) words.insert(words.end(), {"--merged-part", file});
  run_again(words);
}

} // namespace

Subcommand merge_subcommand() {
  return make_subcommand<MergeCommandOptions>(
      {.name = "merge",
       .summary = "Put the parts of a run together, with the bits of a run without parts",
       .examples = {{"carlo merge part1.ckpt part2.ckpt -o cbox.exr",
                     "writes the picture of two parts, as of carlo render cbox --part 1/2 -o part1.ckpt"},
                    {"carlo merge part*.ckpt", "writes the results that the command of the parts names, as --json"},
                    {"carlo merge all.ckpt part*.ckpt -o out --checkpoint all.ckpt",
                     "writes the results, or what the next round of parts needs"}},
       .failure = "the parts must run again, from the file of --checkpoint"},
      rows, run_merge);
}

} // namespace carlo
