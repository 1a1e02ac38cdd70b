# Loops over blocks of contacts and over the vertices of outlines, once for every instruction set; which of them runs is
# decided at run time (src/core/instruction_set.h). All round alike, so that this changes no bit.
if(POLARGRAIN_SIMD AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_definitions(polargrain_detect PUBLIC POLARGRAIN_SIMD)
    foreach(kernels src/detect/outline_kernels src/engines/contact/lane_kernels)
        set_source_files_properties(${kernels}_avx2.cpp PROPERTIES COMPILE_OPTIONS "-mavx2")
        set_source_files_properties(${kernels}_avx512.cpp PROPERTIES COMPILE_OPTIONS "-mavx512f")
    endforeach()
endif()
