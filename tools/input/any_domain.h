#pragma once
/// Domains that are chosen on the command line.

#include <mc/check/subject/axis.h>

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace carlo {

/// A factor of a domain, its points as columns of numbers.
struct DomainPart {
  std::string text;               ///< "x in [0, 1]", "the unit sphere"
  std::vector<std::string> names; ///< of its columns
  std::vector<mc::Axis> axes;     ///< of its chart; as many as it has dimensions
  std::function<bool(const double* x)> contains;
  std::function<void(const double* x, double* v)> to_unit;
  std::function<void(const double* v, double* x)> from_unit;
  std::function<double(const double* v)> jacobian;
};

/// A product of parts of at most three dimensions in all, or a number of outcomes.
class AnyDomain {
 public:
  using Coordinates = std::array<double, 3>;

  AnyDomain(std::vector<DomainPart> parts, int outcomes) : parts_(std::move(parts)), outcomes_(outcomes) {}

  int outcomes() const { return outcomes_; } ///< 0 for a continuous domain
  int dim() const { return static_cast<int>(axes().size()); }
  std::vector<std::string> names() const; ///< of the columns
  std::vector<mc::Axis> axes() const;
  std::string text() const;

  bool contains(const double* x) const;
  Coordinates to_unit(const double* x) const;
  std::vector<double> from_unit(const Coordinates& v) const;
  double jacobian(const Coordinates& v) const;

 private:
  std::vector<DomainPart> parts_;
  int outcomes_;
};

/// The quartiles of a column of the samples, on which the charts of infinite intervals are centred.
using Quartiles = std::function<std::array<double, 3>(std::size_t column)>;

/// Parts separated by commas, in the order of the columns:
///   NAME=LO:HI        : an interval; either end may be -inf or inf
///   disk, annulus=R   : x^2 + y^2 <= 1, and from R^2; columns x, y
///   triangle          : x >= 0, y >= 0, x + y <= 1; columns x, y
///   ball              : x^2 + y^2 + z^2 <= 1; columns x, y, z
///   sphere, hemisphere: unit vectors, to 1e-5, and of z >= 0; columns x, y, z
///   discrete=N        : outcomes 0 to N - 1 in a column i; alone
///   throws : Error that names --domain for anything else, more than three dimensions, or a name that stands twice
AnyDomain parse_domain(const std::string& text, const Quartiles& quartiles);

} // namespace carlo
