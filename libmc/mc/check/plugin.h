#ifndef MC_CHECK_PLUGIN_H
#define MC_CHECK_PLUGIN_H
/// Interface of plugins: distributions and integrands compiled to a shared library. Users pass the library as
/// `carlo validate --plugin ./mine.so`, or as `--plugin` of carlo integrate, converge and trade. Any language that
/// exports C functions works. This header is valid C99 and C++.
///
///   static int32_t sample(const void *self, const double *u, double *x) { ... }
///   static double pdf(const void *self, const double *x) { ... }
///   static const mc_sampler samplers[] = {{.name = "Mine", .domain = MC_DISK, .sample = sample, .pdf = pdf}};
///   MC_PLUGIN(samplers)
///
/// Then compile and check the plugin.
///
///   cc -O2 -fPIC -shared mine.c -o mine.so && carlo validate --plugin ./mine.so
///
/// Contract of every function below:
///   pure      : equal arguments give equal results, bit for bit; no state persists between calls.
///   arguments : u is an array of `uniforms` doubles, x an array of the coordinates of a point. Inputs are read only.
///   isolation : each plugin runs in a process of its own, on one thread. A crash or an endless loop ends only that
///               process.
/// The default of every field is 0; fields that are left out are 0.
///
/// New fields are added at the end of a struct, and carlo reads the sizes of the structs. A plugin compiled against an
/// older version of this header keeps working.

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Version of the structs below. carlo accepts plugins of this version and of every earlier version, and rejects later
/// versions. Version 2 adds MC_PRODUCT, outcomes in addition to a density, breaks, open intervals and integrands.
/// Version 3 adds integrands with several outputs, with up to 1024 dimensions and with an importance density. Version 4
/// adds samplers that take any number of random numbers.
#define MC_PLUGIN_ABI 4

/// The domain of the points x, and the measure of the density.
enum mc_domain {
  MC_INTERVAL = 1,   ///< x[0] in [lo[0], hi[0]], either end may be infinite; 1/length
  MC_BOX = 2,        ///< x[i] in [lo[i], hi[i]] for i < dim, finite; 1/length, 1/area or 1/volume
  MC_DISK = 3,       ///< x[0]^2 + x[1]^2 <= 1; 1/area
  MC_TRIANGLE = 4,   ///< barycentric: x[0] >= 0, x[1] >= 0, x[0] + x[1] <= 1, of area 1/2; 1/area
  MC_SPHERE = 5,     ///< unit vectors x[0..2]; 1/steradian. Lobes narrower than 1e-6 rad are resolved about +z only
  MC_HEMISPHERE = 6, ///< unit vectors with x[2] >= 0; 1/steradian
  /// x[0] = 0, 1, ..., hi[0] - 1, at most 2^24 outcomes; pdf is the probability. No invert, eval or weight.
  MC_DISCRETE = 7,
  /// The product of the factors in `parts`, in the syntax of --domain: "ball"; "annulus=0.5"; "x=-inf:inf,y=-inf:inf"
  /// is the plane; "sphere,t=0:1" is a product; "rotation" are unit quaternions. At most six coordinates.
  MC_PRODUCT = 8
};

/// Result of sample: a failure, a point x, or discrete outcome k (for example a delta lobe) as MC_OUTCOME + k.
enum mc_drawn { MC_FAILED = 0, MC_POINT = 1, MC_OUTCOME = 2 };

/// The scalar type of the plugin's arithmetic. It sets the default tolerances; u and x are rounded to it.
enum mc_scalar { MC_DOUBLE = 0, MC_FLOAT = 1 };

/// A parameter of a plugin, set by `carlo validate --params "alpha=0.1"`.
typedef struct mc_parameter {
  const char* name; ///< letters, digits and _
  double value;     ///< the default value
  double lo,        ///< smallest value
      hi;           ///< largest value
} mc_parameter;

