#include <input/file_hash.h>
#include <picture/picture.h>
#include <picture/resume.h>
#include <terminal/message.h>

#include <render/film/accumulate.h>
#include <render/io/image/image_io.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace carlo {

namespace {

struct FingerprintEntry {
  const char *key, *words;
};

// Metadata that must agree, in order of comparison.
constexpr auto compared = std::to_array<FingerprintEntry>({
    {"carlo.size", "--size"},
    {"carlo.crop", "--crop"},
    {"carlo.max_depth", "--max-depth"},
    {"carlo.dialect", "--dialect"},
    {"carlo.variables", "-D"},
    {"carlo.finds", "a --strategy that finds"},
    {"carlo.scene_hash", "files of a scene whose bytes have the hash"},
});

constexpr double most_spp = 1e15;
constexpr int most_runs = 1'000'000'000;

// Metadata of which a difference is reported: the average remains right, but no single run has its bits.
constexpr auto noted = std::to_array<FingerprintEntry>({
    {"carlo.sampler", "--sampler"},
    {"carlo.seed", "--seed"},
    {"carlo.commit", "carlo"},
});

} // namespace

RenderFingerprint render_fingerprint(const std::string& file, const std::string& dialect,
                                     std::vector<std::string> variables, const render::SceneFile& read,
                                     const render::RenderOptions& settings, const render::Crop& part) {
  std::sort(variables.begin(), variables.end());
  return {{"carlo.scene", std::filesystem::path(file).filename().string()},
          {"carlo.size", fmt::format("{}x{}", settings.width, settings.height)},
          {"carlo.crop", fmt::format("{},{},{},{}", part.x, part.y, part.width, part.height)},
          {"carlo.max_depth", fmt::format("{}", settings.max_depth)},
          {"carlo.dialect", dialect},
          {"carlo.commit", build_name()},
          {"carlo.sampler", std::string(name(settings.sampler))},
          {"carlo.seed", fmt::format("{}", settings.seed)},
          {"carlo.variables", fmt::format("{}", fmt::join(variables, " "))},
          {"carlo.finds",
           misses_light(read.scene, settings.strategy, settings.max_depth) ? "light towards lamps alone" : "all light"},
          {"carlo.scene_hash", hash_of_files(read.files)}};
}

mc::RunIdentity render_identity(const RenderFingerprint& fingerprint, const render::RenderOptions& settings) {
  mc::RunIdentity identity;
  for (const auto& [key, words] : compared) identity.emplace_back(words, fingerprint.at(key));
  for (const auto& [key, words] : noted) identity.emplace_back(words, fingerprint.at(key));
  const auto word = [](std::optional<bool> on) {
    if (!on) return std::string("chosen");
    return std::string(*on ? "on" : "off");
  };
  identity.emplace_back("--strategy", settings.strategy.name);
  identity.emplace_back("--branches", settings.branches ? fmt::format("{}", *settings.branches) : "chosen");
  identity.emplace_back("the film's quantity", fmt::format("{}", static_cast<int>(settings.aov.kind)));
  identity.emplace_back("--splat", word(settings.splat));
  identity.emplace_back("--tiles", word(settings.tiles));
  identity.emplace_back("--adaptive", word(settings.adaptive));
  if (settings.adaptive)
    identity.emplace_back("--error-of", settings.error_scope == render::ErrorScope::image ? "picture" : "worst");
  // The size of stratified sets follows from the number of samples.
  const bool is_counted = !settings.seconds && !settings.target_error;
  const bool is_fixed = is_counted && settings.sampler == render::PixelSampler::stratified;
  if (is_fixed || (is_counted && settings.spp == 1)) identity.emplace_back("--spp", fmt::format("{}", settings.spp));
  return identity;
}

