#pragma once
/// Pictures that --resume continues.

#include <render/film/image.h>
#include <render/io/types.h>
#include <render/render.h>

#include <mc/run/checkpoint.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// Metadata that identify the expected picture: only pictures with equal metadata may be averaged.
using RenderFingerprint = std::map<std::string, std::string>;

///   variables : "name=value" of the scene.
///   read      : the scene and the names of its files, which are hashed.
///   part      : the rendered part of the picture.
RenderFingerprint render_fingerprint(const std::string& file, const std::string& dialect,
                                     std::vector<std::string> variables, const render::SceneFile& read,
                                     const render::RenderOptions& settings, const render::Crop& part);

/// Everything that the samples of a render depend on, for its checkpoints. The number of samples belongs to it only
/// where the first samples depend on it, so that most renders may go on with more samples.
mc::RunIdentity render_identity(const RenderFingerprint& fingerprint, const render::RenderOptions& settings);

/// The existing picture, its samples per pixel and its number of runs.
struct ResumeState {
  render::Image image;
  double spp;
  int runs;
};

/// Reads the picture that --resume continues.
///   settings : of the new run; its seed is changed, so that its samples differ from the existing ones.
///   throws   : Error for a missing or incomplete picture, for one with other metadata, naming the difference, and
///              where one more sample would lose the variance.
ResumeState load_resume_state(const std::string& path, const RenderFingerprint& fingerprint, const render::Crop& part,
                              render::RenderOptions& settings);

/// Samples per pixel of a partial picture of the same scene with the same settings. Returns nullopt for any other file,
/// and where there is none.
///   metadata : of the new picture.
std::optional<double> spp_of_partial(const std::string& path, const std::map<std::string, std::string>& metadata);

/// Averages the existing picture with the result of a run, which receives the mean.
void accumulate_into(const ResumeState& resume_state, render::RenderResult& result);

} // namespace carlo
