#include <render/accel/triangle_block.h>

namespace render {

void TriangleBlock::collect(const Shape& shape, int index, std::vector<Primitive>& found) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  for (std::size_t t = 0; mesh && t < mesh->size(); ++t) {
    const auto v = mesh->vertices(t);
    const Vec3d a = v[0].cast<double>();
    if (!(mc::cross<double>(v[1].cast<double>() - a, v[2].cast<double>() - a).squaredNorm() > 0)) continue;
    found.push_back({v, index, static_cast<int>(t)});
  }
}

} // namespace render
