#include "src/reproduce/report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "src/core/build_info.h"
#include "src/core/error.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_style = R"(
body { font: 16px/1.5 "DejaVu Sans", Helvetica, Arial, sans-serif; color: #22262c; max-width: 62rem; margin: 2rem auto;
       padding: 0 1.5rem; }
h1 { font-size: 1.7rem; line-height: 1.25; } h2 { font-size: 1.25rem; margin-top: 3rem; border-top: 1px solid #ccd; padding-top: 1.2rem; }
table { border-collapse: collapse; font-size: .86rem; margin: 1rem 0; } caption { text-align: left; color: #556; padding: .3rem 0; white-space: nowrap; }
th, td { text-align: left; padding: .22rem .7rem .22rem 0; border-bottom: 1px solid #e3e5ea; vertical-align: top; }
th { font-weight: 600; } td.good { color: #1b7a4b; } td.off { color: #b3380c; } td.whole { white-space: nowrap; }
figure { margin: 1.2rem 0; } figure img { max-width: 100%; height: auto; } figcaption { font-size: .86rem; color: #556; }
.verdict { font-weight: 600; } code { font-size: .9em; }
)";

std::string contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    require(file.good(), "{}: cannot be read", path.string());
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += c;
        }
    }
    return result;
}

std::string row(const std::vector<std::string>& cells, const char* tag) {
    std::string text = "<tr>";
    for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
    return text + "</tr>\n";
}

std::string table_html(const FigureTable& table) {
    std::string text = fmt::format("<table><caption>{}</caption>\n{}", escaped(table.caption), row(table.header, "th"));
    for (const auto& cells : table.rows) text += row(cells, "td");
    return text + "</table>\n";
}

std::string picture_html(const FigurePicture& picture) {
    const std::string name = picture.stem.filename().string();
    std::string files = fmt::format("{0}.png, {0}.pdf", name);
    if (fs::exists(picture.stem.string() + ".csv")) files += fmt::format(", numbers in {}.csv", name);
    return fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\">\n<figcaption>{0} ({2})</figcaption></figure>\n",
        escaped(picture.caption), base64(contents(picture.stem.string() + ".png")), escaped(files));
}

std::string band(const Finding& f) {
    if (f.lowest == f.highest) return fmt::format("{:.4g}", f.lowest);
    if (f.highest >= 1e3 && f.lowest < 1e2) return fmt::format("at least {:.4g}", f.lowest);
    return fmt::format("{:.4g} to {:.4g}", f.lowest, f.highest);
}

std::string measured(const Finding& f) {
    return std::isfinite(f.measured) ? fmt::format("{:.4g} {}", f.measured, f.unit) : "none";
}

std::string findings_html(const std::vector<Finding>& findings) {
    std::string text = "<table><caption>What was measured, and what it is held to</caption>\n" +
                       row({"engine", "quantity", "measured", "agrees if", "because", "outcome"}, "th");
    for (const Finding& f : findings) {
        const std::string why = f.agrees() || f.why.empty() ? "" : " (" + f.why + ")";
        text += fmt::format(
            "<tr><td class=\"whole\">{}</td><td>{}</td><td>{}</td><td class=\"whole\">{}</td><td>{}</td><td "
            "class=\"{}\">{}</td></tr>\n",
            escaped(f.engine), escaped(f.quantity), escaped(measured(f)), band(f), escaped(f.against),
            f.agrees() ? "good" : "off", escaped(outcome(f) + why));
    }
    return text + "</table>\n";
}

std::string findings_csv(const std::string& id, const std::vector<Finding>& findings) {
    std::string text;
    for (const Finding& f : findings) {
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", id, f.engine, csv_field(f.quantity), f.measured,
                            f.lowest, f.highest, csv_field(f.unit), csv_field(outcome(f)), csv_field(f.against),
                            csv_field(f.agrees() ? "" : f.why));
    }
    return text;
}

void write_text(const fs::path& path, const std::string& text) {
    TextFile file(path);
    file.write(text);
    file.close();
}

}  // namespace

std::string base64(const std::string& bytes) {
    static constexpr const char* k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            word = word << 8 | (k < count ? static_cast<unsigned char>(bytes[at + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? k_digits[word >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

fs::path Report::section(const std::string& id, const char* extension) const {
    return folder_ / "sections" / (id + extension);
}

void Report::add(const Figure& figure, const FigureResult& result) const {
    std::string text = fmt::format("<h2 id=\"{}\">{}</h2>\n<p class=\"verdict\">{}</p>\n", figure.id,
                                   escaped(figure.title), escaped(verdict(result.findings)));
    for (const std::string& paragraph : result.paragraphs) text += fmt::format("<p>{}</p>\n", escaped(paragraph));
    for (const FigurePicture& picture : result.pictures) text += picture_html(picture);
    for (const FigureTable& table : result.tables) text += table_html(table);
    text += findings_html(result.findings);
    make_folder(folder_ / "sections");
    write_text(section(figure.id, ".html"), text);
    write_text(section(figure.id, ".verdict"), verdict(result.findings));
    write_text(section(figure.id, ".csv"), findings_csv(figure.id, result.findings));
}

void Report::write(const std::string& engines) const {
    std::string summary, sections;
    std::string csv = "figure,engine,quantity,measured,lowest,highest,unit,outcome,against,why\n";
    for (const Figure& figure : figures()) {
        if (!fs::exists(section(figure.id, ".html"))) continue;
        summary += fmt::format("<tr><td><a href=\"#{}\">{}</a></td><td>{}</td></tr>\n", figure.id,
                               escaped(figure.title), escaped(contents(section(figure.id, ".verdict"))));
        sections += contents(section(figure.id, ".html"));
        csv += contents(section(figure.id, ".csv"));
    }
    const BuildInfo& build = build_info();
    TextFile page(this->page());
    page.write(
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Hogue &amp; Newland 1994, "
                    "reproduced</title>\n"
                    "<style>{}</style></head><body>\n<h1>Efficient computer simulation of moving granular "
                    "particles<br>reproduced, figure by "
                    "figure</h1>\n<p>C. Hogue, D. Newland, Powder Technology 78 (1994) 51-66 [HN94]. Drawn by "
                    "polargrain {} ({}; {}), "
                    "engines {}. <code>contact-1994</code> is the published method to the letter, <code>contact</code> "
                    "the refined one. Kuo's mixer is from [K02]. A "
                    "verdict counts the numbers that lie within the band they are held to; bands and reasons stand "
                    "beside each.</p>\n"
                    "<table><caption>Verdicts</caption>\n{}{}</table>\n{}</body></html>\n",
                    k_style, escaped(build.version), escaped(build.compiler), escaped(build.flags), escaped(engines),
                    row({"figure", "verdict"}, "th"), summary, sections));
    page.close();
    write_text(folder_ / "verdicts.csv", csv);
}

}  // namespace polargrain
