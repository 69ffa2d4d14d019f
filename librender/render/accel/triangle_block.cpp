#include <render/accel/triangle_block.h>

namespace render {

auto TriangleBlock::collect(const TriangleMesh& mesh, int index, std::size_t begin, std::size_t end, Primitive* to)
    -> Primitive* {
  for (std::size_t t = begin; t < end; ++t) {
    const auto v = mesh.vertices(t);
    const Vec3d a = v[0].cast<double>();
    if (mc::cross<double>(v[1].cast<double>() - a, v[2].cast<double>() - a).squaredNorm() > 0)
      *to++ = {&mesh, index, static_cast<int>(t)};
  }
  return to;
}

} // namespace render
