#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "src/run/progress.h"

namespace polargrain {

enum class DisplayMode {
    bar,    ///< one line that is drawn over and over, for a terminal
    lines,  ///< a plain line every ten seconds and at each quarter, for files and pipes
    none,
};

/// bar where standard output is a terminal, lines where it is not, none where quiet.
DisplayMode display_mode(bool quiet);

/// Shows on standard output how far a loop has come: simulated time, step rate, time left.
class ProgressDisplay {
public:
    /// label: what is going on, in front of each line. counted: what the steps of the loop are, where they are not
    /// steps of simulated time.
    ProgressDisplay(std::string label, DisplayMode mode, std::string counted = "");
    /// Takes the bar away, if there is one.
    ~ProgressDisplay();
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    void show(const Progress& progress);

private:
    using Clock = std::chrono::steady_clock;
    void show_line(const Progress& progress, double fraction);
    std::string bar_line(double fraction, const std::string& numbers) const;
    std::string numbers(const Progress& progress) const;

    std::string label_;
    DisplayMode mode_;
    std::string counted_;
    Clock::time_point last_line_;
    int quarters_shown_ = 0;
};

/// Characters that a line on the terminal of standard output has room for; 80 where nothing tells.
std::size_t terminal_columns();

/// "0:07", "12:34", "3:05:00": hours only where there are any.
std::string clock_text(double seconds);

}  // namespace polargrain
