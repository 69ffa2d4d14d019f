// The table of the plugin; the functions are in lobe.rs.
#include <mc/check/plugin.h>

int32_t lobe_sample(const void* self, const double* u, double* w);
double lobe_pdf(const void* self, const double* w);

static const mc_sampler samplers[] = {
    {.name = "Lobe", .domain = MC_HEMISPHERE, .sample = lobe_sample, .pdf = lobe_pdf},
};
MC_PLUGIN(samplers)
