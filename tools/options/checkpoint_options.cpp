#include <input/file_hash.h>
#include <options/checkpoint_options.h>
#include <options/files.h>
#include <terminal/message.h>
#include <terminal/ranks.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <concepts>
#include <type_traits>

namespace carlo {

namespace {

std::string file_to_write(const CheckpointFiles& files) {
  return files.checkpoint.empty() ? files.resume : files.checkpoint;
}

// The value of an option; "" where it is not given.
std::string text_of(const Option& o) {
  return std::visit(
      [](const auto* field) -> std::string {
        using T = std::remove_cvref_t<decltype(*field)>;
        if constexpr (std::same_as<T, bool>) return *field ? "on" : "";
        else if constexpr (std::same_as<T, std::vector<std::string>>) return fmt::format("{}", fmt::join(*field, " "));
        else if constexpr (requires { field->has_value(); }) return *field ? fmt::format("{}", **field) : "";
        else return fmt::format("{}", *field);
      },
      o.destination);
}

} // namespace

std::vector<Option> checkpoint_rows(CheckpointFiles& files, const std::vector<std::string>& clock) {
  Option part{
      "--part", "K/N", &files.part,
      "Compute share K of N, such as 3/100, and write it to the file of -o, such as part3.ckpt. carlo merge puts "
      "all parts together."};
  for (const std::string& option : clock)
    part.excludes.push_back({option, "the clock would decide differently in every part"});
  Option merged = state_file({"--merged-part", "FILE", &files.merged, "Part of the run, as carlo merge passes it on."});
  merged.hidden = true;
  return {part,
          merged,
          state_file({"--checkpoint", "FILE", &files.checkpoint,
                      "Save the state of the run to this file, from time to time and at its end, so that --resume can "
                      "go on from it. Default: the file of --resume."}),
          {"--every", "TIME", &files.every, "Time between two checkpoints: 90s, 5min, 1h; 0 is as often as possible."}};
}

Option resume_row(CheckpointFiles& files) {
  return state_file({"--resume", "FILE", &files.resume,
                     "Go on from this checkpoint. The results have the bits of a run without an interruption."});
}

double parse_duration(std::string_view option, const std::string& text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
  const std::optional<double> number = mc::parse_double(std::string_view(text).substr(0, end));
  const std::string unit = text.substr(end);
  double scale = 0;
  if (unit.empty() || unit == "s") scale = 1;
  if (unit == "ms") scale = 1e-3;
  if (unit == "min") scale = 60;
  if (unit == "h") scale = 3600;
  mc::require(number && scale > 0 && *number >= 0 && *number * scale <= 1e9,
              "{} '{}' must be a time in [0, 1e9] s, such as 90s, 5min or 1h", option, text);
  return *number * scale;
}

mc::RunIdentity run_identity(const std::vector<Option>& options, const std::set<std::string>& ignored) {
  mc::RunIdentity identity = {{"the build", fmt::format("{} ({})", version, commit)}};
  for (const Option& o : options) {
    const std::string name = o.names.substr(o.names.find(',') + 1);
    const bool is_output = o.use != FileUse::none && o.use != FileUse::input;
    const std::string text = text_of(o);
    const bool is_share = name == "--part" || name == "--merged-part";
    if (is_output || is_share || text.empty() || ignored.contains(name)) continue;
    const std::string hash = o.use == FileUse::input ? hash_of_files({text}) : "";
    if (hash.empty()) identity.emplace_back(name, text);
    else identity.emplace_back("the content of the file of " + name, hash);
  }
  return identity;
}

std::unique_ptr<mc::Checkpoint> open_checkpoint(const CheckpointFiles& files, mc::RunIdentity identity) {
  mc::CheckpointOptions options{
      .file = rank() == 0 ? file_to_write(files) : "", // the others read the same file
      .every = parse_duration("--every", files.every),
      .resume = files.resume,
      .warn = [](const std::string& text) { warn("{}; the checkpoint before it stays, and the run goes on", text); }};
  if (options.file.empty() && options.resume.empty()) return nullptr;
  const auto open = [&] { return std::make_unique<mc::Checkpoint>(std::move(options), std::move(identity)); };
  return files.resume.empty() ? open() : mc::with_context("--resume", open);
}

void print_how_to_resume(const CheckpointFiles& files) {
  if (const std::string file = file_to_write(files); !file.empty())
    print_message(fmt::format("--resume '{}' goes on from here", file));
}

} // namespace carlo
