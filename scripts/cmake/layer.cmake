# polargrain_layer(NAME DIRECTORY dir [LINK public libraries...] [PRIVATE libraries...] [EXCLUDE files...])
#
# A static library polargrain_NAME from every .cpp of a folder. Headers are included by their path from the top of
# the tree. Third-party libraries are PRIVATE, so that none of their types can leak into another layer's header.
function(polargrain_layer name)
    cmake_parse_arguments(LAYER "" "DIRECTORY" "LINK;PRIVATE;EXCLUDE" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${LAYER_DIRECTORY}/*.cpp)
    foreach(excluded IN LISTS LAYER_EXCLUDE)
        list(REMOVE_ITEM sources ${CMAKE_SOURCE_DIR}/${LAYER_DIRECTORY}/${excluded})
    endforeach()
    set(headers_only ${CMAKE_BINARY_DIR}/empty.cpp)
    if(NOT EXISTS ${headers_only})
        file(WRITE ${headers_only} "")
    endif()
    add_library(polargrain_${name} STATIC ${sources} ${headers_only})
    target_include_directories(polargrain_${name} PUBLIC ${CMAKE_SOURCE_DIR})
    target_link_libraries(polargrain_${name} PUBLIC ${LAYER_LINK} PRIVATE polargrain_warnings ${LAYER_PRIVATE})
endfunction()
