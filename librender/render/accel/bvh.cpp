#include <render/accel/bvh.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace render {

/// The ray turned so that its longest axis is z and sheared to (0, 0, 1) [WoopBenthinWald13, section 3].
struct Shear {
  int kx, ky, kz;
  Float sx, sy;

  explicit Shear(const Vec3& d) {
    const Float ax = std::abs(d.x()), ay = std::abs(d.y());
    kz = std::abs(d.z()) > std::max(ax, ay) ? 2 : int(ay > ax); // compiles to no branch
    kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    sx = d[kx] / d[kz], sy = d[ky] / d[kz];
  }
};

/// The ray in double.
struct Line {
  Vec3d o, d;
  double d2, inverse_d2;

  explicit Line(const Ray& ray)
      : o(ray.o.cast<double>()), d(ray.d.cast<double>()), d2(d.squaredNorm()), inverse_d2(1 / d2) {}
};

namespace {

constexpr std::uint32_t few_spheres = 24,
                        few_triangles = 48; // six blocks of triangles cost less than a node and its sorted children

template <class Mask> bool any_lane(const Mask& mask) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask(reinterpret_cast<const __m512i&>(mask)) != 0;
#else
  return (mask[0] | mask[1] | mask[2] | mask[3] | mask[4] | mask[5] | mask[6] | mask[7]) != 0;
#endif
}

template <class Doubles> int lowest_lane(const Doubles& t) {
  const auto lower = [&](int a, int b) { return t[b] < t[a] ? b : a; };
  return lower(lower(lower(0, 1), lower(2, 3)), lower(lower(4, 5), lower(6, 7)));
}

/// Bit i is set where lane i of t lies in (0, t_max).
template <class Doubles> unsigned between(const Doubles& t, double t_max) {
#if defined(__AVX512F__)
  const auto& x = reinterpret_cast<const __m512d&>(t);
  return _mm512_cmp_pd_mask(x, _mm512_setzero_pd(), _CMP_GT_OQ) &
         _mm512_cmp_pd_mask(x, _mm512_set1_pd(t_max), _CMP_LT_OQ);
#else
  unsigned mask = 0;
  for (int i = 0; i < 8; ++i) mask |= static_cast<unsigned>(t[i] > 0 && t[i] < t_max) << i;
  return mask;
#endif
}

template <class Doubles> Doubles square_root(const Doubles& x) {
#if defined(__AVX512F__)
  return reinterpret_cast<const Doubles&>(
      static_cast<const __m512d&>(_mm512_sqrt_pd(reinterpret_cast<const __m512d&>(x))));
#else
  Doubles root;
  for (int i = 0; i < 8; ++i) root[i] = std::sqrt(x[i]); // the compiler packs them
  return root;
#endif
}

Box sphere_box(const Sphere& s) {
  // Rounded outward, so that the float box holds the double sphere.
  Box box;
  for (int a = 0; a < 3; ++a) {
    box.lo[a] = std::nextafter(Float(s.center()[a] - s.radius()), -mc::infinity<Float>);
    box.hi[a] = std::nextafter(Float(s.center()[a] + s.radius()), mc::infinity<Float>);
  }
  return box;
}

// Blocks of primitives: those of a tree's leaves, or full ones without a tree where there are few.
template <class F> WideTree build(const std::vector<Box>& boxes, std::uint32_t lanes, std::uint32_t few, const F& add) {
  if (boxes.size() > few) {
    WideTree tree(boxes, lanes);
    for (const auto& leaf : tree.leaves()) add(tree.order(), leaf);
    return tree;
  }
  const auto count = static_cast<std::uint32_t>(boxes.size());
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::uint32_t first = 0; first < count; first += lanes) add(order, {first, std::min(lanes, count - first)});
  return {};
}

} // namespace

Bvh::Bvh(std::span<const Shape> shapes)
    : Bvh([&] {
        std::vector<const Shape*> all;
        for (const Shape& shape : shapes) all.push_back(&shape);
        return all;
      }()) {}

