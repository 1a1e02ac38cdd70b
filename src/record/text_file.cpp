#include "src/record/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <fstream>
#include <system_error>
#include <vector>

#include "src/core/error.h"

namespace polargrain {

namespace {

// Where a file's length and hash stand in its part of a checkpoint.
constexpr const char* k_length = "length";
constexpr const char* k_hash = "hash";
constexpr std::size_t k_block_bytes = 65536;

/// Of the first `length` bytes. InputError where there are not as many.
TextHash hash_of(const std::filesystem::path& path, std::int64_t length) {
    std::ifstream file(path, std::ios::binary);
    require(file.good(), "{}: cannot be read, but the checkpoint was made with it", path.string());
    TextHash hash;
    std::string block(k_block_bytes, '\0');
    for (std::int64_t left = length; left > 0;) {
        file.read(block.data(), std::min(left, static_cast<std::int64_t>(k_block_bytes)));
        require(file.gcount() > 0, "{}: is shorter than the {} bytes that it had when the checkpoint was made",
                path.string(), length);
        hash.add(std::string_view(block).substr(0, static_cast<std::size_t>(file.gcount())));
        left -= file.gcount();
    }
    return hash;
}

/// Of the part that was there when the checkpoint was made, having made sure that it is the same.
TextHash kept_content(const std::filesystem::path& path, const Checkpoint& saved) {
    TextHash hash = hash_of(path, saved.integers(k_length).at(0));
    require(static_cast<std::int64_t>(hash.value()) == saved.integers(k_hash).at(0),
            "{}: is not the file that the checkpoint was made with; it has been changed since", path.string());
    return hash;
}

}  // namespace

TextFile::TextFile(std::filesystem::path path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "w")) {
    if (!file_) fail("create");
}

TextFile::TextFile(std::filesystem::path path, const Checkpoint& saved)
    : path_(std::move(path)), length_(saved.integers(k_length).at(0)), content_(kept_content(path_, saved)) {
    file_.reset(std::fopen(path_.c_str(), "r+"));
    if (!file_) fail("carry on");
    if (ftruncate(fileno(file_.get()), length_) != 0) fail("cut");
    if (std::fseek(file_.get(), 0, SEEK_END) != 0) fail("carry on");
}

void TextFile::check(const std::filesystem::path& path, const Checkpoint& saved) { kept_content(path, saved); }

void TextFile::save(Checkpoint& checkpoint) {
    sync();
    checkpoint.put(k_length, std::vector{length_});
    checkpoint.put(k_hash, std::vector{static_cast<std::int64_t>(content_.value())});
}

void TextFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail("write");
    length_ += static_cast<std::int64_t>(text.size());
    content_.add(text);
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

std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void check_place(const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    constexpr const char* k_remedy = "give another folder with -o";
    for (const fs::path& name : folder) {
        require(name.native().size() <= NAME_MAX, "{}: a name of more than {} bytes; {}", folder.string(), NAME_MAX,
                k_remedy);
    }
    // What is absent can be made in the nearest folder above it that is there.
    for (fs::path place = fs::absolute(folder);; place = place.parent_path()) {
        std::error_code failed;
        const fs::file_status there = fs::status(place, failed);
        if (fs::exists(there)) {
            require(fs::is_directory(there), "{}: {} is a file; {}", folder.string(), place.string(), k_remedy);
            require(access(place.c_str(), W_OK | X_OK) == 0, "{}: nothing may be written into {}; {}", folder.string(),
                    place.string(), k_remedy);
            return;
        }
        require(there.type() == fs::file_type::not_found, "{}: {}; {}", folder.string(), failed.message(), k_remedy);
        require(!fs::is_symlink(fs::symlink_status(place, failed)), "{}: {} is a link to nothing; {}", folder.string(),
                place.string(), k_remedy);
    }
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (!failed && access(folder.c_str(), W_OK | X_OK) != 0) failed = {errno, std::generic_category()};
    if (!failed) return;
    throw RunError(fmt::format("{}: cannot make the folder, or write into it: {}; give one in which you may write",
                               folder.string(), failed.message()));
}

void make_folder_of(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.parent_path();
    if (folder.empty()) return;
    check_place(folder);
    make_folder(folder);
}

void remove_file(const std::filesystem::path& path) {
    if (!std::filesystem::is_directory(std::filesystem::symlink_status(path))) std::filesystem::remove(path);
}

// Refuses by itself where something is in it; a link to a folder is left alone too.
void remove_if_empty(const std::filesystem::path& folder) { rmdir(folder.c_str()); }

void require_readable(const std::filesystem::path& path) {
    std::error_code status;
    require(std::filesystem::is_regular_file(path, status), "{}: is no file; give the one that a run has written",
            path.string());
    require(access(path.c_str(), R_OK) == 0, "{}: cannot be read; check its permissions", path.string());
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
