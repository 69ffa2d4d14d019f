// Distributions of librender in its Float: points and directions on shapes and lights from a reference point, light
// selection, masks, filter offsets, lens points, and rays through the film.
#include <catalogue/catalogue.h>

#include <render/scene/builder.h>
#include <render/scene/visibility.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/check/subject/timing.h>
#include <mc/domain/parallelogram.h>
#include <mc/domain/patch.h>
#include <mc/warp/product.h>

namespace carlo {
namespace {

using namespace render;
using Timing = std::function<double()>; // time of one sample [ns]

constexpr Float eps = std::numeric_limits<Float>::epsilon(), nan = std::numeric_limits<Float>::quiet_NaN();

template <class Sample> Timing timing_of(const Sample& sample) {
  return [=] {
    std::vector<Vec2> inputs(mc::timing_inputs);
    mc::Pcg random(3);
    for (Vec2& u : inputs) u = random.point<Float, 2>();
    return mc::ns_per_sample(inputs, sample);
  };
}

Timing timing_of(const Shape& shape, const Vec3& ref) {
  return timing_of([=](const Vec2& u) { return shape.sample(ref, u); });
}

// Adds a distribution that is not a warp.
void add_subject(Catalogue& c, const std::string& name, const std::string& parameters, mc::Subject subject,
                 const Timing& timing, double mass_tolerance = 64 * double(eps)) {
  Case one{name, parameters, sizeof(Float) == 4 ? "float" : "double", {}};
  subject.name = one.title();
  subject.mass_tolerance = mass_tolerance;
  one.check = [subject = std::move(subject), timing](const CaseOptions& o) {
    mc::Report report = mc::check_subject(subject, o);
    report.ns_per_sample = timing();
    return report;
  };
  c.push_back(std::move(one));
}

// Adds the directions from ref to a shape, checked against the density of a direction. `domain` contains all of them. A
// direction on the outline may round out of the shape by 4 eps; it is moved back towards `middle`.
template <class D>
void add_directions(Catalogue& c, const std::string& name, const std::string& parameters, const Shape& shape,
                    const Vec3& ref, const D& domain, const Vec3& middle) {
  const auto sample = [=](const Vec2& u) {
    const auto s = shape.sample(ref, u);
    if (!s) return Vec3(nan, nan, nan);
    return domain.contains(s->wi) && shape.pdf(ref, s->wi) > 0
               ? s->wi
               : Vec3((s->wi + 4 * eps * (middle - s->wi).normalized()).normalized());
  };
  const auto pdf = [=](const Vec3& wi) { return shape.pdf(ref, wi); };
  add_subject(c, name, parameters + ", directions", make_subject("", domain, sample, pdf), timing_of(shape, ref));
}

// Adds the points that a shape samples from ref, checked against the density of the direction to a point, converted to
// area of the domain.
//   domain  : contains the images of all points.
//   image   : maps a SurfacePoint to its point of the domain.
//   surface : maps a point of the domain to the SurfacePoint.
//   scale   : area of the shape per area of the domain.
template <class D, class Image, class Surface>
void add_points(Catalogue& c, const std::string& name, const std::string& parameters, const Shape& shape,
                const Vec3& ref, const D& domain, const Image& image, const Surface& surface, double scale,
                double tolerance = 1e-3) {
  using Point = typename D::Point;
  struct Drawn {
    Point x;
    Float weight, pdf;
  };
  // Density per area. The weight for f = 1 uses the density that the shape's sample states.
  const auto per_area = [=](const SurfacePoint& p, Float pdf) {
    const Vec3d between = (p.p - ref).template cast<double>();
    return Float(double(pdf) * std::abs(p.ng.template cast<double>().dot(between.normalized())) /
                 between.squaredNorm() * scale);
  };
  const auto sample = [=](const Vec2& u) {
    const auto s = shape.sample(ref, u);
    if (!s) return Drawn{Point::Constant(nan), 0, 0};
    const Float pdf = per_area(s->point, s->pdf);
    return Drawn{image(s->point), 1 / pdf, pdf};
  };
  const auto pdf = [=](const Point& x) {
    const SurfacePoint p = surface(x);
    return per_area(p, shape.pdf(ref, (p.p - ref).normalized(), p));
  };
  mc::Subject subject = make_subject("", domain, sample, pdf, [](const Point&) { return Float(1); });
  subject.weight_tolerance = tolerance;
  add_subject(c, name, parameters + ", points", std::move(subject), timing_of(shape, ref), 1e-6);
}

mc::Cap<Float> cap_of(double one_minus_cos) { return mc::Cap<Float>(Float(one_minus_cos)); }

// Adds the points of a sphere about `at`, or of a cap of it; their directions from `at` lie in `domain`.
template <class D>
void add_sphere(Catalogue& c, const std::string& where, const Vec3d& at, const Sphere& sphere, const Vec3& ref,
                const D& domain, double tolerance = 1e-3) {
  const auto image = [=](const SurfacePoint& p) {
    return Vec3(((p.p.cast<double>() - at) / sphere.radius()).normalized().cast<Float>());
  };
  const auto surface = [=, center = Vec3(at.cast<Float>())](const Vec3& x) {
    return sphere.surface_point({center, x}, {Float(sphere.radius())});
  };
  add_points(c, "Sphere", where, sphere, ref, domain, image, surface, mc::sqr(sphere.radius()), tolerance);
}

void add_spheres_seen(Catalogue& c) {
  const Vec3 center(Float(0.25), Float(-0.5), Float(0.75));
  const Vec3d at = center.cast<double>();
  for (const double ratio : {0.01, 0.5, 0.999}) {
    const mc::RotatedDomain<mc::Cap<Float>> cone{cap_of(ratio * ratio / (1 + std::sqrt(1 - ratio * ratio))),
                                                 mc::Frame<Float>::from_z(center.normalized())};
    add_directions(c, "Sphere", fmt::format("radius/distance={:g}", ratio), Sphere(at, ratio * at.norm()), Vec3::Zero(),
                   cone, center.normalized());
  }
  const Sphere sphere(at, 2, true);
  add_sphere(c, "from inside", at, sphere, center + Vec3(Float(0.5), 1, Float(-1.25)), mc::Sphere<Float>{});
  // The distance of points next to ref has few correct digits.
  add_sphere(c, "from its surface", at, sphere, center + 2 * Vec3(Float(0.48), Float(0.6), Float(-0.64)),
             mc::Sphere<Float>{}, 0.1);
  const Vec3d axis(-1, 2, 2);
  const mc::RotatedDomain<mc::Cap<Float>> around{cap_of(0.25), mc::Frame<Float>::from_z((axis / 3).cast<Float>())};
  add_sphere(c, "cap of height 0.5", at, Sphere::cap(at, 2, axis, 0.5), center + Vec3(-2, 5, 4), around);
}

// A parallelogram cut into strips of growing width, two triangles for each strip.
struct StripMesh {
  Vec3 corner{-1, Float(-0.5), 2}, e1{2, 0, Float(0.5)}, e2{Float(0.25), 1, 0};
  std::uint32_t count;

