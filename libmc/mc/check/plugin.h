#ifndef MC_CHECK_PLUGIN_H
#define MC_CHECK_PLUGIN_H
/// Samplers compiled by anyone, in any language that can be called from C, for `carlo validate --plugin ./mine.so`. C99
/// and C++.
///
///   static int32_t sample(const void *self, const double *u, double *x) { ... }
///   static double pdf(const void *self, const double *x) { ... }
///   static const mc_sampler samplers[] = {{.name = "Mine", .domain = MC_DISK, .sample = sample, .pdf = pdf}};
///   MC_PLUGIN(samplers)
///
///   cc -O2 -fPIC -shared mine.c -o mine.so && carlo validate --plugin ./mine.so
///
/// Contract of every function below:
///   pure      : the same arguments give the same result, bit for bit; nothing is remembered between two calls
///   arguments : points to as many doubles as the sampler has uniforms (u) or coordinates (x); what is not an output is
///               read only
///   isolation : called from one thread of a process of its own, so that a crash or an endless loop ends no more than
///               that
/// A field that is left out is 0, and 0 is its default.

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Version of the structs below. It changes with any of them; carlo refuses a plugin of another version.
#define MC_PLUGIN_ABI 1

/// The set that the points x lie in, and what the density is measured against.
enum mc_domain {
  MC_INTERVAL = 1,   ///< x[0] in [lo[0], hi[0]], either end may be infinite; 1/length
  MC_BOX = 2,        ///< x[i] in [lo[i], hi[i]], finite, i < dim; 1/length, 1/area or 1/volume
  MC_DISK = 3,       ///< x[0]^2 + x[1]^2 <= 1; 1/area
  MC_TRIANGLE = 4,   ///< barycentric: x[0] >= 0, x[1] >= 0, x[0] + x[1] <= 1, of area 1/2; 1/area
  MC_SPHERE = 5,     ///< unit vectors x[0..2]; 1/steradian. Lobes narrower than 1e-6 rad are resolved about +z only
  MC_HEMISPHERE = 6, ///< unit vectors with x[2] >= 0; 1/steradian
  MC_DISCRETE =
      7 ///< x[0] = 0, 1, ..., hi[0] - 1, at most 2^24 outcomes; pdf is the probability. No invert, eval or weight
};

/// What the sampler computes in: it sets the default tolerances, and u and x are rounded to it.
enum mc_scalar { MC_DOUBLE = 0, MC_FLOAT = 1 };

/// A number that `carlo validate --params "alpha=0.1"` may set.
typedef struct mc_parameter {
  const char* name; ///< letters, digits and _
  double value;     ///< where it is not set
  double lo, hi;    ///< lo <= value <= hi
} mc_parameter;

typedef struct mc_sampler {
  const char* name;    ///< letters, digits and _
  int32_t domain;      ///< one of mc_domain
  int32_t dim;         ///< of MC_BOX: 1 to 3
  double lo[3], hi[3]; ///< of MC_INTERVAL, MC_BOX (all 0: the unit interval or cube) and MC_DISCRETE
  int32_t uniforms;    ///< numbers that one sample takes, at most 6; 0: as many as the domain has dimensions
  int32_t scalar;      ///< one of mc_scalar
  int32_t may_fail;    ///< 1: sample may return 0, and the pdf integrates to the probability that it does not
  int32_t parameter_count;
  const mc_parameter* parameters;

  double pdf_tolerance;    ///< relative rounding error of the pdf's integral; 0: 64 epsilons of the scalar
  double weight_tolerance; ///< relative error of the weight; 0: 1e-4
  double invert_tolerance; ///< |invert(sample(u)) - u|; 0: the square root of the scalar's epsilon

  /// Optional: makes what the other functions get as `self` out of the parameters, in their order; NULL refuses them.
  ///           Without
  /// it `self` is the array of parameters itself, a const double *.
  void* (*create)(const double* parameters);
  void (*destroy)(void* self); ///< optional: frees what create made

  /// u in [0,1)^uniforms -> x in the domain. Returns 1, or 0 where it fails and x means nothing.
  int32_t (*sample)(const void* self, const double* u, double* x);
  /// The density at any x of the domain, finite; 0 outside the support, > 0 at every sample.
  double (*pdf)(const void* self, const double* x);
  /// Optional: the u, with uniforms = dimension of the domain, such that sample(u) = x for x out of sample. Returns 1.
  ///           It states
  /// that sample is one to one, so that |det d sample / d u| pdf = 1 is tested too.
  int32_t (*invert)(const void* self, const double* x, double* u);
  /// Optional: the integrand f >= 0 (with the cosine where there is one) that the sampler is meant for. Where f > 0,
  ///           pdf > 0.
  double (*eval)(const void* self, const double* x);
  /// Optional, with eval: the weight f(x) / pdf(x) that the sampler states for its sample x at u.
  double (*weight)(const void* self, const double* u, const double* x);
} mc_sampler;

/// What mc_plugin, the one function that a plugin exports, returns; it stays valid and unchanged.
typedef struct mc_plugin_info {
  uint32_t abi;           ///< MC_PLUGIN_ABI
  uint32_t sampler_size;  ///< sizeof(mc_sampler)
  uint32_t sampler_count; ///< at least 1
  const mc_sampler* samplers;
} mc_plugin_info;

#ifdef __GNUC__
#define MC_PLUGIN_EXPORT __attribute__((visibility("default")))
#else
#define MC_PLUGIN_EXPORT
#endif

MC_PLUGIN_EXPORT const mc_plugin_info* mc_plugin(void);

/// Defines mc_plugin for an array of samplers.
#define MC_PLUGIN(array)                                                                                               \
  const mc_plugin_info* mc_plugin(void) {                                                                              \
    static const mc_plugin_info info = {MC_PLUGIN_ABI, sizeof(mc_sampler), sizeof(array) / sizeof((array)[0]), array}; \
    return &info;                                                                                                      \
  }

#ifdef __cplusplus
}
#endif

#endif
