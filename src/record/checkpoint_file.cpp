#include "src/record/checkpoint_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>

#include "src/core/error.h"
#include "src/core/hash.h"
#include "src/record/h5.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace {

namespace fs = std::filesystem;
using h5::Handle;

constexpr int k_format = 4;
constexpr std::size_t k_head_bytes = 512;
constexpr std::string_view k_first_line = "polargrain checkpoint\n";

/// The text in front, which vouches for every byte behind it.
std::string head_for(int format, std::string_view bytes) {
    StateHash hash;
    hash.add(bytes);
    std::string head = fmt::format("{}format {}\nbytes {}\nxxh3 {}\n", k_first_line, format, bytes.size(), hash.hex());
    head.resize(k_head_bytes, '\0');
    return head;
}

template <typename T>
void put_all(hid_t file, const std::map<std::string, std::vector<T>>& arrays) {
    for (const auto& [key, values] : arrays) h5::put_data<T>(file, key, values, {values.size()});
}

void write_arrays(const fs::path& path, const LabelledCheckpoint& checkpoint) {
    Handle file = h5::create_file(path.string(), k_head_bytes);
    {
        const Handle top = h5::open_group(file.id(), "/");
        h5::put_text(top.id(), "version", checkpoint.label.version);
        h5::put_text(top.id(), "build", checkpoint.label.build);
        h5::put_text(top.id(), "engine", checkpoint.label.engine);
        h5::put_text(top.id(), "scenario", checkpoint.label.scenario);
    }
    put_all(file.id(), checkpoint.content.all_reals());
    put_all(file.id(), checkpoint.content.all_integers());
    file.close("write the file");
}

void write_head(const fs::path& path) {
    const std::string bytes = content_of(path);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file << head_for(k_format, std::string_view(bytes).substr(k_head_bytes)) << std::flush;
    if (!file) throw h5::Failure("cannot write the checksum");
}

int format_of(std::string_view head) {
    constexpr std::string_view word = "format ";
    int format = 0;
    head.remove_prefix(std::min(head.size(), k_first_line.size()));
    if (head.starts_with(word)) std::from_chars(head.data() + word.size(), head.data() + head.size(), format);
    return format;
}

/// Before HDF5 sees a byte of it.
void check_file(const fs::path& path) {
    const std::string bytes = content_of(path);
    const std::string_view all = bytes;
    require(all.starts_with(k_first_line), "{}: not a checkpoint that polargrain wrote", path.string());
    const int format = format_of(all);
    require(format == k_format,
            "{}: has format {}, and this program knows format {}; resume it with {} polargrain, or "
            "run its scenario.toml again",
            path.string(), format, k_format, format > k_format ? "a newer" : "the older");
    require(all.size() > k_head_bytes && all.substr(0, k_head_bytes) == head_for(k_format, all.substr(k_head_bytes)),
            "{}: is damaged or cut short (its checksum does not fit); a run cannot be carried on from it",
            path.string());
}

void read_arrays(hid_t file, const std::string& group, Checkpoint& into) {
    const Handle here = h5::open_group(file, group.empty() ? "/" : group);
    for (const std::string& name : h5::names_in(here.id())) {
        const std::string key = group.empty() ? name : fmt::format("{}/{}", group, name);
        if (h5::is_group(here.id(), name)) {
            read_arrays(file, key, into);
        } else if (h5::is_real(here.id(), name)) {
            into.put(key, h5::data<double>(here.id(), name));
        } else {
            into.put(key, h5::data<std::int64_t>(here.id(), name));
        }
    }
}

}  // namespace

void write_checkpoint(const fs::path& path, const LabelledCheckpoint& checkpoint) {
    fs::path part = path;
    part += ".part";
    try {
        write_arrays(part, checkpoint);
        write_head(part);
        put_in_place(part, path);
    } catch (const h5::Failure& failure) {
        std::error_code ignored;
        fs::remove(part, ignored);
        throw RunError(fmt::format("{}: {}", part.string(), failure.what()));
    }
}

bool is_checkpoint(const fs::path& path) {
    std::string head(k_first_line.size(), '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    return file.good() && head == k_first_line;
}

LabelledCheckpoint read_checkpoint(const fs::path& path) {
    require(fs::exists(path), "{}: there is no checkpoint", path.string());
    require_readable(path);
    check_file(path);
    try {
        LabelledCheckpoint checkpoint;
        const Handle file = h5::open_file(path.string());
        const Handle top = h5::open_group(file.id(), "/");
        checkpoint.label = {h5::text(top.id(), "version"), h5::text(top.id(), "build"), h5::text(top.id(), "engine"),
                            h5::text(top.id(), "scenario")};
        read_arrays(file.id(), "", checkpoint.content);
        return checkpoint;
    } catch (const h5::Failure& failure) {
        throw InputError(fmt::format("{}: cannot be read: {}", path.string(), failure.what()));
    }
}

}  // namespace polargrain