  Float cut(std::uint32_t i) const { return mc::sqr(Float(i) / Float(count)); }

  TriangleMesh mesh() const {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i <= count; ++i) {
      positions.push_back(corner + cut(i) * e1);
      positions.push_back(corner + cut(i) * e1 + e2);
    }
    for (std::uint32_t i = 0; i < 2 * count; i += 2) {
      triangles.push_back({i, i + 2, i + 3});
      triangles.push_back({i, i + 3, i + 1});
    }
    return {positions, triangles};
  }

  // The point of the mesh with these coordinates in the parallelogram.
  SurfacePoint point(const TriangleMesh& mesh, const Vec2& v) const {
    const auto strip = std::min(static_cast<std::uint32_t>(std::sqrt(v[0]) * Float(count)), count - 1);
    const Float s = (v[0] - cut(strip)) / (cut(strip + 1) - cut(strip)), t = v[1];
    const std::size_t first = 2 * strip;
    return s >= t ? mesh.point(first, double(s - t), double(t)) : mesh.point(first + 1, double(s), double(t - s));
  }
};

void add_strips_directions(Catalogue& c, const std::string& where, const Vec3& ref, const StripMesh& strips) {
  const mc::Patch<Float, 4> directions(strips.corner - ref, strips.e1, strips.e2);
  add_directions(c, "TriangleMesh", where, strips.mesh(), ref, directions,
                 directions.from_unit({Float(0.5), Float(0.5)}));
}

void add_strips_points(Catalogue& c, const std::string& where, const Vec3& ref, const StripMesh& strips) {
  const TriangleMesh mesh = strips.mesh();
  const mc::Parallelogram<Float> domain(strips.corner, strips.e1, strips.e2);
  const auto image = [](const SurfacePoint& p) { return p.p; };
  const auto surface = [=](const Vec3& x) { return strips.point(mesh, domain.to_unit(x)); };
  add_points(c, "TriangleMesh", where, mesh, ref, domain, image, surface, 1);
}

void add_meshes_seen(Catalogue& c) {
  const Vec3 afar(Float(0.25), Float(0.5), Float(-1.5));
  for (const std::uint32_t count : {1u, 6u}) {
    const std::string where = fmt::format("{} triangles from afar", 2 * count);
    add_strips_directions(c, where, afar, {.count = count});
    add_strips_points(c, where, afar, {.count = count});
  }
  // Points are not checked: their density jumps at the diagonal, which belongs to both triangles.
  add_strips_directions(c, "2 triangles it nearly touches", {Float(0.25), Float(0.125), Float(2.25)}, {.count = 1});
  // Two triangles that cover the same directions: rays hit both.
  const Vec3 a(Float(0.5), -1, 2), b(1, 1, Float(0.5)), e(-1, Float(0.5), Float(0.25));
  const mc::Patch<Float, 3> directions(a, b, e);
  add_directions(c, "TriangleMesh", "one triangle behind another",
                 TriangleMesh({a, a + b, a + e, 2 * a, 2 * (a + b), 2 * (a + e)}, {{0, 1, 2}, {3, 4, 5}}), Vec3::Zero(),
                 directions, directions.from_unit({Float(0.5), Float(0.5)}));
}

// An ellipse, with its points in the unit disk.
void add_disk_seen(Catalogue& c) {
  const Transform to_world = Transform::columns({2, 0, 0.5}, {0.25, 1, 0}, {0, 0, 1}, {0, 0, 2});
  const Disk disk(to_world);
  const auto image = [=](const SurfacePoint& p) {
    const auto uv = disk.uv({}, p);
    const double phi = 2 * mc::pi<double> * uv[1];
    return Vec2(Float(uv[0] * std::cos(phi)), Float(uv[0] * std::sin(phi)));
  };
  const auto surface = [=](const Vec2& x) {
    SurfacePoint p = *disk.sample_area({Float(0.5), Float(0.5)}); // for its normal
    p.p = to_world.point({double(x[0]), double(x[1]), 0}).cast<Float>();
    return p;
  };
  add_points(c, "Disk", "an ellipse", disk, {Float(0.25), Float(0.5), Float(-1.5)}, mc::Disk<Float>{}, image, surface,
             disk.area() / mc::pi<double>);
}

// A cylinder, with its points as turns and shares of the height; from outside and from its axis.
void add_cylinder_seen(Catalogue& c) {
  const Vec3d base(0.5, -1, 2), end(1, 0.5, 3);
  const Cylinder cylinder(base, end, 0.75);
  const auto image = [=](const SurfacePoint& p) {
    const auto uv = cylinder.uv({}, p);
    return Vec2(Float(uv[0]), Float(uv[1]));
  };
  const auto surface = [=](const Vec2& x) { return *cylinder.sample_area(x); };
  for (const double away : {0.0, 3.0})
    add_points(c, "Cylinder", away == 0 ? "from the axis" : "from outside", cylinder,
               ((base + end) / 2 + away * cylinder.frame().x).cast<Float>(), mc::Box<Float, 2>{}, image, surface,
               cylinder.area());
}

// Light selection at a point.
struct LightsSeen {
  using Scalar = Float;
  std::shared_ptr<const Scene> scene;
  Vec3 ref;

