// What the rays do, once for each instruction set that CMakeLists.txt names by RENDER_TRACE. All of it is inlined here:
// a function of a header that stood beside the others' would be called by machines that cannot run it.
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
