#include <render/io/image/image_io.h>
#include <render/io/mitsuba/context.h>
#include <render/io/mitsuba/plugins.h>

#include <mc/core/text.h>

#include <algorithm>

namespace render::mitsuba {

namespace {

// "line 14", or "base.xml:14" for an element of another file than the reader of the message is in.
std::string place_of(const XmlElement& element, const XmlElement& reader) {
  return element.file == reader.file ? fmt::format("line {}", element.line) : element.where();
}

} // namespace

bool is_mitsuba_2_scene(const XmlElement& scene) {
  const std::string version = scene.attribute_or("version", "0.6.0");
  for (const std::string_view known : {"0.4", "0.5", "0.6", "2", "3"}) {
    const std::string_view rest = std::string_view(version).substr(std::min(known.size(), version.size()));
    if (!version.starts_with(known) || rest.find_first_not_of(".0123456789") != std::string_view::npos) continue;
    if (rest.empty() || (rest.starts_with('.') && !rest.ends_with('.'))) return known.size() == 1;
  }
  scene.fail(
      fmt::format("version \"{}\" is not known; say 0.6.0, or 0.4 or 0.5, for a scene that means what it does in "
                  "Mitsuba 0.6 or lajolla, 2.0.0 or 3.0.0 for one of Mitsuba 2 or 3",
                  version));
}

Context::Context(const XmlElement& root, Dialect dialect, const Vec3d& origin)
    : folders(root), dialect_(dialect), is_mitsuba_2_(is_mitsuba_2_scene(root) && dialect == Dialect::mitsuba),
      origin_(origin) {
  collect_ids(root);
}

Extrapolation Context::extrapolation() const {
  if (dialect_ == Dialect::lajolla) return Extrapolation::constant;
  return is_mitsuba_2_ ? Extrapolation::zero : Extrapolation::ramp;
}

void Context::collect_ids(const XmlElement& element) {
  for (const XmlElement& child : element.children) {
    if (child.tag != "ref" && child.tag != "alias" && child.has("id")) {
      const std::string& id = child.attribute("id");
      const auto [first, added] = ids_.try_emplace(id, &child);
      if (!added)
        child.fail(fmt::format("a second element with the id '{}', after {}; ids must differ", id,
                               place_of(*first->second, child)));
    }
    if (child.tag == "ref") referenced_.insert(child.attribute_or("id", ""));
    collect_ids(child);
  }
}

const XmlElement& Context::resolve(const XmlElement& element, const std::vector<std::string>& tags) const {
  if (element.tag != "ref") return element;
  const std::string& id = element.attribute("id");
  const auto is_allowed = [&](const XmlElement& e) { return std::find(tags.begin(), tags.end(), e.tag) != tags.end(); };
  const auto found = ids_.find(id);
  if (found != ids_.end() && is_allowed(*found->second)) return *found->second;
  if (found != ids_.end())
    element.fail(fmt::format("'{}' is the <{}> of {}; a <ref> stands here for a <{}> alone", id, found->second->tag,
                             place_of(*found->second, element), fmt::join(tags, "> or <")));
  std::vector<std::string_view> known;
  for (const auto& [name, target] : ids_)
    if (is_allowed(*target)) known.push_back(name);
  element.fail(fmt::format("no <{}> has the id '{}'{}", fmt::join(tags, "> or <"), id, mc::did_you_mean(id, known)));
}

std::string_view Context::tag_of(const XmlElement& element) const {
  if (element.tag != "ref") return element.tag;
  const auto found = ids_.find(element.attribute("id"));
  return found == ids_.end() ? std::string_view("ref") : std::string_view(found->second->tag);
}

Material Context::read_bsdf(const XmlElement& element) {
  const XmlElement& target = resolve(element, {"bsdf"});
  if (!being_read_.insert(&target).second)
    element.fail(fmt::format("'{}' leads back to the <bsdf> of {}, in which it stands", element.attribute_or("id", ""),
                             place_of(target, element)));
  constexpr std::size_t deepest = 256;
  if (being_read_.size() > deepest)
    element.fail(fmt::format("references to <bsdf>s stand in one another more than {} deep; flatten them", deepest));
  Material material = read_plugin(bsdf_plugins(), target, *this);
  being_read_.erase(&target);
  return material;
}

BsdfId Context::bsdf(const XmlElement& element) {
  const XmlElement& target = resolve(element, {"bsdf"});
  const auto known = bsdfs_.find(&target);
  if (known != bsdfs_.end()) return known->second;
  Material material = read_bsdf(element);
  if (dialect_ == Dialect::lajolla) material.one_sided = false;
  const BsdfId id = builder.add(std::move(material));
  bsdfs_.emplace(&target, id);
  return id;
}

Texture Context::texture(const XmlElement& element) {
  const XmlElement& target = resolve(element, {"texture"});
  const auto known = textures_.find(&target);
  if (known != textures_.end()) return known->second;
  return textures_.emplace(&target, read_plugin(texture_plugins(), target, *this)).first->second;
}

std::shared_ptr<const Texels> Context::picture(const std::string& path, const std::optional<Transfer>& transfer) {
  std::shared_ptr<const Texels>& picture = pictures_[{path, transfer ? transfer->gamma.value_or(-1) : 0}];
  if (!picture) {
    Image image = read_image(path, transfer);
    picture = std::make_shared<const Texels>(image.width, image.height, std::move(image.pixels), path);
  }
  return picture;
}

std::string Context::file(const std::string& name) {
  std::string path = folders.find(name);
  files_.insert(path);
  return path;
}

void Context::warn(const XmlElement& element, const std::string& what) {
  std::string text = fmt::format("{}: <{}>: {}", element.where(), element.tag, what);
  if (std::find(warnings_.begin(), warnings_.end(), text) == warnings_.end()) warnings_.push_back(std::move(text));
}

BsdfId Context::default_bsdf(bool is_lamp) {
  std::optional<BsdfId>& bsdf = default_bsdfs_[is_lamp ? 1 : 0];
  if (!bsdf) {
    Material material(Bsdf(is_lamp ? Lambert(Spectrum::Zero()) : Lambert()));
    material.one_sided = dialect_ == Dialect::mitsuba;
    bsdf = builder.add(std::move(material));
  }
  return *bsdf;
}

BsdfId Context::invisible_material() {
  if (!invisible_material_) invisible_material_ = builder.add(Material::invisible());
  return *invisible_material_;
}

} // namespace render::mitsuba