  mc::DiscreteSample<Float> sample_index(Float u) const { return scene->sample_light(ref, u); }
  Float pmf(std::size_t i) const { return scene->light_pmf(ref, i); }
  std::size_t size() const { return scene->lights().size(); }
};

void add_choice(Catalogue& c, const std::string& name, const std::string& parameters, SceneBuilder builder) {
  const LightsSeen choice{std::make_shared<const Scene>(builder.build()), Vec3(1, 2, 3)};
  add_subject(c, name, parameters, mc::make_discrete_subject("", choice),
              timing_of([=](const Vec2& u) { return choice.sample_index(u[0]); }));
}

void add_choices(Catalogue& c) {
  SceneBuilder spheres;
  const BsdfId gray = spheres.add(Lambert());
  for (const double radiance : {0.0, 1.0, 1e-3, 0.0, 20.0, 3.0, 0.0})
    spheres.add(Sphere(Vec3d::Zero(), 0.1), {gray, Emission{Spectrum::Constant(Float(radiance))}});
  add_choice(c, "LightSampler", "spheres of one size and place", std::move(spheres));
  // Point, spot and directional lights: only the choice of the light is random.
  for (const bool with_sun : {false, true}) {
    SceneBuilder points;
    points.add(Sphere(Vec3d::Zero(), 0.1), {points.add(Lambert())});
    for (const double distance : {0.0, 1e-3, 1.0, 10.0}) // distance from the reference point
      points.add(Light(PointLight(Vec3d(1, 2, 3 + distance), Spectrum::Ones())));
    if (with_sun) points.add(Light(DirectionalLight(Vec3d(0, -1, 0), Spectrum::Constant(Float(1e6)))));
    if (with_sun) add_choice(c, "DirectionalLight", "chosen beside points", std::move(points));
    else add_choice(c, "PointLight", "chosen by its distance", std::move(points));
  }
}

// Spot lights that shine on the point, past it and away from it, by their distance and their cones.
void add_spot_choice(Catalogue& c) {
  SceneBuilder spots;
  spots.add(Sphere(Vec3d::Zero(), 0.1), {spots.add(Lambert())});
  for (const double angle : {0.0, 17.5, 40.0, 180.0})
    spots.add(Light(SpotLight(Vec3d(1, 2, 5), Transform::rotate(Vec3d::UnitX(), angle).vector(-Vec3d::UnitZ()),
                              Spectrum::Ones(), {})));
  add_choice(c, "SpotLight", "chosen by its cone", std::move(spots));
}

// The surface at which a ray ends; the first of two surfaces has a textured mask.
struct MetBehindMask {
  using Scalar = Float;
  std::shared_ptr<const Scene> scene;
  Float opacity; ///< at the hit point of the ray

