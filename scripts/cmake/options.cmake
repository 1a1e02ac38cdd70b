option(POLARGRAIN_TESTS "Build the tests" ON)
option(POLARGRAIN_BENCH "Build the benchmarks" OFF)
option(POLARGRAIN_SIMD "Use the vector instructions that the processor has; without them the results are the same" ON)
option(POLARGRAIN_ASSERTS "Check our own invariants at run time" OFF)
set(POLARGRAIN_SANITIZE "" CACHE STRING "Sanitizers to build with, e.g. address,undefined")

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# One optimisation level for every published number; asserts are ours and have their own switch.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

find_program(CCACHE ccache)
if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

add_library(polargrain_warnings INTERFACE)
target_compile_options(polargrain_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
    # A fused multiply-add rounds once where two operations round twice: same input, same bits needs it off.
    -ffp-contract=off)
if(POLARGRAIN_ASSERTS)
    target_compile_definitions(polargrain_warnings INTERFACE POLARGRAIN_ASSERTS)
endif()
if(POLARGRAIN_SANITIZE)
    add_compile_options(-fsanitize=${POLARGRAIN_SANITIZE} -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${POLARGRAIN_SANITIZE})
endif()
