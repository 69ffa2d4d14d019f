#include <render/shape/cylinder.h>
#include <render/shape/cylinder_crossings.h>

#include <mc/core/error.h>
#include <mc/core/turns.h>
#include <mc/warp/uniform.h>

namespace render {

namespace {

// The line from o along d in the frame of a cylinder, and its crossings with the infinite cylinder.
struct LocalLine {
  Vec3d o, d;
  CylinderCrossings<double> at;

  LocalLine(const Cylinder& c, const Vec3& from, const Vec3& along)
      : o(c.frame().to_local(from.cast<double>() - c.base())), d(c.frame().to_local(along.cast<double>())),
        at(cylinder_crossings(o.x(), o.y(), o.z(), d.x(), d.y(), d.z(), mc::sqr(c.radius()))) {}
};

} // namespace

Cylinder::Cylinder(const Vec3d& from, const Vec3d& to, double radius, bool flipped)
    : base_(from), height_((to - from).norm()), radius_(radius), flipped_(flipped) {
  mc::require(from.cast<Float>().allFinite() && to.cast<Float>().allFinite() && std::isfinite(area()),
              "cylinder: its ends ({}, {}, {}) and ({}, {}, {}) and its radius {} must be finite", from.x(), from.y(),
              from.z(), to.x(), to.y(), to.z(), radius);
  mc::require(height_ > 0, "cylinder: its ends must differ; both are ({}, {}, {})", from.x(), from.y(), from.z());
  mc::require(radius > 0, "cylinder: radius {} must be > 0", radius);
  frame_ = mc::Frame<double>::from_z((to - from) / height_);
  error_ = Float(0x1p-49 * std::max({base_.lpNorm<Eigen::Infinity>(), to.lpNorm<Eigen::Infinity>(), radius}));
}

// Computed in double and rounded once.
SurfacePoint Cylinder::point(double cosine, double sine, double height) const {
  const Vec3d normal = frame_.x * cosine + frame_.y * sine;
  SurfacePoint s;
  s.p = (base_ + normal * radius_ + frame_.z * height).cast<Float>();
  s.error = std::numeric_limits<Float>::epsilon() * s.p.lpNorm<Eigen::Infinity>() + error_;
  s.ng = s.ns = (flipped_ ? Vec3d(-normal) : normal).cast<Float>();
  return s;
}

std::optional<double> Cylinder::intersect(const Ray& ray) const {
  const auto at = LocalLine(*this, ray.o, ray.d).at;
  const auto is_hit = [&](double t, double z) {
    return at.crosses && t > 0 && t < double(ray.t_max) && z >= 0 && z <= height_;
  };
  if (is_hit(at.t0, at.z0)) return at.t0;
  if (is_hit(at.t1, at.z1)) return at.t1;
  return {};
}

std::optional<SurfacePoint> Cylinder::sample_area(const Vec2& u) const {
  const auto turn = mc::cos_sin<double>(double(u[0]));
  return point(turn.cos, turn.sin, mc::UniformInterval<double>(0, height_).sample(double(u[1])));
}

std::optional<ShapeSample> Cylinder::sample(const Vec3& ref, const Vec2& u) const {
  ShapeSample s;
  s.point = *sample_area(u);
  const Vec3 between = s.point.p - ref;
  const Float distance = between.norm();
  if (!(distance > 0)) return {};
  s.wi = between / distance;
  s.pdf = pdf(ref, s.wi, s.point);
  if (!(s.pdf > 0) || !std::isfinite(s.pdf)) return {};
  return s;
}

std::optional<DirectionSample> Cylinder::sample_direction(const Vec3& ref, const Vec2& u) const {
  return sample_direction_by_point(*this, ref, u);
}

Float Cylinder::pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const {
  const Float cosine = std::abs(hit.ng.dot(wi));
  return cosine > 0 ? (hit.p - ref).squaredNorm() / (cosine * Float(area())) : Float(0);
}

Float Cylinder::pdf(const Vec3& ref, const Vec3& wi) const {
  const LocalLine line(*this, ref, wi);
  const auto part = [&](double t, double z) {
    if (!(line.at.crosses && t > 0 && z >= 0 && z <= height_)) return 0.0;
    const double cosine = std::abs((line.o + t * line.d).head<2>().dot(line.d.head<2>())) / (radius_ * line.d.norm());
    return cosine > 0 ? t * t * line.d.squaredNorm() / (cosine * area()) : 0.0;
  };
  return Float(part(line.at.t0, line.at.z0) + part(line.at.t1, line.at.z1));
}

Eigen::AlignedBox3d Cylinder::box() const {
  const Vec3d half = radius_ * (frame_.x.array().square() + frame_.y.array().square()).sqrt().matrix();
  const Vec3d end = base_ + height_ * frame_.z;
  return {base_.cwiseMin(end) - half, base_.cwiseMax(end) + half};
}

double Cylinder::projected_solid_angle_bound(const Vec3& ref) const {
  return std::min(mc::pi<double>, area() / box().squaredExteriorDistance(ref.cast<double>()));
}

SurfacePoint Cylinder::surface_point(const Ray& ray, const Hit& hit) const {
  const Vec3d at = frame_.to_local(ray.o.cast<double>() + hit.t * ray.d.cast<double>() - base_);
  const mc::Vec2<double> outward = at.head<2>().normalized();
  return point(outward.x(), outward.y(), at.z());
}

mc::Vec2<double> Cylinder::uv(const SurfacePoint& point) const {
  const Vec3d at = frame_.to_local(point.p.cast<double>() - base_);
  return {mc::azimuth_turns<double>(at.x(), at.y()), std::clamp(at.z() / height_, 0.0, 1.0)};
}

double Cylinder::uv_scale(const Hit&, const SurfacePoint&) const { return 1 / std::sqrt(area()); }

} // namespace render