Bvh::Bvh(std::span<const Shape* const> shapes) {
  std::vector<Box> triangle_boxes, sphere_boxes;
  std::vector<std::array<Vec3, 3>> vertices;
  std::vector<Sphere> spheres;
  std::vector<int> sphere_ids;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (const auto* mesh = std::get_if<TriangleMesh>(shapes[i])) {
      for (std::size_t t = 0; t < mesh->size(); ++t) {
        const auto v = mesh->vertices(t);
        const Vec3d a = v[0].cast<double>();
        if (!(mc::cross<double>(v[1].cast<double>() - a, v[2].cast<double>() - a).squaredNorm() > 0)) continue;
        Box box;
        for (const Vec3& p : v) box.add(p);
        triangle_boxes.push_back(box);
        vertices.push_back(v);
        triangle_ids_.push_back({static_cast<int>(i), static_cast<int>(t)});
      }
    } else {
      spheres.push_back(std::get<Sphere>(*shapes[i]));
      sphere_ids.push_back(static_cast<int>(i));
      sphere_boxes.push_back(sphere_box(spheres.back()));
    }
  }
  for (const Box& b : triangle_boxes) bounds_.add(b);
  for (const Box& b : sphere_boxes) bounds_.add(b);

  const auto add_triangles = [&](const std::vector<std::uint32_t>& order, WideTree::Leaf leaf) {
    TriangleBlock block;
    for (std::uint32_t lane = 0; lane < 8; ++lane) {
      const std::uint32_t id = order[leaf.first + std::min(lane, leaf.count - 1)];
      const auto& v = vertices[id];
      for (std::size_t k = 0; k < 3; ++k)
        for (int a = 0; a < 3; ++a) block.v[k][a][lane] = v[k][a];
      // Differences of floats and their products are all but exact in double; no compensated product is needed.
      const Vec3d p = v[0].cast<double>(), n = mc::cross<double>(v[1].cast<double>() - p, v[2].cast<double>() - p);
      for (int a = 0; a < 3; ++a) block.normal[a][lane] = n[a];
      block.plane[lane] = n.dot(p);
      block.id[lane] = id;
    }
    triangle_blocks_.push_back(block);
  };
  triangle_tree_ = build(triangle_boxes, 8, few_triangles, add_triangles);

  const auto add_spheres = [&](const std::vector<std::uint32_t>& order, WideTree::Leaf leaf) {
    SphereBlock block;
    block.caps = false;
    for (std::uint32_t lane = 0; lane < 8; ++lane) {
      const std::uint32_t id = order[leaf.first + std::min(lane, leaf.count - 1)];
      const Sphere& s = spheres[id];
      for (int a = 0; a < 3; ++a) {
        block.center[a][lane] = s.center()[a];
        block.axis[a][lane] = s.axis()[a];
      }
      block.radius2[lane] = s.radius() * s.radius();
      block.cap[lane] = s.is_cap() ? s.radius() - s.height() : -mc::infinity<double>;
      block.caps |= s.is_cap();
      block.shape[lane] = sphere_ids[id];
    }
    sphere_blocks_.push_back(block);
  };
  sphere_tree_ = build(sphere_boxes, 8, few_spheres, add_spheres);
}

// U, V, W are the signed areas opposite vertices 0, 1, 2 in the sheared frame; all of one sign: inside.
template <bool any>
bool Bvh::intersect_block(const TriangleBlock& block, const Ray& ray, const Shear& shear, Float& t_max,
                          Hit& hit) const {
  Lanes x[3], y[3];
  for (int k = 0; k < 3; ++k) {
    const Lanes z = block.v[k][shear.kz] - ray.o[shear.kz];
    x[k] = (block.v[k][shear.kx] - ray.o[shear.kx]) - shear.sx * z;
    y[k] = (block.v[k][shear.ky] - ray.o[shear.ky]) - shear.sy * z;
  }
  const Lanes u8 = x[2] * y[1] - y[2] * x[1], v8 = x[0] * y[2] - y[0] * x[2], w8 = x[1] * y[0] - y[1] * x[0];
  const Lanes lowest = detail::smaller(u8, detail::smaller(v8, w8)),
              highest = detail::larger(u8, detail::larger(v8, w8));
  unsigned candidates = detail::less_equal(Lanes{}, lowest) | detail::less_equal(highest, Lanes{});
  if (candidates == 0) return false;

  const EightDoubles above = block.plane - (block.normal[0] * double(ray.o[0]) + block.normal[1] * double(ray.o[1]) +
                                            block.normal[2] * double(ray.o[2]));
  const EightDoubles t8 = above / (block.normal[0] * double(ray.d[0]) + block.normal[1] * double(ray.d[1]) +
                                   block.normal[2] * double(ray.d[2]));
  candidates &= between(t8, double(t_max));
  bool found = false;
  for (; candidates != 0; candidates &= candidates - 1) {
    const int lane = __builtin_ctz(candidates);
    const double t = t8[lane];
    if (!(t < double(t_max))) continue;
    double u = double(u8[lane]), v = double(v8[lane]), w = double(w8[lane]);
    if (u == 0 || v == 0 || w == 0) [[unlikely]] {
      // On an edge to float precision: products of floats are exact in double, so both neighbours decide alike.
      const auto edge = [&](int a, int b) {
        return double(x[a][lane]) * double(y[b][lane]) - double(y[a][lane]) * double(x[b][lane]);
      };
      u = edge(2, 1), v = edge(0, 2), w = edge(1, 0);
      if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) continue;
    }
    const double det = u + v + w;
    if (det == 0) continue;
    if constexpr (any) return true;
    t_max = Float(t);
    const TriangleId id = triangle_ids_[block.id[lane]];
    const double inverse = 1 / det;
    hit = {t_max, id.shape, id.prim, Float(v * inverse), Float(w * inverse)};
    found = true;
  }
  return found;
}

