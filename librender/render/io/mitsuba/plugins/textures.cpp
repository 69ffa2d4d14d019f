#include <render/io/mitsuba/plugins/plugins.h>

namespace render::mitsuba {

namespace {

Texture make_bitmap(double uscale, double vscale, double uoffset, double voffset,
                    const std::shared_ptr<const Texels>& texels) {
  return Bitmap(texels, UvMap({uscale, vscale}, {uoffset, voffset}));
}

Texture make_checkerboard(double uscale, double vscale, double uoffset, double voffset, const Spectrum& color0,
                          const Spectrum& color1) {
  return Checkerboard(color0, color1, UvMap({uscale, vscale}, {uoffset, voffset}));
}

// A row for a texture, with the parameters that all textures have.
template <class Make, class... V>
Plugin<Texture> texture_plugin(std::string name, std::string meaning, Make make, const Parameter<V>&... parameters) {
  return plugin<Texture>(
      std::move(name), std::move(meaning), make, number("uscale", "", 1, "how often it repeats along u"),
      number("vscale", "", 1, "how often it repeats along v"), number("uoffset", "periods", 0, "added to u after that"),
      number("voffset", "periods", 0, "added to v after that"), parameters...);
}

} // namespace

const Plugins<Texture>& texture_plugins() {
  static const Plugins<Texture> rows = {
      texture_plugin("bitmap", "a picture, bilinear between its texels, repeated; 8 bits are decoded by the sRGB curve",
                     make_bitmap, picture("filename", "the picture: .png, .jpg, .exr, .hdr or .pfm")),
      texture_plugin("checkerboard", "two by two squares in a period", make_checkerboard,
                     color("color0", "", "of the squares at (0, 0) and (1/2, 1/2)", Spectrum::Constant(Float(0.4))),
                     color("color1", "", "of the other two", Spectrum::Constant(Float(0.2)))),
  };
  return rows;
}

} // namespace render::mitsuba
