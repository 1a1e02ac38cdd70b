#include <benchmark/benchmark.h>

#include "src/core/build_info.h"

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    const polargrain::BuildInfo& build = polargrain::build_info();
    benchmark::AddCustomContext("compiler", build.compiler);
    benchmark::AddCustomContext("flags", build.flags);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
