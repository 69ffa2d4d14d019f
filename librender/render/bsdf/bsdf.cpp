#include <render/bsdf/bsdf.h>

namespace render {

Spectrum Bsdf::eval(const Vec3& wo, const Vec3& wi) const {
  return dispatch(*this, [&](const auto& b) { return b.eval(wo, wi); });
}

Float Bsdf::pdf(const Vec3& wo, const Vec3& wi) const {
  return dispatch(*this, [&](const auto& b) { return b.pdf(wo, wi); });
}

Float Bsdf::eta(const Vec3& wo, const Vec3& wi) const {
  return dispatch(*this, [&](const auto& b) { return b.eta(wo, wi); });
}

Float Bsdf::albedo(const Vec3& wo) const {
  return dispatch(*this, [&](const auto& b) { return b.albedo(wo); });
}

} // namespace render
