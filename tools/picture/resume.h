#pragma once
/// Pictures that --resume goes on with.

#include <render/film/image.h>
#include <render/io/types.h>
#include <render/render.h>

#include <map>
#include <string>
#include <vector>

namespace carlo {

/// What a picture shows, whatever its noise, as an image's metadata: only pictures of the same may be averaged.
using PictureOf = std::map<std::string, std::string>;

/// `read` is what was read from the scene file, with `variables` "name=value", and from the files that it names, whose
/// bytes count too; `part` is what is rendered of it.
PictureOf picture_of(const std::string& file, const std::string& dialect, std::vector<std::string> variables,
                     const ::render::SceneFile& read, const ::render::RenderOptions& settings,
                     const ::render::Crop& part);

/// A picture that goes on.
struct Begun {
  ::render::Image image;
  double spp;
  int runs;
};

/// What --resume adds to, as sign() has signed it.
///   settings : of the run that adds to it, which gets a seed of its own: other samples than those that are there
///   throws   : Error where there is none, where it shows something else, naming what differs, where not all of it was
///              rendered, and where one sample more would lose its variance
Begun begun_picture(const std::string& path, const PictureOf& picture, const ::render::Crop& part,
                    ::render::RenderOptions& settings);

/// The picture that was begun with what a run has added.
void add_to(const Begun& begun, ::render::RenderResult& result);

} // namespace carlo
