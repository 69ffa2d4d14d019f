#pragma once
/// Lists which scene of the gallery requires which feature. A feature is a plugin of the scene reader, or a strategy.

#include <gallery/scenes.h>

#include <string>
#include <vector>

namespace carlo {

/// A feature as words: "bsdf dielectric", "strategy mixture". A kind in which all plugins mean the same is one feature:
/// "sampler".
using Feature = std::string;

/// Everything that a scene may require, in the order of the reference.
std::vector<Feature> all_features();

/// The features that a scene of the gallery requires, in the same order.
///   throws : Error if its file cannot be read.
std::vector<Feature> features_of(const GalleryScene& scene);

/// Markdown with the scenes, their sources, and the table of features with the scenes that require them.
std::string gallery_text();

} // namespace carlo
