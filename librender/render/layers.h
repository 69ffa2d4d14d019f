#pragma once
/// What a picture shows beside light.

#include <render/pixel_renderer.h>

#include <map>
#include <string>
#include <vector>

namespace render {

/// Of every pixel of the part what the ray through its middle, from the middle of the lens, meets, row by row: one ray,
/// no filter, no noise. By their names as channels of an EXR:
///   N.X, N.Y, N.Z : the shading normal, unit; 0 where nothing is met
///   P.X, P.Y, P.Z : the point [scene units], in the coordinates whose point `origin` is the scene's origin; 0 there
///   Z             : how far it lies from the camera along the viewing direction [scene units]; infinite there
///   albedo.R .G .B : the share of light from the camera that the surface reflects and lets through; 0 there. Exact of
///                   what is diffuse or smooth, to .02 of what is rough
///   id            : the number of the shape in the order in which the scene lists them, from 1; 0 there. To 2^24
std::map<std::string, std::vector<float>> layers(const Scene& scene, const ImageExtent& extent,
                                                 const Vec3d& origin = Vec3d::Zero(), int threads = 0);

} // namespace render
