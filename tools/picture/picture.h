#pragma once
/// Texts and metadata of every picture that carlo renders.

#include <render/io/mitsuba/mitsuba.h>
#include <render/render.h>

#include <cstdint>
#include <optional>
#include <string>

namespace carlo {

/// The origin of a picture.
struct Provenance {
  std::string scene;   ///< its file or name
  std::string command; ///< the command line
  std::uint64_t seed = 0;
};

/// "" where every sample was finite; else the number of bad samples, and the place of the first.
std::string invalid_samples_text(const render::RenderResult& result, const Provenance& from);

/// The progress of a partial render: "interrupted before the end", or "interrupted in its first pass: 122 of 768 rows
/// were rendered, the others repeat the nearest".
std::string interruption_text(const render::RenderResult& result);

/// Version and commit of this carlo, "0.2.0 (1a2b3c4)".
std::string build_name();

/// Writes scene, command, commit, seed, samples and progress into the picture's metadata.
void add_metadata(render::RenderResult& result, const Provenance& from);

/// Warns on stderr where the precision or the range of Float is insufficient for the scene.
void warn_if_imprecise(const std::string& path, const render::Scene& scene);
/// Warns on stderr where a scene means something else in Mitsuba.
void warn_about_scene_file(const render::SceneFile& file);

/// Names a light and a surface of which a strategy misses light (missing_light()); "" if it misses none.
std::string missing_light_text(const render::SceneFile& file, const render::Strategy& strategy, int max_depth);

/// "881 ksamples/s" of a render.
std::string samples_per_second(const render::RenderResult& result);

/// "1.23 % (worst block 2.34 %)", or "unknown (one sample per pixel)".
std::string format_error(const render::RenderResult& result);

/// Three lines of at most 80 columns if the file name is short: size and time, error, rates. An interrupted render
/// begins with "PARTIAL: ...". A last sentence explains why a run ended before its target error.
///   file         : the written picture.
///   target_error : the requested error, if any.
std::string render_summary(const std::string& file, const render::RenderResult& result,
                           const std::optional<double>& target_error);

} // namespace carlo
