#include <known_bugs/cornell.h>

#include <known_bugs/test_cases.h>

#include <mc/core/frame.h>
#include <mc/core/parallel.h>
#include <mc/estimate/moments.h>
#include <mc/random/hash.h>

namespace carlo {
namespace {

using V = Direction;
using mc::Pcg;

struct Hit {
  double t = HUGE_VAL;
  V p = V::Zero(), n = V::Zero(), albedo = V::Zero();
  bool light = false;
};

// The light: y = 554, x in [213, 343], z in [227, 332], shining down.
constexpr double light_y = 554, light_x0 = 213, light_x1 = 343, light_z0 = 227, light_z1 = 332, radiance = 15;

// Where a line crosses the surface of the box [0, size], and the axes of the faces there. It misses the box unless
// near < far.
struct Crossing {
  double near = -HUGE_VAL, far = HUGE_VAL;
  int near_axis = 0, far_axis = 0;
  Crossing(const V& o, const V& d, const V& size) {
    for (int i = 0; i < 3; ++i) {
      const double inverse = 1 / d[i], a = -o[i] * inverse, b = (size[i] - o[i]) * inverse;
      if (std::min(a, b) > near) {
        near = std::min(a, b);
        near_axis = i;
      }
      if (std::max(a, b) < far) {
        far = std::max(a, b);
        far_axis = i;
      }
    }
  }
};

// The normal of a face across `axis` that a ray along d meets.
V against(const V& d, int axis) {
  V n = V::Zero();
  n[axis] = d[axis] > 0 ? -1 : 1;
  return n;
}

constexpr double shortest = 1e-3; // a ray starts on a surface

// A box rotated about y, then translated.
struct Block {
  double cos, sin;
  V corner, size;
  Block(double degrees, const V& at, const V& extent)
      : cos(std::cos(degrees * pi / 180)), sin(std::sin(degrees * pi / 180)), corner(at), size(extent) {}
  V to_world(const V& v) const { return {cos * v.x() + sin * v.z(), v.y(), -sin * v.x() + cos * v.z()}; }
  V to_local(const V& v) const { return {cos * v.x() - sin * v.z(), v.y(), sin * v.x() + cos * v.z()}; }