ResumeState load_resume_state(const std::string& path, const RenderFingerprint& fingerprint, const render::Crop& part,
                              render::RenderOptions& settings) {
  mc::require(mc::lowercase_extension(path) == ".exr",
              "--resume: '{}' is no .exr: other formats do not store radiance with its variance; name an .exr", path);
  mc::require(std::filesystem::exists(path), "--resume: '{}' does not exist; leave out --resume in the first run",
              path);
  ResumeState resume_state{render::read_image(path), 0, 1};
  const auto text = [&](const char* key) {
    const auto found = resume_state.image.metadata.find(key);
    return found == resume_state.image.metadata.end() ? std::string() : found->second;
  };
  mc::require(!text("carlo.samples_per_pixel").empty(),
              "--resume: '{}' does not state its samples per pixel; carlo render has not written it", path);
  resume_state.spp = mc::parse_double(text("carlo.samples_per_pixel")).value_or(0);
  mc::require(resume_state.spp > 0 && resume_state.spp <= most_spp,
              "--resume: '{}' says '{}' samples per pixel; a number in (0, {:g}] is needed", path,
              mc::printable(text("carlo.samples_per_pixel")), most_spp);
  mc::require(text("carlo.unsampled").empty(),
              "--resume: '{}' has pixels without a sample, as its run was interrupted early; render it again", path);
  const double runs = mc::parse_double(text("carlo.runs")).value_or(1);
  mc::require(runs >= 1 && runs <= most_runs && runs == std::floor(runs),
              "--resume: '{}' says '{}' runs; a whole number in [1, {}] is needed", path,
              mc::printable(text("carlo.runs")), most_runs);
  resume_state.runs = static_cast<int>(runs);
  mc::require(text("carlo.scene") == fingerprint.at("carlo.scene"), "--resume: '{}' is a picture of '{}', not of '{}'",
              path, mc::printable(text("carlo.scene")), fingerprint.at("carlo.scene"));
  mc::require(resume_state.image.width == part.width && resume_state.image.height == part.height,
              "--resume: '{}' has {}x{} pixels, but {}x{} are requested", path, resume_state.image.width,
              resume_state.image.height, part.width, part.height);
  for (const auto& [key, words] : compared) {
    mc::require(resume_state.image.metadata.contains(key),
                "--resume: '{}' does not state its {}, which carlo render writes now; render it again", path, key);
    mc::require(text(key) == fingerprint.at(key),
                "--resume: '{}' was rendered with {} '{}', not '{}'; ask for the same, or name another file", path,
                words, mc::printable(text(key)), fingerprint.at(key));
  }
  mc::require(settings.spp > 1 || settings.seconds || resume_state.image.variance.empty(),
              "--resume: one sample has no variance, and '{}' would lose its own; take --spp 2 or more", path);
  for (const auto& [key, words] : noted)
    if (const std::string old = text(key); !old.empty() && old != fingerprint.at(key))
      warn("'{}' was rendered with {} '{}', not '{}'; both are averaged", path, words, old, fingerprint.at(key));
  settings.seed = mc::hash(settings.seed, std::uint64_t(resume_state.runs));
  return resume_state;
}

std::optional<double> spp_of_partial(const std::string& path, const std::map<std::string, std::string>& metadata) {
  try {
    const std::map<std::string, std::string> old = render::read_image(path).metadata;
    const auto is_same = [&](const char* key) {
      return old.contains(key) && metadata.contains(key) && old.at(key) == metadata.at(key);
    };
    const bool is_partial = old.contains("carlo.partial") && is_same("carlo.scene") &&
                            std::all_of(compared.begin(), compared.end(), [&](auto& c) { return is_same(c.key); });
    return is_partial ? mc::parse_double(old.at("carlo.samples_per_pixel")) : std::nullopt;
  } catch (const std::exception&) { // no picture of carlo
    return {};
  }
}

void accumulate_into(const ResumeState& resume_state, render::RenderResult& result) {
  result.image = accumulate(resume_state.image, resume_state.spp, result.image, result.spp);
  result.image.layers = resume_state.image.layers;
  result.image.metadata["carlo.samples_per_pixel"] = fmt::format("{:.17g}", resume_state.spp + result.spp);
  result.image.metadata["carlo.runs"] = fmt::format("{}", resume_state.runs + 1);
}

} // namespace carlo
