#include <render/io/mitsuba/unsupported.h>

#include <array>

namespace render::mitsuba {

namespace {

struct Reason {
  std::string_view tag, type, text;
};

constexpr std::string_view other_phase_functions = "this phase function is not supported; use hg or isotropic";
constexpr std::string_view no_gradients = "derivatives of a picture are not supported; use path";
constexpr std::string_view no_curves = "curves are not supported; convert them to a mesh";
constexpr std::string_view no_layers = "layers are not supported; use plastic or roughplastic";
constexpr std::string_view no_bumps = "bump and normal maps are not supported; use the BSDF inside it";
constexpr std::string_view no_polarisation = "polarisation is not supported; use the BSDF without it";
constexpr std::string_view no_sky_model = "sky models are not supported; use envmap with a picture of the sky";
constexpr std::string_view tessellate = "this shape is not supported; convert it to a mesh (obj or ply)";
constexpr std::string_view no_instances = "instances are not supported; repeat the shape";
constexpr std::string_view no_such_filter = "filters with negative weights are not supported; use gaussian";
constexpr std::string_view no_spectra = "spectra of a wavelength are not supported; colours are RGB";

constexpr auto reasons = std::to_array<Reason>({
    {"integrator", "prb", no_gradients},
    {"integrator", "prb_basic", no_gradients},
    {"integrator", "prbvolpath", no_gradients},
    {"integrator", "prb_projective", no_gradients},
    {"integrator", "direct_projective", no_gradients},
    {"integrator", "bdpt",
     "bidirectional path tracing is not supported; use path, with --strategy mis+lt for caustics"},
    {"integrator", "ptracer", "use path, with --strategy mis+lt for paths from the lights"},
    {"integrator", "photonmapper", "photon maps are not supported; use path, with --strategy mis+lt for caustics"},
    {"integrator", "sppm", "photon maps are not supported; use path, with --strategy mis+lt for caustics"},
    {"integrator", "pssmlt", "Markov chains are not supported; use path"},
    {"integrator", "mlt", "Markov chains are not supported; use path"},
    {"integrator", "depth", "use path; --layers of carlo render writes the depth"},
    {"integrator", "stokes", no_polarisation},
    {"bsdf", "principled", "the principled BSDF is not supported; use roughplastic, roughconductor or roughdielectric"},
    {"bsdf", "principledthin", "the principled BSDF is not supported; use roughplastic or mask"},
    {"bsdf", "hair", "hair is not supported; use roughplastic"},
    {"bsdf", "measured", "measured materials are not supported; use roughplastic or roughconductor"},
    {"bsdf", "measured_polarized", no_polarisation},
    {"bsdf", "pplastic", no_polarisation},
    {"bsdf", "polarizer", no_polarisation},
    {"bsdf", "retarder", no_polarisation},
    {"bsdf", "circular", no_polarisation},
    {"bsdf", "bumpmap", no_bumps},
    {"bsdf", "normalmap", no_bumps},
    {"bsdf", "bump", no_bumps},
    {"bsdf", "blendbsdf", "mixtures of BSDFs are not supported; use mask for holes, or one of the BSDFs inside it"},
    {"bsdf", "mixturebsdf", "mixtures of BSDFs are not supported; use one of the BSDFs inside it"},
    {"bsdf", "phong", "use roughplastic"},
    {"bsdf", "ward", "use roughconductor"},
    {"bsdf", "coating", no_layers},
    {"bsdf", "roughcoating", no_layers},
    {"bsdf", "roughdiffuse", "use diffuse"},
    {"bsdf", "difftrans", "diffuse transmission is not supported; use diffuse"},
    {"emitter", "projector", "projected pictures are not supported; use point"},
    {"emitter", "collimated", "beams are not supported; use directional"},
    {"emitter", "directionalarea", "use directional, or a shape with an area emitter"},
    {"emitter", "sky", no_sky_model},
    {"emitter", "sun", "use directional"},
    {"emitter", "sunsky", no_sky_model},
    {"shape", "heightfield", tessellate},
    {"shape", "sdfgrid", tessellate},
    {"shape", "ellipsoids", tessellate},
    {"shape", "hair", no_curves},
    {"shape", "linearcurve", no_curves},
    {"shape", "bsplinecurve", no_curves},
    {"shape", "shapegroup", no_instances},
    {"shape", "instance", no_instances},
    {"shape", "merge", "use the shapes inside it"},
    {"sensor", "spherical", "panoramas are not supported; use perspective"},
    {"sensor", "radiancemeter", "measurements without a picture are not supported; use perspective"},
    {"sensor", "irradiancemeter", "measurements without a picture are not supported; use perspective"},
    {"sensor", "fluencemeter", "measurements without a picture are not supported; use perspective"},
    {"sensor", "distant", "measurements without a picture are not supported; use perspective"},
    {"sensor", "batch", "use one sensor"},
    {"film", "specfilm", no_spectra},
    {"film", "mfilm", "use hdrfilm"},
    {"rfilter", "mitchell", no_such_filter},
    {"rfilter", "catmullrom", no_such_filter},
    {"rfilter", "lanczos", no_such_filter},
    {"texture", "mesh_attribute", "colours of vertices are not supported; use bitmap"},
    {"texture", "volume", "use bitmap"},
    {"medium", "heterogeneous", "media of varying density are not supported; use homogeneous"},
    {"phase", "rayleigh", other_phase_functions},
    {"phase", "blendphase", other_phase_functions},
    {"phase", "mixturephase", other_phase_functions},
    {"phase", "tabphase", other_phase_functions},
    {"phase", "sggx", other_phase_functions},
    {"phase", "microflake", other_phase_functions},
    {"phase", "kkay", other_phase_functions},
});

} // namespace

std::string_view why_unsupported(std::string_view tag, std::string_view type) {
  for (const Reason& r : reasons)
    if (r.tag == tag && r.type == type) return r.text;
  return {};
}

} // namespace render::mitsuba
