# Packages by CPack: cpack -G DEB in the build folder of the preset `package` writes one .deb a component.
# tools/package.sh calls it and tests the result.
set(CPACK_PACKAGE_NAME libmc)
set(CPACK_PACKAGE_VENDOR "the authors of libmc")
set(CPACK_PACKAGE_CONTACT "the authors of libmc <libmc@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_COMPONENTS_ALL)

# A component with the name of its package. DEPENDS: packages besides the shared libraries, which dpkg-shlibdeps finds.
function(mc_package name section depends summary)
  string(TOUPPER ${name} key)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${summary}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SHLIBDEPS ON PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${name} PARENT_SCOPE)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name} RENAME copyright
    COMPONENT ${name})
  install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name} COMPONENT ${name})
endfunction()

set(same_version "(= ${PROJECT_VERSION})")
mc_package(libmc-dev libdevel "libeigen3-dev, libfmt-dev, libtbb-dev, libmpfr-dev, libpcg-cpp-dev"
  "Monte Carlo integration and sampling in C++20: library and headers")
if(MC_BUILD_RENDER)
  mc_package(librender-dev libdevel
    "libmc-dev ${same_version}, libpugixml-dev, zlib1g-dev, libpng-dev, libturbojpeg0-dev, libopenexr-dev"
    "Path tracer built on libmc: library and headers")
endif()
if(TARGET carlo)
  mc_package(carlo science "" "Checks distributions, integrates and renders, with error bars")
endif()
if(TARGET libmc_python)
  mc_package(python3-libmc python "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, carlo ${same_version}"
    "Monte Carlo integration and sampling for NumPy arrays")
endif()
include(CPack)
