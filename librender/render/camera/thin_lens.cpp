#include <render/camera/thin_lens.h>

#include <mc/core/error.h>

namespace render {

namespace {

constexpr double most_skewed = 1e-4; // relative tolerance; files contain frames with about six digits

} // namespace

ThinLens::ThinLens(const Transform& to_world, const LensOptions& options)
    : origin_(to_world.translation.cast<Float>()), fov_axis_(options.fov_axis), is_parallel_(options.half_width > 0),
      half_size_(Float(is_parallel_ ? options.half_width : std::tan(options.fov * mc::pi<double> / 360))),
      radius_(Float(options.radius)), focus_distance_(Float(options.focus_distance)), near_(Float(options.near)),
      depth_(Float(options.far - options.near)) {
  const auto& axes = to_world.linear;
  mc::require(axes.allFinite() && origin_.allFinite() && (axes.colwise().norm().array() > 0).all(),
              "camera: toWorld must be finite, and none of its axes 0");
  const Eigen::RowVector3d length = axes.colwise().norm();
  const Eigen::Matrix3d unit = axes.colwise().normalized();
  mc::require(
      length.maxCoeff() - length.minCoeff() <= most_skewed * length.maxCoeff() &&
          (unit.transpose() * unit - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= most_skewed,
      "camera: toWorld makes its axes {:.6g}, {:.6g} and {:.6g} long, with cosines of {:.3g}, {:.3g} and {:.3g} "
      "between them; they must be equally long and orthogonal: leave out the scale or shear",
      length[0], length[1], length[2], unit.col(0).dot(unit.col(1)), unit.col(1).dot(unit.col(2)),
      unit.col(2).dot(unit.col(0)));
  mc::require(options.fov > 0 && options.fov < 180, "camera: fov {} must lie in (0, 180) degrees", options.fov);
  mc::require(options.radius >= 0 && std::isfinite(options.radius), "camera: apertureRadius {} must be finite and >= 0",
              options.radius);
  mc::require(options.half_width >= 0 && std::isfinite(options.half_width),
              "camera: the width of parallel rays {} must be finite and >= 0", options.half_width);
  mc::require(!is_parallel_ || radius_ == 0, "camera: parallel rays pass no lens; leave out the apertureRadius");
  mc::require(options.focus_distance > 0 && std::isfinite(options.focus_distance),
              "camera: focusDistance {} must be finite and > 0", options.focus_distance);
  mc::require(options.near >= 0 && std::isfinite(options.near), "camera: nearClip {} must be finite and >= 0",
              options.near);
  mc::require(options.far > options.near, "camera: farClip {} must be beyond nearClip {}", options.far, options.near);
  right_ = -axes.col(0).normalized().cast<Float>();
  up_ = axes.col(1).normalized().cast<Float>();
  forward_ = axes.col(2).normalized().cast<Float>();
}

} // namespace render
