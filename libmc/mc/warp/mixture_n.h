#pragma once
/// Mixtures with a number of components chosen at run time.

#include <mc/core/error.h>
#include <mc/table/concept.h>
#include <mc/warp/concept.h>

#include <utility>
#include <vector>

namespace mc {

/// Density of a mixture: the sum of choice.pmf(i) pdf_of(i). Skips components of probability 0.
/// To sample the mixture, draw s = choice.sample_index(uc), then sample component s.index at u. s.u_remapped may serve
/// as a coordinate of u. Components may be of any kind, for example shapes sampled from a reference point.
template <DiscreteDistribution C, class Pdf> typename C::Scalar mixture_pdf(const C& choice, Pdf&& pdf_of) {
  typename C::Scalar sum(0);
  for (std::size_t i = 0; i < choice.size(); ++i)
    if (const auto pmf = choice.pmf(i); pmf > 0) sum += pmf * pdf_of(i);
  return sum;
}

/// A mixture of n warps of one type, chosen by a discrete distribution. The first coordinate of u selects the
/// component. It is then stretched back to [0,1), which preserves stratification.
///   domain : must contain the domains of all components. The density of a component is 0 outside its own domain.
///   pdf    : sum of pmf(i) pdf_i(x) over all components, not only the sampled one.
///   invert : none, because several u give the same x.
///   throws : Error unless the number of components equals the number of outcomes of the choice.
///   Source : one-sample combination, [Veach97] section 9.2.4.
template <Domain D, class Part, DiscreteDistribution C>
requires std::same_as<typename Part::Scalar, typename D::Scalar> && std::same_as<typename C::Scalar, typename D::Scalar>
class MixtureN {
 public:
  using Scalar = typename D::Scalar;
  using Domain = D;

  /// Component i of `parts` is selected with probability choice.pmf(i).
  MixtureN(D domain, C choice, std::vector<Part> parts)
      : domain_(std::move(domain)), choice_(std::move(choice)), parts_(std::move(parts)) {
    require(parts_.size() == choice_.size(), "MixtureN: {} parts for a choice of {} outcomes; as many are needed",
            parts_.size(), choice_.size());
  }

  D domain() const { return domain_; }
  typename D::Point sample(typename D::UnitPoint u) const {
    Scalar& uc = first_of(u);
    const auto chosen = choice_.sample_index(uc);
    uc = chosen.u_remapped;
    return parts_[chosen.index].sample(u);
  }
  Scalar pdf(const typename D::Point& x) const {
    return mixture_pdf(choice_, [&](std::size_t i) { return parts_[i].pdf(x); });
  }
  template <Real T> auto cast() const {
    using PartT = decltype(std::declval<Part>().template cast<T>());
    std::vector<PartT> parts;
    for (const Part& part : parts_) parts.push_back(part.template cast<T>());
    return mc::MixtureN(domain_.template cast<T>(), choice_.template cast<T>(), std::move(parts));
  }

 private:
  static Scalar& first_of(typename D::UnitPoint& u) {
    if constexpr (D::dim == 1) return u;
    else return u[0];
  }

  D domain_;
  C choice_;
  std::vector<Part> parts_;
};

} // namespace mc
