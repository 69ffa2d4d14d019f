#include <render/io/mitsuba/plugins.h>

namespace render::mitsuba {

namespace {

// Scale and offset of the texture coordinates of a shape.
struct Moved {
  Vec2d scale = Vec2d::Ones(), offset = Vec2d::Zero();
};

Moved moved_of(const XmlElement& e, Context&) {
  const Transform t = transform_of(e);
  const auto& m = t.linear;
  if (m(0, 1) != 0 || m(1, 0) != 0 || m(0, 2) != 0 || m(1, 2) != 0)
    e.fail("only what scales and translates u and v is supported");
  return {{m(0, 0), m(1, 1)}, t.translation.head<2>()};
}

// Filters, in the order of their names in filterType.
constexpr TexelFilter filters[] = {TexelFilter::bilinear, TexelFilter::trilinear, TexelFilter::trilinear,
                                   TexelFilter::nearest};

struct Repeats {
  std::optional<double> u, v, both;
};

UvMap make_uv_map(const Repeats& repeats, double uoffset, double voffset, const Moved& first) {
  const auto& [u, v, both] = repeats;
  mc::require(!both || (!u && !v), "give uvscale, or uscale and vscale, not both");
  const Vec2d scale(both.value_or(u.value_or(1)), both.value_or(v.value_or(1)));
  return UvMap(scale.cwiseProduct(first.scale), scale.cwiseProduct(first.offset) + Vec2d(uoffset, voffset));
}

// The meaning of the codes of a picture: by the file, unless raw or gamma is given.
std::optional<Transfer> transfer_of(bool raw, const std::optional<double>& gamma) {
  mc::require(!raw || !gamma || *gamma == 1, "raw means a gamma of 1, not {}; leave one of them out",
              gamma.value_or(1));
  mc::require(!gamma || *gamma > 0 || *gamma == -1, "gamma {} must be > 0, or -1 for the sRGB curve",
              gamma.value_or(1));
  if (raw) return Transfer{1.0};
  if (!gamma) return {};
  return *gamma == -1 ? Transfer() : Transfer{*gamma};
}

Texture make_bitmap(const UvMap& map, std::size_t wrap, std::size_t filter, bool raw,
                    const std::optional<double>& gamma, const PictureSource& picture) {
  constexpr Wrap wraps[] = {Wrap::repeat, Wrap::clamp, Wrap::mirror};
  return Bitmap(picture(transfer_of(raw, gamma)), map, wraps[wrap], filters[filter]);
}

Texture make_checkerboard(const UvMap& map, const Spectrum& color0, const Spectrum& color1) {
  return Checkerboard(color0, color1, map);
}

Parameter<Moved> to_uv() {
  const Parameter<Moved> p{{"to_uv",
                            "transform",
                            "",
                            {"transform"},
                            "of u and v before these: as in Mitsuba 3, but only scale and translate"},
                           moved_of};
  return p.with_default({}, "identity");
}

template <class Make> struct OnSurface {
  Make make;
  template <class... Values>
  Texture operator()(const std::optional<double>& uscale, const std::optional<double>& vscale,
                     const std::optional<double>& uvscale, double uoffset, double voffset, const Moved& first,
                     const Values&... values) const {
    return make(make_uv_map({uscale, vscale, uvscale}, uoffset, voffset, first), values...);
  }
};

// A row for a texture, with the parameters common to all textures.
template <class Make, class... V>
Plugin<Texture> texture_plugin(std::string name, std::string meaning, Make make, const Parameter<V>&... parameters) {
  const auto repeats = [](const std::string& of, const std::string& along) {
    return optional(number(of, "", "how often it repeats along " + along));
  };
  return plugin<Texture>(std::move(name), std::move(meaning), OnSurface<Make>{make},
                         repeats("uscale", "u").with_default(std::nullopt, "1"),
                         repeats("vscale", "v").with_default(std::nullopt, "1"),
                         repeats("uvscale", "both, instead of these").lajolla_only("uscale and vscale"),
                         number("uoffset", "periods", 0, "added to u after that"),
                         number("voffset", "periods", 0, "added to v after that"), to_uv(), parameters...);
}

} // namespace

const Plugins<Texture>& texture_plugins() {
  static const Plugins<Texture> rows = {
      texture_plugin(
          "bitmap", "a picture, bilinear between its texels; 8 bits are decoded by the sRGB curve, or a PNG's gAMA",
          make_bitmap, choice("wrapMode", {"repeat", "clamp", "mirror"}, "beyond its edges", 0),
          choice(
              "filterType", {"bilinear", "trilinear", "ewa", "nearest"},
              "between its texels; trilinear also averages over the footprint of the path, which is faster to a given "
              "noise and blurs a little; ewa is trilinear here",
              0)
              .with_lajolla_default(1, "trilinear"),
          boolean("raw", "whether the codes of the picture are linear, as gamma 1"),
          optional(number("gamma", "", "exponent that decodes the codes, 1: linear; -1: the sRGB curve"))
              .with_default(std::nullopt, "by the file"),
          encoded_picture("filename", "the picture: .png, .jpg, .exr, .hdr, .pfm, .bmp, .tga, .ppm or .pgm")),
      texture_plugin("checkerboard", "two by two squares in a period", make_checkerboard,
                     reflectance("color0", "of the squares at (0, 0) and (1/2, 1/2)", Spectrum::Constant(Float(0.4))),
                     reflectance("color1", "of the other two", Spectrum::Constant(Float(0.2)))),
  };
  return rows;
}

} // namespace render::mitsuba
