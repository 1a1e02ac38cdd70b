#include "src/record/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

#include "src/core/error.h"

namespace polargrain {

TextFile::TextFile(std::filesystem::path path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "w")) {
    if (!file_) fail("create");
}

void TextFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail("write");
}

void TextFile::flush() {
    if (std::fflush(file_.get()) != 0) fail("write");
}

void TextFile::close() {
    flush();
    if (std::fclose(file_.release()) != 0) fail("close");
}

void TextFile::fail(const char* doing) const {
    const std::string reason = std::generic_category().message(errno);
    throw RunError(fmt::format("{}: cannot {} the file: {}", path_.string(), doing, reason));
}

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

}  // namespace polargrain
