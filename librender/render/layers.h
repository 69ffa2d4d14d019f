#pragma once
/// Auxiliary layers of an image, such as normals and albedo.

#include <render/pixel_renderer.h>

#include <map>
#include <string>
#include <vector>

namespace render {

/// Layers of every pixel of the crop, row by row from the top. Each value is from one ray through the centres of pixel
/// and lens: no filter and no noise. The names are channel names for OpenEXR.
///   N.X, N.Y, N.Z : unit shading normal; 0 without a hit.
///   P.X, P.Y, P.Z : position [scene units] plus `origin`, the position of the scene's origin in other coordinates; 0
///                   without a hit.
///   Z             : distance from the camera along the view direction [scene units]; infinite without a hit.
///   albedo.R .G .B : share of light from the camera that the surface reflects and transmits; 0 without a hit. Exact
///                    for diffuse and smooth surfaces; within .02 for rough surfaces.
///   id            : number of the shape in the scene, from 1; 0 without a hit. Exact up to 2^24 shapes.
///   threads       : number of threads; 0: all of the machine.
std::map<std::string, std::vector<float>> layers(const Scene& scene, const ImageExtent& extent,
                                                 const Vec3d& origin = Vec3d::Zero(), int threads = 0);

} // namespace render
