#include "src/cli/program.h"

int main(int argc, char** argv) { return polargrain::run_program(argc, argv); }
