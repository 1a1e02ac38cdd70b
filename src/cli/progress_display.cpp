#include "src/cli/progress_display.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace polargrain {

namespace {

constexpr std::chrono::seconds k_between_lines{10};
constexpr std::size_t k_bar_width = 30, k_least_bar_width = 4;
constexpr std::size_t k_usual_columns = 80;
constexpr const char* k_erase_line = "\r\x1b[K";

/// Where that fails, as when the terminal is gone, the loop goes on to where it is told to stop.
void say(const std::string& text) {
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
}

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

std::size_t terminal_columns() {
    winsize window{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0) return window.ws_col;
    const char* const given = std::getenv("COLUMNS");
    const std::string_view word = given != nullptr ? given : "";
    std::size_t columns = 0;
    std::from_chars(word.data(), word.data() + word.size(), columns);
    return columns > 0 ? columns : k_usual_columns;
}

ProgressDisplay::ProgressDisplay(std::string label, DisplayMode mode, std::string counted)
    : label_(std::move(label)), mode_(mode), counted_(std::move(counted)), last_line_(Clock::now()) {}

ProgressDisplay::~ProgressDisplay() {
    if (mode_ != DisplayMode::bar) return;
    say(k_erase_line);
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
    say(k_erase_line + bar_line(fraction, numbers(progress)));
}

/// Never as wide as the terminal: what is wrapped into a second row could not be erased.
std::string ProgressDisplay::bar_line(double fraction, const std::string& numbers) const {
    const std::size_t room = terminal_columns() - 1;
    const std::string tail = fmt::format("{:3.0f} %  {}", 100.0 * fraction, numbers);
    const std::size_t others = label_.size() + tail.size() + std::string_view(" [] ").size();
    const std::size_t width = std::clamp(room - std::min(room, others), k_least_bar_width, k_bar_width);
    const auto done = static_cast<std::size_t>(fraction * static_cast<double>(width));
    return fmt::format("{} [{:#<{}}{:.<{}}] {}", label_, "", done, "", width - done, tail).substr(0, room);
}

void ProgressDisplay::show_line(const Progress& progress, double fraction) {
    const Clock::time_point now = Clock::now();
    const int quarters = std::min(3, static_cast<int>(4.0 * fraction));
    if (quarters <= quarters_shown_ && now - last_line_ < k_between_lines) return;
    quarters_shown_ = std::max(quarters, quarters_shown_);
    last_line_ = now;
    say(fmt::format("{} {:3.0f} %  {}\n", label_, 100.0 * fraction, numbers(progress)));
}

}  // namespace polargrain