// Sphere::intersect, eight at a time.
template <bool any> bool Bvh::intersect_block(const SphereBlock& block, const Line& line, Float& t_max, Hit& hit) {
  const Vec3d& d = line.d;
  const EightDoubles ox = line.o.x() - block.center[0], oy = line.o.y() - block.center[1],
                     oz = line.o.z() - block.center[2];
  const EightDoubles b = -(ox * d.x() + oy * d.y() + oz * d.z()), nearest = b * line.inverse_d2;
  const EightDoubles px = ox + d.x() * nearest, py = oy + d.y() * nearest, pz = oz + d.z() * nearest;
  const EightDoubles discriminant = block.radius2 - (px * px + py * py + pz * pz);
  const auto crossed = discriminant >= 0;
  if (!any_lane(crossed)) return false;

  const EightDoubles root = square_root(crossed ? line.d2 * discriminant : EightDoubles{});
  const EightDoubles q = b < 0 ? b - root : b + root;
  const EightDoubles c = ox * ox + oy * oy + oz * oz - block.radius2;
  const EightDoubles first = q * line.inverse_d2, second = c / q; // q = 0 gives NaN, which is no hit
  const EightDoubles t0 = first < second ? first : second, t1 = first < second ? second : first;
  const double limit = double(t_max);
  auto hit0 = crossed & (t0 > 0) & (t0 < limit), hit1 = crossed & (t1 > 0) & (t1 < limit);
  if (block.caps) {
    const EightDoubles along = block.axis[0] * d.x() + block.axis[1] * d.y() + block.axis[2] * d.z();
    const EightDoubles start = block.axis[0] * ox + block.axis[1] * oy + block.axis[2] * oz;
    hit0 &= start + t0 * along >= block.cap;
    hit1 &= start + t1 * along >= block.cap;
  }
  if constexpr (any) return any_lane(hit0 | hit1);
  const EightDoubles t = hit0 ? t0 : hit1 ? t1 : EightDoubles{} + mc::infinity<double>;
  const int lane = lowest_lane(t);
  if (!(t[lane] < limit)) return false;
  t_max = Float(t[lane]);
  hit = {t_max, block.shape[lane], 0, 0, 0};
  return true;
}

template <bool any> bool Bvh::trace(const Ray& ray, Hit& hit) const {
  constexpr auto order = any ? WideTree::Order::any : WideTree::Order::near_first;
  Float t_max = ray.t_max;
  bool found = false;
  if (!triangle_blocks_.empty()) {
    const Shear shear(ray.d);
    if (triangle_tree_.empty()) {
      for (const TriangleBlock& block : triangle_blocks_) {
        found |= intersect_block<any>(block, ray, shear, t_max, hit);
        if (any && found) return true;
      }
    }
    triangle_tree_.traverse<order>(ray, t_max, [&](std::uint32_t leaf, Float& t) {
      found |= intersect_block<any>(triangle_blocks_[leaf], ray, shear, t, hit);
      return any && found;
    });
    if (any && found) return true;
  }
  if (sphere_blocks_.empty()) return found;
  const Line line(ray);
  if (sphere_tree_.empty()) {
    for (const SphereBlock& block : sphere_blocks_) {
      found |= intersect_block<any>(block, line, t_max, hit);
      if (any && found) return true;
    }
    return found;
  }
  sphere_tree_.traverse<order>(ray, t_max, [&](std::uint32_t leaf, Float& t) {
    found |= intersect_block<any>(sphere_blocks_[leaf], line, t, hit);
    return any && found;
  });
  return found;
}

std::optional<Hit> Bvh::intersect(const Ray& ray) const {
  Hit hit;
  return trace<false>(ray, hit) ? std::optional(hit) : std::nullopt;
}

bool Bvh::occluded(const Ray& ray) const {
  Hit hit;
  return trace<true>(ray, hit);
}

} // namespace render
