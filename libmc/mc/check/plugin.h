#ifndef MC_CHECK_PLUGIN_H
#define MC_CHECK_PLUGIN_H
/// Samplers and integrands compiled by anyone, in any language that can be called from C, for `carlo validate --plugin
/// ./mine.so` and `carlo converge --plugin ./mine.so`. C99 and C++.
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
///
/// Structs grow at their end only, and carlo is told their sizes: a plugin that was compiled against an older version
/// of this header works on.

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Version of the structs below. carlo takes plugins of this and of every earlier one, and refuses later ones.
///   2 : MC_PRODUCT, outcomes beside a density, breaks, open intervals, integrands
#define MC_PLUGIN_ABI 2

/// The set that the points x lie in, and what the density is measured against.
enum mc_domain {
  MC_INTERVAL = 1,   ///< x[0] in [lo[0], hi[0]], either end may be infinite; 1/length
  MC_BOX = 2,        ///< x[i] in [lo[i], hi[i]], finite, i < dim; 1/length, 1/area or 1/volume
  MC_DISK = 3,       ///< x[0]^2 + x[1]^2 <= 1; 1/area
  MC_TRIANGLE = 4,   ///< barycentric: x[0] >= 0, x[1] >= 0, x[0] + x[1] <= 1, of area 1/2; 1/area
  MC_SPHERE = 5,     ///< unit vectors x[0..2]; 1/steradian. Lobes narrower than 1e-6 rad are resolved about +z only
  MC_HEMISPHERE = 6, ///< unit vectors with x[2] >= 0; 1/steradian
  MC_DISCRETE =
      7, ///< x[0] = 0, 1, ..., hi[0] - 1, at most 2^24 outcomes; pdf is the probability. No invert, eval or weight
  /// What `parts` lists, as for --domain: "ball"; "annulus=0.5"; "x=-inf:inf,y=-inf:inf" is the plane, "sphere,t=0:1" a
  /// product. At most three dimensions in four coordinates
  MC_PRODUCT = 8
};

/// What sample returns: nothing, a point, or, by MC_OUTCOME + k, the discrete outcome k (a delta lobe, say).
enum mc_drawn { MC_FAILED = 0, MC_POINT = 1, MC_OUTCOME = 2 };

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
  ///           Without it `self` is the array of parameters itself, a const double *.
  void* (*create)(const double* parameters);
  void (*destroy)(void* self); ///< optional: frees what create made

  /// u in [0,1)^uniforms -> x in the domain. Returns one of mc_drawn; x means something for MC_POINT.
  int32_t (*sample)(const void* self, const double* u, double* x);
  /// The density at any x of the domain, finite; 0 outside the support, > 0 at every sample.
  double (*pdf)(const void* self, const double* x);
  /// Optional: the u, with uniforms = dimension of the domain, such that sample(u) = x for x out of sample. Returns 1.
  ///           It states that sample is one to one, so that |det d sample / d u| pdf = 1 is tested too.
  int32_t (*invert)(const void* self, const double* x, double* u);
  /// Optional: the integrand f >= 0 (with the cosine where there is one) that the sampler is meant for. Where f > 0,
  ///           pdf > 0.
  double (*eval)(const void* self, const double* x);
  /// Optional, with eval: the weight f(x) / pdf(x) that the sampler states for its sample x at u.
  double (*weight)(const void* self, const double* u, const double* x);

  /* Since version 2. */
  const char* parts;     ///< of MC_PRODUCT
  int32_t outcomes;      ///< discrete ones beside the density, at most 1000
  int32_t open_interval; ///< 1: sample wants u in (0,1)^uniforms, no u is 0
  /// With outcomes: the probability of outcome k. The pdf integrates to what they leave of 1.
  double (*probability)(const void* self, int32_t k);
  /// Optional: where the density jumps along axis k of the domain, k < its dimensions: what is constant between is then
  ///           exact. An axis is a coordinate of an interval or box; radius and azimuth in degrees (disk, annulus);
  ///           angle from +z and azimuth in degrees (sphere, hemisphere). Sets *places to ascending numbers that stay
  ///           valid as long as self, and returns how many.
  int32_t (*breaks)(const void* self, int32_t axis, const double** places);
} mc_sampler;

/// An integral over a box, for `carlo converge --plugin` and `carlo trade --plugin`.
typedef struct mc_integrand {
  const char* name;  ///< letters, digits and _
  const char* title; ///< optional: one line
  int32_t dim;       ///< 1 to 64
  int32_t has_truth; ///< 1: truth is the integral
  double truth;
  const double *lo, *hi; ///< dim bounds each, finite; NULL: the unit cube
  /// The integrand at x, dim numbers.
  double (*eval)(const double* x);
  /// Optional: count of them at once, values[i] = eval(x + i dim).
  void (*eval_many)(int64_t count, const double* x, double* values);
} mc_integrand;

/// What mc_plugin, the one function that a plugin exports, returns; it stays valid and unchanged.
typedef struct mc_plugin_info {
  uint32_t abi;          ///< MC_PLUGIN_ABI
  uint32_t sampler_size; ///< sizeof(mc_sampler)
  uint32_t sampler_count;
  const mc_sampler* samplers;

  /* Since version 2. */
  uint32_t integrand_size; ///< sizeof(mc_integrand)
  uint32_t integrand_count;
  const mc_integrand* integrands;
} mc_plugin_info;

#ifdef __GNUC__
#define MC_PLUGIN_EXPORT __attribute__((visibility("default")))
#else
#define MC_PLUGIN_EXPORT
#endif

MC_PLUGIN_EXPORT const mc_plugin_info* mc_plugin(void);

#define MC_PLUGIN_COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define MC_PLUGIN_INFO(...)                                                                                            \
  const mc_plugin_info* mc_plugin(void) {                                                                              \
    static const mc_plugin_info info = {MC_PLUGIN_ABI, sizeof(mc_sampler), __VA_ARGS__};                               \
    return &info;                                                                                                      \
  }

/// Define mc_plugin: for an array of samplers, for one of integrands, and for both.
#define MC_PLUGIN(samplers) MC_PLUGIN_INFO(MC_PLUGIN_COUNT(samplers), samplers, sizeof(mc_integrand), 0, 0)
#define MC_INTEGRANDS(integrands) MC_PLUGIN_INFO(0, 0, sizeof(mc_integrand), MC_PLUGIN_COUNT(integrands), integrands)
#define MC_PLUGIN_WITH_INTEGRANDS(samplers, integrands)                                                                \
  MC_PLUGIN_INFO(MC_PLUGIN_COUNT(samplers), samplers, sizeof(mc_integrand), MC_PLUGIN_COUNT(integrands), integrands)

#ifdef __cplusplus
}
#endif

#endif
