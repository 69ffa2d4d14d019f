// Ray traversal, compiled once for each instruction set that CMakeLists.txt names by RENDER_TRACE. All of it is inlined
// here. An out-of-line function from a header could be shared between the copies, and machines without its instructions
// would call it.
#include <render/accel/trees.h>

namespace render {

namespace {

[[gnu::flatten]] bool nearest(const Bvh::Trees& trees, const Ray& ray, Hit& hit) {
  return trees.trace<false>(ray, hit);
}
[[gnu::flatten]] bool any(const Bvh::Trees& trees, const Ray& ray, Hit& hit) { return trees.trace<true>(ray, hit); }

} // namespace

extern constexpr Bvh::Trace RENDER_TRACE{nearest, any};

} // namespace render
