#include <mc/check/subject/any_bsdf.h>

namespace mc {

std::optional<AnyBsdf::Sample> AnyBsdf::sample_next(const Direction& wo, Pcg& random) const {
  const auto next = [&] {
    const double u = is_float ? static_cast<double>(random.uniform<float>()) : random.uniform<double>();
    return open_interval && u == 0 ? epsilon() / 2 : u;
  };
  const double uc = next(), u0 = next(), u1 = next();
  return sample(wo, uc, {u0, u1});
}

double AnyBsdf::epsilon() const {
  return is_float ? static_cast<double>(std::numeric_limits<float>::epsilon()) : std::numeric_limits<double>::epsilon();
}

std::string AnyBsdf::format(const Direction& w) const {
  return is_float ? detail::format_point(Vec3<float>(w.cast<float>())) : detail::format_point(w);
}

std::string AnyBsdf::format(const Channels& f) const {
  return format_numbers({f.value.data(), static_cast<std::size_t>(f.count)},
                        is_float ? std::numeric_limits<float>::max_digits10
                                 : std::numeric_limits<double>::max_digits10);
}

} // namespace mc
