// Renders a sphere in hazy sunshine: picture FILE.exr | FILE.png
#include "direct_light.h"
#include "hazy_sun.h"

#include <render/io/image/image_io.h>

int main(int count, char** arguments) {
  using namespace render;
  constexpr int width = 160, height = 120, samples = 16;
  const Scene scene = sphere_on_ground();
  const HazySun sun(Vec3(-2, 3, 2).normalized(), 60, {6, 5, 4});
  const Vec2 tan_half = scene.camera().tan_half(Float(width) / height);
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      mc::Pcg random(1, std::uint64_t(y * width + x)); // a stream for each pixel
      for (int i = 0; i < samples; ++i) {
        const Vec2 at = Vec2(Float(x), Float(y)) + random.point<Float, 2>();
        const Ray ray = scene.camera().ray({at[0] / width, at[1] / height}, tan_half, Vec2::Zero());
        image.at(x, y) += direct_light(scene, sun, ray, random, Technique::mis) / samples;
      }
    }
  write_image(count > 1 ? arguments[1] : "hazy_sun.png", image);
}
