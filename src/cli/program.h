#pragma once

namespace polargrain {

/// The program: reads the command line, runs the command, turns errors into messages on standard error and returns
/// the exit code: 0 done, 1 the run failed, 2 the input or the command line is wrong, 130 interrupted.
int run_program(int argc, const char* const* argv);

}  // namespace polargrain
