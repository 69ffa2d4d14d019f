#pragma once
/// State shared by the plugins of one scene file: folders, dialect and named elements.

#include <render/io/image/transfer.h>
#include <render/io/mitsuba/file_resolver.h>
#include <render/io/mitsuba/mitsuba.h>
#include <render/io/spectrum.h>
#include <render/io/xml.h>
#include <render/scene/builder.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace render::mitsuba {

/// Whether a <scene> has the version of Mitsuba 2 or 3 (2.x or 3.x). False for versions 0.4 to 0.6 and without a
/// version.
///   throws : Error for any other version.
bool is_mitsuba_2_scene(const XmlElement& scene);

/// State of the reader of one scene. `root` must outlive it.
class Context {
 public:
  /// Collects the ids below `root`.
  ///   origin : the point of the file that becomes the origin of the scene.
  ///   throws : Error for two elements with the same id.
  Context(const XmlElement& root, Dialect dialect, const Vec3d& origin);

  /// The dialect of the scene.
  Dialect dialect() const { return dialect_; }
  /// Whether the scene follows the conventions of Mitsuba 2 and 3: by its version, unless the dialect is lajolla.
  bool is_mitsuba_2() const { return is_mitsuba_2_; }
  /// Illuminant of reflectance spectra.
  Illuminant illuminant() const { return is_mitsuba_2_ ? Illuminant::d65 : Illuminant::equal_energy; }
  /// Values of spectra beyond their samples.
  Extrapolation extrapolation() const;
  /// The point of the file that becomes the origin of the scene.
  const Vec3d& origin() const { return origin_; }

  /// Folders searched for the files of the scene.
  FileResolver folders;

  /// The element itself, or, for a <ref>, the element with the referenced id.
  ///   tags   : tags that the element with this id may have.
  ///   throws : Error for an unknown id, with the most similar id, or for another tag, with the place of the element.
  const XmlElement& resolve(const XmlElement& element, const std::vector<std::string>& tags) const;
  /// Tag of the element itself, or, for a <ref>, of the element with the referenced id; "ref" for an unknown id.
  std::string_view tag_of(const XmlElement& element) const;
  /// Whether a <ref> of the scene names the id of this element.
  bool is_referenced(const XmlElement& element) const { return referenced_.contains(element.attribute_or("id", "")); }

  /// Reads the BSDF that a <bsdf> describes or a <ref> references.
  ///   throws : Error for an invalid BSDF and for circular references.
  Material read_bsdf(const XmlElement& element);
  /// Reads the same BSDF and adds it to the scene, once per element.
  BsdfId bsdf(const XmlElement& element);
  /// Default BSDF of shapes without one: diffuse, or black for lamps.
  BsdfId default_bsdf(bool is_lamp);
  /// Material of shapes that are boundaries of media alone.
  BsdfId invisible_material();

  /// The texture that a <texture> describes or a <ref> references.
  Texture texture(const XmlElement& element);
  /// The image in a file, read on first use.
  ///   throws : the errors of read_image.
  std::shared_ptr<const Texels> picture(const std::string& path, const std::optional<Transfer>& transfer = {});

  /// Path of a file that the scene refers to; recorded in files().
  std::string file(const std::string& name);
  /// All files that were requested.
  const std::set<std::string>& files() const { return files_; }

  /// Adds a warning for an element, once.
  void warn(const XmlElement& element, const std::string& what);
  /// All warnings, with their places.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The scene so far.
  SceneBuilder builder;

 private:
  void collect_ids(const XmlElement& element);

  Dialect dialect_;
  bool is_mitsuba_2_;
  Vec3d origin_;
  std::map<std::string, const XmlElement*> ids_;
  std::set<std::string> referenced_;
  std::map<const XmlElement*, BsdfId> bsdfs_;
  std::array<std::optional<BsdfId>, 2> default_bsdfs_; ///< for other shapes, and for lamps
  std::optional<BsdfId> invisible_material_;
  std::set<const XmlElement*> being_read_;
  std::map<const XmlElement*, Texture> textures_;
  /// By path and meaning of the codes: 0 as the file says, -1 sRGB, or the exponent.
  std::map<std::pair<std::string, double>, std::shared_ptr<const Texels>> pictures_;
  std::set<std::string> files_;
  std::vector<std::string> warnings_;
};

} // namespace render::mitsuba