  void intersect(const V& o, const V& d, Hit& hit) const {
    const V local = to_local(d);
    const Crossing box(to_local(o - corner), local, size);
    if (!(box.near > shortest && box.near < std::min(box.far, hit.t))) return;
    hit = {box.near, o + box.near * d, to_world(against(local, box.near_axis)), V::Constant(0.73), false};
  }
};

// Rays start inside the room, or outside where they meet it only through its open front z = 0.
Hit intersect(const V& o, const V& d) {
  static const Block blocks[] = {{15, V(265, 0, 295), V(165, 330, 165)}, {-18, V(130, 0, 65), V(165, 165, 165)}};
  static const V white = V::Constant(0.73), green(0.12, 0.45, 0.15), red(0.65, 0.05, 0.05);
  Hit hit;
  const Crossing room(o, d, V::Constant(555));
  const int axis = room.far_axis;
  const bool leaves = axis == 2 && d.z() < 0;
  const V& side = d.x() > 0 ? green : red;
  if (room.near < room.far && !leaves)
    hit = {room.far, o + room.far * d, against(d, axis), axis == 0 ? side : white, false};
  for (const Block& b : blocks) b.intersect(o, d, hit);
  const double t = (light_y - o.y()) / d.y();
  if (t > shortest && t < hit.t) {
    const V p = o + t * d;
    if (p.x() >= light_x0 && p.x() <= light_x1 && p.z() >= light_z0 && p.z() <= light_z1)
      hit = {t, p, V(0, d.y() > 0 ? -1 : 1, 0), V::Zero(), true};
  }
  return hit;
}

V toward_light(const V& p, Pcg& r) {
  const V q{light_x0 + (light_x1 - light_x0) * uniform(r), light_y, light_z0 + (light_z1 - light_z0) * uniform(r)};
  return (q - p).normalized();
}

double toward_light_pdf(const V& p, const V& w) {
  const double t = (light_y - p.y()) / w.y();
  if (!(t > 1e-3)) return 0;
  const V q = p + t * w;
  if (!(q.x() >= light_x0 && q.x() <= light_x1 && q.z() >= light_z0 && q.z() <= light_z1)) return 0;
  return t * t / (std::abs(w.y()) * (light_x1 - light_x0) * (light_z1 - light_z0));
}

V doubled_cosine(Pcg& r) {
  const double phi = 2 * pi * uniform(r), r2 = uniform(r);
  return V(std::cos(phi) * 2 * std::sqrt(r2), std::sin(phi) * 2 * std::sqrt(r2), std::sqrt(1 - r2)).normalized();
}

// A direction at a wall and the weight of the path after it: cos / pi divided by the density that the book states.
struct Bounce {
  V w;
  double weight;
};
using Strategy = Bounce (*)(const Hit&, Pcg&);

V around(const V& n, const V& local) { return mc::Frame<double>::from_z(n).to_world(local); }

template <V (*lobe)(Pcg&)> Bounce mixed(const Hit& h, Pcg& r) {
  const V w = uniform(r) < 0.5 ? toward_light(h.p, r) : around(h.n, lobe(r));
  const double c = std::max(w.dot(h.n), 0.0) / pi;
  return {w, c > 0 ? c / (0.5 * c + 0.5 * toward_light_pdf(h.p, w)) : 0};
}
template <V (*lobe)(Pcg&)> Bounce weightless(const Hit& h, Pcg& r) { return {around(h.n, lobe(r)), 1}; }

V unit_in_ball(Pcg& r) { return (V::UnitZ() + in_ball(r)).normalized(); }
V on_ball(Pcg& r) { return (V::UnitZ() + in_ball(r).normalized()).normalized(); }

Bounce hemisphere(const Hit& h, Pcg& r) {
  const double z = uniform(r);
  return {around(h.n, direction(z, 2 * pi * uniform(r))), 2 * z};
}
Bounce light_only(const Hit& h, Pcg& r) {
  const V w = toward_light(h.p, r);
  const double pdf = toward_light_pdf(h.p, w);
  return {w, pdf > 0 ? std::max(w.dot(h.n), 0.0) / pi / pdf : 0};
}

const V eye(278, 278, -800);
const double half_view = std::tan(20 * pi / 180); // of the picture, at distance 1
V view(double x, double y) { return V((2 * x - 1) * half_view, (2 * y - 1) * half_view, 1).normalized(); }

// Radiance of the directly visible light. It is the same in every box, so it is computed without noise: at distance 1
// the light is a trapezium between the heights of its far and near edge, as wide as its width over its distance.
double light_in_view() {
  const double up = light_y - eye.y(), low = up / (light_z1 - eye.z()), high = up / (light_z0 - eye.z());
  const double area = (light_x1 - light_x0) / up * (high * high - low * low) / 2;
  return radiance * area / (4 * half_view * half_view);
}

// Radiance of a path through a random point of the picture, without the directly visible light.
double path(Strategy bounce, Pcg& r) {
  const double x = uniform(r);
  V o = eye, d = view(x, uniform(r)), beta = V::Ones();
  for (int depth = 0; depth <= 50; ++depth) {
    const Hit hit = intersect(o, d);
    if (hit.light) return depth > 0 && hit.n.y() < 0 ? radiance * beta.mean() : 0;
    if (!(hit.t < HUGE_VAL)) return 0;
    const Bounce b = bounce(hit, r);
    if (!(b.weight > 0)) return 0;
    beta = beta.cwiseProduct(hit.albedo) * b.weight;
    o = hit.p;
    d = b.w;
  }
  return 0;
}

mc::Moments render(Strategy strategy, std::uint64_t paths, std::uint64_t seed, int threads,
                   const std::atomic<bool>* cancel) {
  constexpr std::uint64_t chunk = 4096;
  return mc::parallel_reduce<mc::Moments>((paths + chunk - 1) / chunk, threads, [&](std::size_t i) {
    mc::Moments m;
    if (cancel && *cancel) return m;
    Pcg random(mc::hash(seed, i));
    for (std::uint64_t k = 0; k < chunk; ++k) m.add(path(strategy, random), i * chunk + k);
    return m;
  });
}

} // namespace

std::vector<CornellBox> cornell_boxes(std::uint64_t paths, std::uint64_t seed, int threads,
                                      const std::atomic<bool>* cancel) {
  struct RenderSetup {
    CornellBox box;
    Strategy strategy;
    std::uint64_t times_paths = 1;
  };
  const RenderSetup ways[] = {
      {{"cosine and light, half each", "reference", "cosine directions; the density of a sample is the mixture's",
        true},
       mixed<cosine>,
       4},
      {{"normal + unit vector", "book v3.2.3", "cosine directions: right", true}, weightless<on_ball>},
      {{"uniform hemisphere", "book v3.2.3", "right too: the text that calls the difference a bug is stale", true},
       hemisphere},
      {{"normal + point in the ball", "book, ch. 4", "P1: directions crowd the normal, out of the box's dark corners"},
       weightless<unit_in_ball>},
      {{"doubled cosine lobe", "book, ch. 6", "P2: directions crowd the horizon"}, weightless<doubled_cosine>},
      {{"light only", "book, ch. 7", "P6: what the walls send each other is lost"}, light_only},
      {{"doubled lobe and light, half each", "book, ch. 8", "P2, half hidden by the light samples"},
       mixed<doubled_cosine>,
       4},
  };
  const double direct = light_in_view();
  std::vector<CornellBox> boxes;
  for (const RenderSetup& way : ways) {
    const mc::Moments m = render(way.strategy, way.times_paths * paths, mc::hash(seed, boxes.size()), threads, cancel);
    if (cancel && *cancel) return {};
    CornellBox b = way.box;
    b.mean = direct + m.mean();
    b.std_error = m.std_error();
    if (!boxes.empty()) {
      const CornellBox& r = boxes.front();
      b.off = b.mean / r.mean - 1;
      b.off_error = std::hypot(b.std_error, r.std_error) / r.mean;
      b.p = std::erfc(std::abs(b.off) / b.off_error / std::sqrt(2.0));
    }
    boxes.push_back(b);
  }
  return boxes;
}

} // namespace carlo
