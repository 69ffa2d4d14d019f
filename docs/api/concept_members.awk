# Doxygen's input filter: gives the members that a concept requires the description that stands at the concept,
# so that the headers need not repeat it in every warp, domain, BSDF and light. A comment in the header wins.
BEGIN {
  # libmc/mc/warp/concept.h, libmc/mc/domain/concept.h, libmc/mc/sampler
  doc["sample"] = "Maps uniform random numbers to a sample; see the concept of this family.";
  doc["pdf"] = "Density with respect to the measure of the domain; see the concept of this family.";
  doc["invert"] = "The inverse of sample(): the point u of the unit cube that sample() maps to x.";
  doc["domain"] = "The domain of the samples.";
  doc["cast"] = "The same object with another scalar type.";
  doc["to_unit"] = "The inverse of from_unit().";
  doc["from_unit"] = "Maps a point of the unit cube to the domain.";
  doc["jacobian"] = "Measure of the domain per volume of the unit cube at this point.";
  doc["measure"] = "Kind of the measure: length, area, solid angle, volume or count.";
  doc["contains"] = "Whether the domain contains the point.";
  doc["chart_axes"] = "Names of the coordinates of the chart.";
  doc["Scalar"] = "The floating-point type.";
  doc["Domain"] = "The domain of the samples.";
  doc["Point"] = "A point of the domain.";
  doc["UnitPoint"] = "A point of the unit cube.";
  doc["dim"] = "Number of dimensions.";
  doc["seed"] = "Seed of the randomisation; each seed gives an independent one.";
  doc["bits"] = "The coordinate as an integer: its leading binary digits.";
  doc["sample_index"] = "Maps a uniform number to an outcome, with its probability and the remapped number.";
  doc["pmf"] = "Probability of an outcome.";
  doc["size"] = "Number of outcomes or elements.";
  # librender/render/{bsdf,light,shape,texture}/concept.h
  doc["eval"] = "Value of the BSDF without the cosine [1/sr].";
  doc["is_delta"] = "Whether only its samples find it, and no ray hits it.";
  doc["lobes"] = "Kinds of its lobes.";
  doc["albedo"] = "Largest share of the light that is scattered, over the colour channels.";
  doc["eta"] = "Index of refraction on the side of wi over that on the side of wo; 1 for reflection.";
  doc["Le"] = "Emitted radiance.";
  doc["is_sampled"] = "Whether direct lighting samples this light.";
  doc["is_infinite"] = "Whether the light is infinitely far away.";
  doc["sample_emission"] = "Samples the first ray of a light path, aimed at the surfaces that cast caustics.";
  doc["emission_pdf"] = "Density with which sample_emission() selects a ray.";
  doc["irradiance"] = "Irradiance from this light.";
  doc["surface_point"] = "Position, normals and texture coordinates at the hit.";
  doc["area"] = "Surface area.";
  doc["bounding_ball"] = "A ball that contains the shape.";
  doc["is_spherical"] = "Whether the shape is a sphere or a part of one.";
  doc["box"] = "Axis-aligned bounds.";
  doc["uv"] = "Texture coordinates.";
  doc["uv_scale"] = "Root of the area in texture coordinates over the area on the surface, around the point.";
  doc["has_uv"] = "Whether the shape has texture coordinates.";
  doc["discard_uvs"] = "Frees the texture coordinates, where no texture needs them.";
  doc["discard_sampling_table"] = "Frees the tables of area sampling, where the shape emits no light.";
  doc["sample_area"] = "Samples a surface point uniformly by area.";
  doc["sample_direction"] = "Samples a direction from a reference point to the shape; none where it is not visible.";
  doc["projected_solid_angle_bound"] = "Upper bound of the projected solid angle of the shape at a reference point [sr].";
  doc["is_filtered"] = "Whether the colour depends on the footprint.";
  doc["least"] = "Smallest value of any channel.";
  doc["require_reflectance"] = "Throws Error that names the place, unless all values lie in [0, 1].";
}

# Doxygen takes the parameters of a requires expression for variables.
/requires\(/ { sub(/requires\([^()]*\)/, "requires"); if (sub(/requires\(.*/, "requires")) in_parameters = 1 }
in_parameters && /\) \{$/ && !/requires/ { in_parameters = 0; print "{"; next }
in_parameters && !/requires/ { next }

# A line that only opens a template belongs to the next line.
/^ +template <.*> *$/ { held = held $0 "\n"; next }
{
  member = "";
  if (match($0, /[A-Za-z_0-9]+\(/)) member = substr($0, RSTART, RLENGTH - 1);
  else if (match($0, /using [A-Za-z]+ =/)) member = substr($0, RSTART + 6, RLENGTH - 8);
  else if ($0 ~ / int dim =/) member = "dim";
  is_declaration = $0 ~ /^  [A-Za-z]/ && $0 !~ /^  return /;
  if (member in doc && is_declaration && before !~ /^ *\/\// && $0 !~ /\/\/\/</) print "  /// " doc[member];
  printf "%s", held;
  print;
  held = "";
  before = $0;
}
