#include <render/accel/bvh.h>
#include <render/accel/trees.h>

#include <vector>

namespace render {

namespace {

#if defined(RENDER_TRACE_CHOSEN)
const Bvh::Trace& best_trace() {
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2");
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (!avx2) return trace_baseline;
  return avx512 ? trace_avx512 : trace_avx2;
}
const Bvh::Trace trace = best_trace();
#else
constexpr const Bvh::Trace& trace = trace_native;
#endif

} // namespace

Bvh::Bvh() : Bvh(std::span<const Shape* const>{}) {}

Bvh::Bvh(std::span<const Shape* const> shapes) : trees_(std::make_shared<const Trees>(shapes)) {
  std::apply([&](const auto&... tree) { (bounds_.add(tree.bounds()), ...); }, trees_->kinds());
}

Bvh::Bvh(std::span<const Shape> shapes)
    : Bvh([&] {
        std::vector<const Shape*> all;
        for (const Shape& shape : shapes) all.push_back(&shape);
        return all;
      }()) {}

std::optional<Hit> Bvh::intersect(const Ray& ray) const {
  Hit hit;
  return trace.nearest(*trees_, ray, hit) ? std::optional(hit) : std::nullopt;
}

bool Bvh::occluded(const Ray& ray) const {
  Hit hit;
  return trace.any(*trees_, ray, hit);
}

} // namespace render
