#include "src/cli/progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace polargrain {

namespace {

constexpr std::chrono::seconds k_between_lines{10};
constexpr int k_bar_width = 30;
constexpr const char* k_erase_line = "\r\x1b[K";

}  // namespace

DisplayMode display_mode(bool quiet) {
    if (quiet) return DisplayMode::none;
    return isatty(STDOUT_FILENO) != 0 ? DisplayMode::bar : DisplayMode::lines;
}

std::string clock_text(double seconds) {
    const auto whole = static_cast<long long>(std::min(std::max(0.0, std::round(seconds)), 1e15));
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

ProgressDisplay::ProgressDisplay(std::string label, DisplayMode mode, std::string counted)
    : label_(std::move(label)), mode_(mode), counted_(std::move(counted)), last_line_(Clock::now()) {}

ProgressDisplay::~ProgressDisplay() {
    if (mode_ != DisplayMode::bar) return;
    std::fputs(k_erase_line, stdout);
    std::fflush(stdout);
}

std::string ProgressDisplay::numbers(const Progress& progress) const {
    const std::string left = clock_text(progress.seconds_left);
    if (!counted_.empty()) {
        return fmt::format("{} of {:.0f} {}, {:.3g}/s, {} left", progress.steps, progress.end, counted_,
                           progress.steps_per_second, left);
    }
    return fmt::format("t = {:.4g} of {:.4g} s, {:.4g} steps/s, {} left", progress.time, progress.end,
                       progress.steps_per_second, left);
}

void ProgressDisplay::show(const Progress& progress) {
    const double fraction = progress.end > 0.0 ? std::clamp(progress.time / progress.end, 0.0, 1.0) : 1.0;
    if (mode_ == DisplayMode::lines) show_line(progress, fraction);
    if (mode_ != DisplayMode::bar) return;
    const int done = static_cast<int>(fraction * k_bar_width);
    fmt::print("{}{} [{:#<{}}{:.<{}}] {:3.0f} %  {}", k_erase_line, label_, "", done, "", k_bar_width - done,
               100.0 * fraction, numbers(progress));
    std::fflush(stdout);
}

void ProgressDisplay::show_line(const Progress& progress, double fraction) {
    const Clock::time_point now = Clock::now();
    const int quarters = std::min(3, static_cast<int>(4.0 * fraction));
    if (quarters <= quarters_shown_ && now - last_line_ < k_between_lines) return;
    quarters_shown_ = std::max(quarters, quarters_shown_);
    last_line_ = now;
    fmt::print("{} {:3.0f} %  {}\n", label_, 100.0 * fraction, numbers(progress));
    std::fflush(stdout);
}

}  // namespace polargrain
