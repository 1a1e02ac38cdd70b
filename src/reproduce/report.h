#pragma once

#include <filesystem>
#include <string>

#include "src/reproduce/figure.h"

namespace polargrain {

/// The report of a folder: report.html, which shows every figure drawn into it so far, and verdicts.csv with all their
/// findings. Each figure's part is kept under sections/, so that figures can be drawn one by one.
class Report {
public:
    explicit Report(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Puts a figure in, in place of an earlier version. Its pictures are there.
    void add(const Figure& figure, const FigureResult& result) const;
    /// Writes report.html and verdicts.csv anew. One file each, pictures inside, nothing taken from a network.
    /// `engines`: what the build has, in words.
    void write(const std::string& engines) const;

    std::filesystem::path page() const { return folder_ / "report.html"; }

private:
    std::filesystem::path section(const std::string& id, const char* extension) const;

    std::filesystem::path folder_;
};

/// Base 64 of RFC 4648.
std::string base64(const std::string& bytes);

}  // namespace polargrain
