#pragma once
/// What the plugins of one scene file share: its folder, its dialect, and what has an id.

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
#include <vector>

namespace render::mitsuba {

/// Whether a <scene> is written for Mitsuba 2 or 3, by its version: 2.x or 3.x; else 0.4 to 0.6, or none at all.
///   throws : Error for any other version
bool is_mitsuba_2_scene(const XmlElement& scene);

/// Filled while a scene is read. `root` must outlive it.
class Context {
 public:
  /// origin : the point of the file that becomes the origin of the scene
  /// throws : Error for two elements of the same id
  Context(const XmlElement& root, Dialect dialect, const Vec3d& origin);

  Dialect dialect() const { return dialect_; }
  /// Whether the scene means what it does in Mitsuba 2 and 3: by its version, unless lajolla is to read it.
  bool is_mitsuba_2() const { return is_mitsuba_2_; }
  /// The light that the spectra of what reflects are seen in.
  Illuminant illuminant() const { return is_mitsuba_2_ ? Illuminant::d65 : Illuminant::equal_energy; }
  /// What spectra are beyond their samples.
  Extrapolation extrapolation() const;
  const Vec3d& origin() const { return origin_; }

  /// Where the files are that the scene names.
  FileResolver folders;

  /// The element itself, or the one whose id a <ref> names.
  ///   throws : Error for an unknown id, naming the nearest, or when it is no <tag>, naming what it is
  const XmlElement& resolve(const XmlElement& element, std::string_view tag) const;

  /// The BSDF that a <bsdf> describes or a <ref> names.
  ///   throws : Error for what cannot be read and for references that lead in a circle
  Material read_bsdf(const XmlElement& element);
  /// The same, added to the scene when first met.
  BsdfId bsdf(const XmlElement& element);
  /// The BSDF of shapes that name none: diffuse, and of lamps black.
  BsdfId default_bsdf(bool is_lamp);

  /// The texture that a <texture> describes or a <ref> names.
  Texture texture(const XmlElement& element);
  /// The picture in a file, read when first asked for.
  ///   throws : what read_image throws
  std::shared_ptr<const Texels> picture(const std::string& path);

  /// The path of a file that the scene names.
  std::string file(const std::string& name);
  const std::set<std::string>& files() const { return files_; }

  /// Notes once what an element means here that it does not mean elsewhere.
  void warn(const XmlElement& element, const std::string& what);
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The scene as far as it is read.
  SceneBuilder builder;

 private:
  void collect_ids(const XmlElement& element);

  Dialect dialect_;
  bool is_mitsuba_2_;
  Vec3d origin_;
  std::map<std::string, const XmlElement*> ids_;
  std::map<const XmlElement*, BsdfId> bsdfs_;
  std::array<std::optional<BsdfId>, 2> default_bsdfs_; ///< of other shapes and of lamps
  std::set<const XmlElement*> being_read_;
  std::map<const XmlElement*, Texture> textures_;
  std::map<std::string, std::shared_ptr<const Texels>> pictures_;
  std::set<std::string> files_;
  std::vector<std::string> warnings_;
};

} // namespace render::mitsuba
