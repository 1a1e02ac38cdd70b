# The solver's loops over blocks of contacts, once for every instruction set; which of them runs is decided at run time
# (src/engines/contact/lane_kernels.cpp). All round alike, so that this changes no bit.
if(POLARGRAIN_SIMD AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_definitions(polargrain_contact PUBLIC POLARGRAIN_SIMD)
    set_source_files_properties(src/engines/contact/lane_kernels_avx2.cpp PROPERTIES COMPILE_OPTIONS "-mavx2")
    set_source_files_properties(src/engines/contact/lane_kernels_avx512.cpp PROPERTIES COMPILE_OPTIONS "-mavx512f")
endif()
