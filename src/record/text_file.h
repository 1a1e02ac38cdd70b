#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "src/core/hash.h"
#include "src/model/checkpoint.h"

namespace polargrain {

/// A text file that is written from its beginning, or carried on. Whatever goes wrong (no such folder, a full disk) is
/// a RunError that names the file.
class TextFile {
public:
    /// Creates the file, or empties one that is there.
    explicit TextFile(std::filesystem::path path);
    /// Carries on a file from where it was when `save` put it into the checkpoint; what follows is cut off. InputError
    /// as in `check`.
    TextFile(std::filesystem::path path, const Checkpoint& saved);

    /// InputError where the file is not there, or is another than when `save` put it into the checkpoint, but for what
    /// has been written behind. Changes nothing.
    static void check(const std::filesystem::path& path, const Checkpoint& saved);

    void write(std::string_view text);
    /// Hands everything written so far to the operating system: a killed program loses nothing of it.
    void flush();
    /// Flushes, and waits until it is on the disk: a machine that loses its power loses nothing of it.
    void sync();
    /// Syncs, and puts the length of the file and the hash of its content.
    void save(Checkpoint& checkpoint);
    /// Flushes and closes; errors that the system reports late surface here.
    void close();

private:
    [[noreturn]] void fail(const char* doing) const;

    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Closer> file_;
    std::int64_t length_ = 0;  // [byte] so far
    TextHash content_;
};

/// Writes a file as a whole: beside its place first, and renamed when it is on the disk, so that at any instant it is
/// the old one, the new one or absent, never half of one.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// All bytes of a file; none where it is absent or cannot be read.
std::string content_of(const std::filesystem::path& path);

/// InputError where there can be no folder of that name to write into: a file or a link to nothing stands there or
/// above it, a name is too long, or what is there may not be written into. Changes nothing.
void check_place(const std::filesystem::path& folder);

/// Makes the folder and those above it where they are absent. RunError names it where that fails, or where nothing can
/// be written into it.
void make_folder(const std::filesystem::path& folder);

/// Makes the folders above a file that is to be written, where they are absent. InputError and RunError as from
/// check_place and make_folder.
void make_folder_of(const std::filesystem::path& file);

/// Removes the file, or the link; a folder of that name stays. Throws std::filesystem::filesystem_error.
void remove_file(const std::filesystem::path& path);

/// Removes the folder if there is nothing in it.
void remove_if_empty(const std::filesystem::path& folder);

/// InputError where there is something else than a file, or one that may not be read.
void require_readable(const std::filesystem::path& path);

/// Waits until the file, or the names in a folder, are on the disk; RunError names it.
void sync_file(const std::filesystem::path& path);

/// Puts `part`, which is complete, on the disk and in the place of `path`.
void put_in_place(const std::filesystem::path& part, const std::filesystem::path& path);

/// The text as one field of a CSV row, in quotes where it holds a comma, a quote or a line break (RFC 4180).
std::string csv_field(std::string_view text);

}  // namespace polargrain
