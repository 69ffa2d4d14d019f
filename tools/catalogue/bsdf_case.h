#pragma once
/// Adds cases of BSDFs.

#include <catalogue/catalogue.h>

#include <render/core/types.h>

#include <mc/check/bsdf_laws.h>
#include <mc/check/laws/bsdf/roughness_limit.h>

#include <chrono>
#include <numbers>

namespace carlo {

/// Adds one case for each angle of incidence [degrees]; angles beyond 90 are inside.
template <class Bsdf>
void add_bsdf(Catalogue& c, const std::string& name, const std::string& parameters, const Bsdf& bsdf,
              const std::vector<double>& angles = {0, 60, 85, 89.9}, const mc::BsdfOptions& bounds = {}) {
  for (const double angle : angles) {
    Case one{name,
             (parameters.empty() ? "" : parameters + ", ") + fmt::format("theta={:g}", angle),
             sizeof(render::Float) == 4 ? "float" : "double",
             {}};
    const double theta = angle * std::numbers::pi / 180, phi = 0.4;
    const render::Vec3 wo =
        render::Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta))
            .cast<render::Float>();
    one.check = [bsdf, wo, bounds, title = one.title()](const CaseOptions& options) {
      mc::BsdfOptions o = bounds;
      o.name = title;
      o.statistics = options;
      return mc::check_bsdf<render::Float>(bsdf, wo, o);
    };
    c.push_back(std::move(one));
  }
}

/// Adds one case for each angle of incidence: family(roughness) must be continuous and tend to family(0).
template <class Family>
void add_roughness_limit(Catalogue& c, const std::string& name, const std::string& parameters, const Family& family,
                         const std::vector<double>& angles) {
  for (const double angle : angles) {
    Case one{
        name, fmt::format("{}, theta={:g}", parameters, angle), sizeof(render::Float) == 4 ? "float" : "double", {}};
    const double theta = angle * std::numbers::pi / 180;
    one.check = [family, theta, title = one.title()](const CaseOptions& options) {
      const auto start = std::chrono::steady_clock::now();
      mc::Report report;
      report.subject = title;
      report.alpha = options.alpha;
      const render::Vec3 wo = render::Vec3d(std::sin(theta), 0, std::cos(theta)).cast<render::Float>();
      report.checks =
          mc::check_roughness_limit<render::Float>(family, family(0), wo, {.bsdf = {.statistics = options}});
      report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      return report;
    };
    c.push_back(std::move(one));
  }
}

} // namespace carlo