  mc::DiscreteSample<Float> sample_index(Float u) const {
    Ray ray{Vec3(0, Float(0.5), -2), Vec3::UnitZ()};
    std::uint64_t rays = 0;
    mc::DiscreteSample<Float> choice{};
    const auto hit = nearest_hit(*scene, ray, rays, [&](Float there) {
      choice = mc::Bernoulli<Float>(there).sample_index(u);
      return choice.index == 0;
    });
    choice.index = hit ? static_cast<std::size_t>(hit->shape) : size();
    return choice;
  }
  Float pmf(std::size_t i) const { return i == 0 ? opacity : 1 - opacity; }
  std::size_t size() const { return 2; }
};

void add_mask(Catalogue& c) {
  const std::vector<Spectrum> texels = {Spectrum::Constant(Float(0.25)), Spectrum::Constant(Float(0.5))};
  Material leaf = Bsdf(Lambert());
  leaf.mask = std::make_shared<const Mask>(Bitmap(std::make_shared<const Texels>(2, 1, texels)));
  SceneBuilder builder;
  builder.add(TriangleMesh::rectangle({}), {builder.add(leaf)});
  builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 1})), {builder.add(Lambert())});
  const MetBehindMask met{std::make_shared<const Scene>(builder.build()), Float(0.375)}; // between two texels
  add_subject(c, "Mask", "a picture of 0.25 and 0.5", mc::make_discrete_subject("", met),
              timing_of([=](const Vec2& u) { return met.sample_index(u[0]); }));
}