/// A distribution: a domain, sample and pdf; the other functions are optional.
typedef struct mc_sampler {
  const char* name;        ///< letters, digits and _
  int32_t domain;          ///< one of mc_domain
  int32_t dim;             ///< dimension of MC_BOX: 1 to 3
  double lo[3],            ///< lower bounds of MC_INTERVAL, MC_BOX (all 0: the unit interval or cube) and MC_DISCRETE
      hi[3];               ///< upper bounds of the same domains
  int32_t uniforms;        ///< length of u for one sample, at most 6; 0: the dimension of the domain
  int32_t scalar;          ///< one of mc_scalar
  int32_t may_fail;        ///< 1: sample may return MC_FAILED, and the pdf integrates to the probability of success
  int32_t parameter_count; ///< length of parameters
  const mc_parameter* parameters; ///< default values and ranges

  double pdf_tolerance;    ///< relative rounding error of the pdf's integral; 0: 64 epsilons of the scalar
  double weight_tolerance; ///< relative error of the weight; 0: 1e-4
  double invert_tolerance; ///< bound on |invert(sample(u)) - u|; 0: the square root of the scalar's epsilon

  /// Optional: returns the `self` that the other functions receive, for the given parameters in their order; NULL
  /// rejects the parameters. Without create, `self` is the array of parameters, a const double *.
  void* (*create)(const double* parameters);
  void (*destroy)(void* self); ///< optional: frees the result of create

  /// Maps u in [0,1)^uniforms to x in the domain. Returns one of mc_drawn; x is used only for MC_POINT.
  int32_t (*sample)(const void* self, const double* u, double* x);
  /// Returns the density at any x of the domain: finite, 0 outside the support, > 0 at every sample.
  double (*pdf)(const void* self, const double* x);
  /// Optional: for a result x of sample, sets u to the inverse image, so that sample(u) = x, and returns 1. Requires
  /// uniforms = dimension of the domain. An inverse states that sample is one-to-one, so |det d sample / d u| pdf = 1
  /// is tested too.
  int32_t (*invert)(const void* self, const double* x, double* u);
  /// Optional: returns the integrand f >= 0 that the distribution is made for, including any cosine. f > 0 requires pdf
  /// > 0.
  double (*eval)(const void* self, const double* x);
  /// Optional, with eval: returns the stated weight f(x) / pdf(x) of the sample x at u.
  double (*weight)(const void* self, const double* u, const double* x);

  /* Since version 2. */
  const char* parts;     ///< factors of MC_PRODUCT
  int32_t outcomes;      ///< number of discrete outcomes in addition to the density, at most 1000
  int32_t open_interval; ///< 1: sample requires u in (0,1)^uniforms, without 0
  /// With outcomes: returns the probability of outcome k. The pdf integrates to 1 minus the sum of these probabilities.
  double (*probability)(const void* self, int32_t k);
  /// Optional: sets *places to the ascending positions where the density jumps along axis k, and returns their number.
  /// k is less than the dimension of the domain. A density that is constant between the positions is integrated
  /// exactly. The array stays valid as long as self. Units: the coordinate of an interval or box; radius and azimuth in
  /// degrees (disk, annulus); angle from +z and azimuth in degrees (sphere, hemisphere).
  int32_t (*breaks)(const void* self, int32_t axis, const double** places);

  /* Since version 4. */
  /// Instead of sample, for samplers that take a varying number of random numbers, such as rejection: draws x with
  /// numbers next(source) in [0,1). Returns one of mc_drawn. No invert and no weight.
  int32_t (*sample_stream)(const void* self, double (*next)(void* source), void* source, double* x);
} mc_sampler;

/// An integral over a box, for `carlo integrate --plugin`, `carlo converge --plugin` and `carlo trade --plugin`.
typedef struct mc_integrand {
  const char* name;  ///< letters, digits and _
  const char* title; ///< optional: one line
  int32_t dim;       ///< dimension, 1 to 1024
  int32_t has_truth; ///< 1: `truth` is the exact integral
  double truth;      ///< the exact integral, if has_truth
  const double *lo,  ///< dim finite lower bounds; NULL: the unit cube
      *hi;           ///< dim finite upper bounds
  /// Returns the integrand at x, an array of dim numbers.
  double (*eval)(const double* x);
  /// Optional: evaluates `count` points at once, values[i] = eval(x + i dim). With outputs > 1, output k at point i is
  /// values[i outputs + k].
  void (*eval_many)(int64_t count, const double* x, double* values);

  /* Since version 3. */
  int32_t outputs;                 ///< number of values at each point, 1 to 64; 0: one
  int32_t uniforms;                ///< length of u for one call of sample, 1 to 1024; 0: dim
  const char* const* output_names; ///< optional: one name for each output, of letters, digits and _
  const double* truths;            ///< optional, with has_truth: the exact integral of each output, instead of `truth`
  /// Required with outputs > 1, and then eval is NULL: sets values[k] to output k at x.
  void (*eval_outputs)(const double* x, double* values);
  /// Optional, with pdf: maps u in [0,1)^uniforms to a point x of the importance density. Points outside of the bounds
  /// contribute 0. The integral is then the mean of eval(x) / pdf(x).
  void (*sample)(const double* u, double* x);
  /// Returns the density at x, in 1 / volume: > 0 at every sample, and > 0 where the integrand is not 0.
  double (*pdf)(const double* x);
} mc_integrand;

/// Result of mc_plugin, the only function that a plugin exports. It stays valid and unchanged.
typedef struct mc_plugin_info {
  uint32_t abi;               ///< MC_PLUGIN_ABI
  uint32_t sampler_size;      ///< sizeof(mc_sampler)
  uint32_t sampler_count;     ///< length of samplers
  const mc_sampler* samplers; ///< the distributions

  /* Since version 2. */
  uint32_t integrand_size;        ///< sizeof(mc_integrand)
  uint32_t integrand_count;       ///< length of integrands
  const mc_integrand* integrands; ///< the integrands
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

/// Each macro defines mc_plugin: for an array of samplers, for an array of integrands, or for both.
#define MC_PLUGIN(samplers) MC_PLUGIN_INFO(MC_PLUGIN_COUNT(samplers), samplers, sizeof(mc_integrand), 0, 0)
#define MC_INTEGRANDS(integrands) MC_PLUGIN_INFO(0, 0, sizeof(mc_integrand), MC_PLUGIN_COUNT(integrands), integrands)
#define MC_PLUGIN_WITH_INTEGRANDS(samplers, integrands)                                                                \
  MC_PLUGIN_INFO(MC_PLUGIN_COUNT(samplers), samplers, sizeof(mc_integrand), MC_PLUGIN_COUNT(integrands), integrands)

#ifdef __cplusplus
}
#endif

#endif
