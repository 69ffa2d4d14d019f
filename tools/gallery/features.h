#pragma once
/// Which scene of the gallery requires which feature. A feature is a plugin of the scene reader, or a strategy.

#include <gallery/scenes.h>

#include <string>
#include <vector>

namespace carlo {

/// A feature as words: "bsdf dielectric", "strategy mixture". A kind whose plugins all mean the same is one feature:
/// "sampler".
using Feature = std::string;

/// Everything that a scene may ask for, in the order of the reference.
std::vector<Feature> all_features();

/// What a scene of the gallery asks for, in the same order.
///   throws : Error where its file cannot be read
std::vector<Feature> features_of(const GalleryScene& scene);

/// A table of the kinds of features: each with the number of the scenes that require it, or the only one.
std::string features_text();

/// The scenes with their sources, and the table of features with the scenes that require them, as Markdown.
std::string gallery_text();

} // namespace carlo
