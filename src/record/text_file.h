#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace polargrain {

/// A text file that is written from its beginning. Whatever goes wrong (no such folder, a full disk) is a RunError
/// that names the file.
class TextFile {
public:
    /// Creates the file, or empties one that is there.
    explicit TextFile(std::filesystem::path path);

    void write(std::string_view text);
    /// Hands everything written so far to the operating system: a killed program loses nothing of it.
    void flush();
    /// Flushes and closes; errors that the system reports late surface here.
    void close();

private:
    [[noreturn]] void fail(const char* doing) const;

    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Closer> file_;
};

/// The text as one field of a CSV row, in quotes where it holds a comma, a quote or a line break (RFC 4180).
std::string csv_field(std::string_view text);

}  // namespace polargrain
