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
  doc["measure"] = "Total measure of the domain: length, area, solid angle or volume.";
  doc["contains"] = "Whether the domain contains the point.";
  doc["chart_axes"] = "Names of the coordinates of the chart.";
  doc["Scalar"] = "The floating-point type.";
  doc["Domain"] = "The domain of the samples.";
  doc["Point"] = "A point of the domain.";
  doc["UnitPoint"] = "A point of the unit cube.";
  doc["dim"] = "Number of dimensions.";
  doc["seed"] = "Seed of the randomisation; each seed gives an independent one.";
  doc["bits"] = "The coordinate as an integer: its leading binary digits.";
  # librender/render/{bsdf,light,shape,texture}/concept.h
  doc["eval"] = "Value of the BSDF without the cosine [1/sr].";
  doc["is_delta"] = "Whether all scattered light leaves in directions of zero solid angle.";
  doc["has_delta"] = "Whether some scattered light leaves in directions of zero solid angle.";
  doc["is_near_specular"] = "Whether the lobe is so narrow that light sampling hardly contributes.";
  doc["casts_caustics"] = "Whether light that leaves this surface may form caustics.";
  doc["transmits"] = "Whether light passes to the other side.";
  doc["albedo"] = "Reflectance per colour channel, for denoising and layers.";
  doc["eta"] = "Ratio of the indices of refraction, inside over outside.";
  doc["Le"] = "Emitted radiance.";
  doc["is_sampled"] = "Whether direct lighting samples this light.";
  doc["is_infinite"] = "Whether the light is infinitely far away.";
  doc["irradiance"] = "Irradiance from this light.";
  doc["surface_point"] = "Position, normals and texture coordinates at the hit.";
  doc["area"] = "Surface area.";
}

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
