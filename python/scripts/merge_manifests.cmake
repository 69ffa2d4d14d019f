# One list of installed files from those of the components, because scikit-build reads one.
# Usage: cmake -DBUILD=FOLDER -P merge_manifests.cmake
file(GLOB manifests ${BUILD}/install_manifest_*.txt)
set(files)
foreach(manifest ${manifests})
  file(STRINGS ${manifest} lines)
  list(APPEND files ${lines})
endforeach()
list(JOIN files "\n" text)
file(WRITE ${BUILD}/install_manifest.txt "${text}\n")
file(REMOVE ${manifests})
