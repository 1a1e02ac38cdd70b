#include "src/record/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "src/core/error.h"

namespace polargrain {

TextFile::TextFile(std::filesystem::path path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "w")) {
    if (!file_) fail("create");
}

TextFile::TextFile(std::filesystem::path path, std::int64_t length)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "r+")), length_(length) {
    require(file_ != nullptr, "{}: cannot be carried on: {}; the checkpoint was made with it", path_.string(),
            std::generic_category().message(errno));
    const auto there = static_cast<std::int64_t>(std::filesystem::file_size(path_));
    require(there >= length, "{}: has {} bytes, but had {} when the checkpoint was made; it has been changed since",
            path_.string(), there, length);
    if (ftruncate(fileno(file_.get()), length) != 0) fail("cut");
    if (std::fseek(file_.get(), 0, SEEK_END) != 0) fail("carry on");
}

void TextFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail("write");
    length_ += static_cast<std::int64_t>(text.size());
}

void TextFile::flush() {
    if (std::fflush(file_.get()) != 0) fail("write");
}

void TextFile::sync() {
    flush();
    if (fsync(fileno(file_.get())) != 0) fail("write");
}

void TextFile::close() {
    flush();
    if (std::fclose(file_.release()) != 0) fail("close");
}

void TextFile::fail(const char* doing) const {
    const std::string reason = std::generic_category().message(errno);
    throw RunError(fmt::format("{}: cannot {} the file: {}", path_.string(), doing, reason));
}

void sync_file(const std::filesystem::path& path) {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool synced = file >= 0 && fsync(file) == 0;
    const int reason = errno;
    if (file >= 0) ::close(file);
    if (synced) return;
    throw RunError(
        fmt::format("{}: cannot be put on the disk: {}", path.string(), std::generic_category().message(reason)));
}

void put_in_place(const std::filesystem::path& part, const std::filesystem::path& path) {
    sync_file(part);
    std::error_code failed;
    std::filesystem::rename(part, path, failed);
    if (failed) throw RunError(fmt::format("{}: cannot be put in place: {}", path.string(), failed.message()));
    // The new name is a change of the folder, which the system writes when it likes.
    sync_file(path.parent_path().empty() ? "." : path.parent_path());
}

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
    std::filesystem::path part = path;
    part += ".part";
    TextFile file(part);
    file.write(text);
    file.close();
    put_in_place(part, path);
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