// Adds the directions towards an infinitely distant light.
template <class L> void add_background(Catalogue& c, const std::string& name, const std::string& what, const L& light) {
  const auto sample = [=](const Vec2& u) { return light.sample(Vec3::Zero(), u)->wi; };
  const auto pdf = [=](const Vec3& wi) { return light.pdf(Vec3::Zero(), wi, nullptr); };
  add_subject(c, name, what, make_subject("", mc::Sphere<Float>{}, sample, pdf),
              timing_of([=](const Vec2& u) { return light.sample(Vec3::Zero(), u); }));
}

void add_lights_seen(Catalogue& c) {
  add_background(c, "ConstantBackground", "", ConstantBackground(Spectrum::Ones()));
  add_background(c, "GradientBackground", "white to blue", GradientBackground());
  add_background(c, "GradientBackground", "black below", GradientBackground(Spectrum::Zero(), Spectrum::Ones()));
  std::vector<Spectrum> texels;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) texels.push_back(Spectrum::Constant(Float(x == 1 && y == 1 ? 20 : (x + 3 * y) % 4)));
  add_background(c, "Environment", "8x4 with a sun", Environment(std::make_shared<const Texels>(8, 4, texels)));
  const Vec3 ref(Float(0.25), Float(0.5), Float(-1.5));
  const AreaLight light(std::make_shared<const Shape>(Sphere(Vec3d(0.25, 0.5, 1.5), 1)), Emission{});
  const mc::RotatedDomain<mc::Cap<Float>> cone{cap_of((1 / 9.0) / (1 + std::sqrt(1 - 1 / 9.0))),
                                               mc::Frame<Float>::from_z(Vec3::UnitZ())};
  add_directions(c, "AreaLight", "a sphere", light.shape(), ref, cone, Vec3::UnitZ());
}

template <class F>
void add_filter(Catalogue& c, const std::string& name, const std::string& parameters, const F& filter) {
  const auto sample = [=](const Vec2& u) { return filter.sample(u); };
  add_subject(c, name, parameters,
              make_subject("", filter.domain(), sample, [=](const Vec2& x) { return filter.pdf(x); }),
              timing_of(sample));
}

void add_camera(Catalogue& c) {
  for (const Float radius : {Float(0.5), Float(2)})
    add_filter(c, "BoxFilter", fmt::format("radius={:g}", radius), BoxFilter(radius));
  add_filter(c, "TentFilter", "radius=1", TentFilter());
  add_filter(c, "GaussianFilter", "sigma=0.5", GaussianFilter());
  for (const int n : {2, 3})
    add_filter(c, "SubpixelTentFilter", fmt::format("n={}, radius=0.5", n), SubpixelTentFilter(n));

  const ThinLens lens({}, {.radius = 1, .focus_distance = 3});
  const auto sample = [=](const Vec2& u) {
    return Vec2(lens.ray(Vec2(Float(0.3), Float(0.9)), lens.tan_half(1), u).o.head<2>());
  };
  add_subject(c, "ThinLens", "points of the lens",
              make_subject("", mc::Disk<Float>{}, sample, [](const Vec2&) { return 1 / mc::pi<Float>; }),
              timing_of(sample));
}

// Adds the rays through the points of a film, checked against the density that light paths use for them.
void add_pinholes(Catalogue& c) {
  for (const double fov : {10.0, 90.0, 150.0}) {
    const ThinLens lens(Transform::look_at({1, 2, 3}, Vec3d::Zero(), Vec3d::UnitY()), {.fov = fov});
    const Vec2 half = lens.tan_half(Float(1.5));
    const Vec3 x = half[0] * lens.right(), y = half[1] * lens.up();
    const mc::Patch<Float, 4> film(lens.forward() - x - y, 2 * x, 2 * y);
    const auto sample = [=](const Vec2& u) { return lens.ray(u, half, Vec2::Zero()).d; };
    add_subject(c, "ThinLens", fmt::format("pinhole, fov={:g}, directions", fov),
                make_subject("", film, sample, [=](const Vec3& d) { return lens.direction_pdf(d, half); }),
                timing_of(sample));
  }
}

} // namespace

void add_shapes(Catalogue& c) {
  add_spheres_seen(c);
  add_meshes_seen(c);
  add_disk_seen(c);
  add_cylinder_seen(c);
  add_choices(c);
  add_spot_choice(c);
  add_mask(c);
  add_lights_seen(c);
  add_camera(c);
  add_pinholes(c);
}

} // namespace carlo
