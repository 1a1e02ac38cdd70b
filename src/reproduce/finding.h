#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace polargrain {

/// A measured number held to a published or computed one.
struct Finding {
    std::string engine;  ///< whose result it is; empty where no engine takes part
    std::string quantity;
    double measured = 0.0;
    double lowest = 0.0;  ///< of the band that counts as agreement
    double highest = 0.0;
    std::string unit;
    std::string against;  ///< what the band comes from
    std::string why;      ///< the cause where it differs, as far as it is known

    bool agrees() const { return measured >= lowest && measured <= highest; }
};

/// "agrees", or by how much the measured value is off the band: "differs by +12 %".
std::string outcome(const Finding& finding);

/// Findings of one figure in a line per engine: "contact: agrees in 9 of 10; contact-1994: agrees in 2 of 10".
std::string verdict(const std::vector<Finding>& findings);

/// A drawn picture of a figure: stem.png, stem.pdf and stem.csv beside one another.
struct FigurePicture {
    std::filesystem::path stem;
    std::string caption;
};

struct FigureTable {
    std::string caption;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

/// What has come of one figure or table of the paper.
struct FigureResult {
    std::vector<std::string> paragraphs;  ///< what is shown and how it was made
    std::vector<FigurePicture> pictures;
    std::vector<FigureTable> tables;
    std::vector<Finding> findings;
};

}  // namespace polargrain
