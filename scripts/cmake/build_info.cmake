# What src/core/build_info.cpp tells of this build: nothing of the machine, the folder or the time, so that equal builds
# stay equal.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set(flags "${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} -std=c++20 -ffp-contract=off")
if(POLARGRAIN_ASSERTS)
    string(APPEND flags " -DPOLARGRAIN_ASSERTS")
endif()
if(POLARGRAIN_SANITIZE)
    string(APPEND flags " -fsanitize=${POLARGRAIN_SANITIZE}")
endif()
string(REGEX REPLACE " +" " " flags "${flags}")
string(CONCAT libraries
    "Eigen ${Eigen3_VERSION}, CGAL ${CGAL_VERSION}, HDF5 ${HDF5_VERSION}, Cairo ${CAIRO_VERSION}, "
    "toml++ ${TOMLPLUSPLUS_VERSION}, nlohmann-json ${nlohmann_json_VERSION}, CLI11 ${CLI11_VERSION}, Box2D ${box2d_VERSION}, fmt ${fmt_VERSION}")
set_source_files_properties(src/core/build_info.cpp PROPERTIES COMPILE_DEFINITIONS
    "POLARGRAIN_VERSION=\"${PROJECT_VERSION}\";POLARGRAIN_COMPILER=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}\";POLARGRAIN_FLAGS=\"${flags}\";POLARGRAIN_LIBRARIES=\"${libraries}\"")
