#include <render/bsdf/rough_fresnel.h>

namespace render {

namespace {

// Midpoint rule over the square of visible normals. Normals are symmetric about the plane of wo, so half a turn
// suffices. The substitution 1 - u = inward^2 places more points at the rim, where facets are nearly edge-on.
template <class Facets> RoughFresnel::Albedos integrate(Float cosine, Float eta, const Facets& facets) {
  constexpr int turns = 16, rings = 32;
  const Vec3 wo(std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine);
  const auto normals = facets.visible_normals(wo);
  const auto g1 = [&](const Vec3& w) { return double(facets.g1_over_cos(w) * std::abs(w.z())); };
  double reflected = 0, transmitted = 0;
  for (int j = 0; j < rings; ++j) {
    const Float inward = 1 - (Float(j) + Float(0.5)) / rings;
    const double weight = 2 * double(inward) / (turns * rings);
    for (int i = 0; i < turns; ++i) {
      const Vec3 m = normals.sample(Vec2((Float(i) + Float(0.5)) / (2 * turns), 1 - inward * inward));
      const Float c = std::min(wo.dot(m), Float(1));
      if (!(c > 0)) continue;
      const auto [f, cos_t] = fresnel_dielectric(c, eta);
      const Vec3 mirrored = 2 * c * m - wo, refracted = (c / eta - cos_t) * m - wo / eta;
      if (mirrored.z() > 0) reflected += weight * double(f) * g1(mirrored);
      if (f < 1 && refracted.z() < 0) transmitted += weight * double(1 - f) * g1(refracted);
    }
  }
  return {Float(reflected), Float(transmitted)};
}

RoughFresnel::Albedos integrate(Float cosine, Float eta, std::monostate) {
  const Float f = fresnel_dielectric(cosine, eta).reflectance;
  return {f, 1 - f};
}

} // namespace

RoughFresnel::RoughFresnel(Float eta)
    : critical_(eta < 1 ? std::min(std::sqrt((1 - eta) * (1 + eta)), Float(0.999)) : Float(0)),
      cells_below_(critical_ > 0 ? below : 0) {}

RoughFresnel::RoughFresnel(Float eta, const CoatFacets& facets) : RoughFresnel(eta) {
  tables_ = std::make_shared<const std::vector<Table>>(1, table_of(eta, facets));
  first_ = tables_->data();
  mean_transmitted_ = first_->mean_transmitted;
}

RoughFresnel RoughFresnel::of_all_roughnesses(Float eta, const std::function<CoatFacets(Float)>& facets_of) {
  RoughFresnel coat(eta);
  std::vector<Table> tables;
  for (int i = 0; i <= roughnesses; ++i) tables.push_back(coat.table_of(eta, facets_of(alpha_of_table(i))));
  coat.tables_ = std::make_shared<const std::vector<Table>>(std::move(tables));
  coat.set_alpha(1);
  return coat;
}

// Tables are dense where the roughness is small.
Float RoughFresnel::alpha_of_table(int i) { return std::max(std::pow(Float(i) / roughnesses, Float(3)), least_alpha); }

void RoughFresnel::set_alpha(Float alpha) {
  if (tables_->size() == 1) return;
  const int i = std::min(static_cast<int>(std::cbrt(alpha) * roughnesses), roughnesses - 1);
  const Float a = alpha_of_table(i), b = alpha_of_table(i + 1);
  first_ = tables_->data() + i;
  weight_ = std::clamp((alpha - a) / (b - a), Float(0), Float(1));
  mean_transmitted_ = first_->mean_transmitted + weight_ * (first_[1].mean_transmitted - first_->mean_transmitted);
}

RoughFresnel::Table RoughFresnel::table_of(Float eta, const CoatFacets& facets) const {
  Table table;
  const auto add = [&](Float cosine) {
    table.nodes.push_back({std::visit([&](const auto& f) { return integrate(cosine, eta, f); }, facets), cosine});
  };
  for (std::size_t i = 0; i < cells_below_; ++i)
    add(critical_ * (1 - mc::sqr(mc::sqr(Float(below - i) / Float(below)))));
  for (std::size_t i = 0; i <= above; ++i) add(critical_ + (1 - critical_) * mc::sqr(Float(i) / Float(above)));
  double mean = 0;
  for (std::size_t i = 0; i + 1 < table.nodes.size(); ++i) {
    const Node &low = table.nodes[i], &high = table.nodes[i + 1];
    const double a = low.cosine, b = high.cosine;
    mean += (b - a) / 3 * (double(low.transmitted) * (2 * a + b) + double(high.transmitted) * (a + 2 * b));
  }
  table.mean_transmitted = Float(mean);
  return table;
}

} // namespace render
