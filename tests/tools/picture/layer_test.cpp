#include <picture/layer.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <cmath>

namespace {

using carlo::LayerKind;
using render::Float;
using render::Spectrum;
using testing::ElementsAre;
using testing::HasSubstr;

// Two pixels with the layers of carlo render and of another program.
render::Image layered_picture() {
  render::Image image(2, 1);
  image.variance = {Spectrum(1, 2, 3), Spectrum(4, 5, 6)};
  image.layers = {{"N.X", {0, 0}},         {"N.Y", {0, -1}},        {"N.Z", {0, 0}},      {"Z", {2, HUGE_VALF}},
                  {"albedo.R", {1, 2}},    {"albedo.G", {3, 4}},    {"albedo.B", {5, 6}}, {"id", {0, 7}},
                  {"View.Mist.A", {1, 1}}, {"View.Mist.V", {3, 5}}, {"odd.Q", {1, 1}},    {"odd.W", {1, 1}}};
  return image;
}

Spectrum pixel(const std::string& layer, std::size_t i) {
  return carlo::select_layer(layered_picture(), layer, "a.exr").image.pixels.at(i);
}
Spectrum shown(const std::string& name, std::size_t i) {
  carlo::PictureLayer layer = carlo::select_layer(layered_picture(), name, "a.exr");
  carlo::show_layer(layer, name);
  return layer.image.pixels.at(i);
}
void expect_equal(const Spectrum& a, const Spectrum& b) { EXPECT_TRUE((a == b).all()) << a << "\n\n" << b; }

TEST(Layer, Names_AreThoseOfTheirChannels) {
  EXPECT_THAT(carlo::layer_names(layered_picture()),
              ElementsAre("variance", "N", "View.Mist", "Z", "albedo", "id", "odd"));
  EXPECT_THAT(carlo::layer_names(render::Image(1, 1)), ElementsAre());
}

TEST(Layer, Select_CopiesValues) {
  expect_equal(pixel("albedo", 1), Spectrum(2, 4, 6));
  expect_equal(pixel("N", 1), Spectrum(0, -1, 0));
  expect_equal(pixel("N.Y", 1), Spectrum(-1, -1, -1));
  expect_equal(pixel("Z", 0), Spectrum(2, 2, 2));
  expect_equal(pixel("View.Mist", 1), Spectrum(5, 5, 5));
  expect_equal(pixel("variance", 0), Spectrum(1, 2, 3));
  EXPECT_EQ(carlo::select_layer(layered_picture(), "albedo", "a.exr").kind, LayerKind::colour);
  EXPECT_EQ(carlo::select_layer(layered_picture(), "variance", "a.exr").kind, LayerKind::variance);
  EXPECT_EQ(carlo::select_layer(layered_picture(), "albedo.R", "a.exr").kind, LayerKind::data);
  EXPECT_EQ(carlo::select_layer(layered_picture(), "N", "a.exr").kind, LayerKind::data);
}

TEST(Layer, Select_RefusesUnknownNames) {
  const auto refusal = [](const render::Image& image, const std::string& name) {
    return support::error_of([&] { carlo::select_layer(image, name, "a.exr"); });
  };
  EXPECT_EQ(refusal(layered_picture(), "albdo"),
            "--layer albdo: 'a.exr' has no such layer; did you mean 'albedo'?; use one of "
            "variance, N, View.Mist, Z, albedo, id, odd");
  EXPECT_EQ(refusal(layered_picture(), "odd"),
            "--layer odd: the channels odd.Q, odd.W of 'a.exr' are no picture; name one of "
            "them");
  EXPECT_THAT(refusal(render::Image(1, 1), "variance"), HasSubstr("has no layers; carlo render --layers writes them"));
}

TEST(Layer, Show_MapsDataToTheRangeOfAPng) {
  expect_equal(shown("N", 0), Spectrum(0, 0, 0));
  expect_equal(shown("N", 1), Spectrum(Float(0.5), 0, Float(0.5)));
  expect_equal(shown("View.Mist", 0), Spectrum(0, 0, 0));
  expect_equal(shown("View.Mist", 1), Spectrum(1, 1, 1));
  expect_equal(shown("Z", 0), Spectrum(1, 1, 1)); // constant, clamped
  expect_equal(shown("Z", 1), Spectrum(1, 1, 1)); // infinite
  expect_equal(shown("albedo", 1), Spectrum(2, 4, 6));
  expect_equal(shown("variance", 1), Spectrum(4, 5, 6));
  expect_equal(shown("id", 0), Spectrum(0, 0, 0));
  const Spectrum seven = shown("id", 1);
  EXPECT_TRUE((seven >= Float(0.1)).all() && (seven <= 1).all()) << seven;
  EXPECT_NE(seven[0], seven[1]);
}

} // namespace
