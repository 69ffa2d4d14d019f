// A sampler for `carlo validate --plugin`: directions about +z of density (n + 1) / (2 pi) cos^n.
#include <mc/check/plugin.h>

#include <math.h>

static const double two_pi = 6.28318530717958648;

static int32_t sample(const void* n, const double* u, double* w) {
  const double z = pow(1 - u[0], 1 / (*(const double*)n + 1)), r = sqrt(1 - z * z);
  w[0] = r * cos(two_pi * u[1]), w[1] = r * sin(two_pi * u[1]), w[2] = z;
  return 1;
}

static double pdf(const void* self, const double* w) {
  const double n = *(const double*)self;
  return (n + 1) / two_pi * pow(w[2], n);
}

static const mc_parameter parameters[] = {{"n", 1, 0, 1e6}}; // default, least, largest
static const mc_sampler samplers[] = {
    {.name = "Lobe",
     .domain = MC_HEMISPHERE,
     .parameters = parameters,
     .parameter_count = 1,
     .sample = sample,
     .pdf = pdf},
};
MC_PLUGIN(samplers)
