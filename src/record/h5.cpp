#include "src/record/h5.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <numeric>
#include <system_error>

namespace polargrain::h5 {

namespace {

/// Every handle here is closed by its owner. The library's own cleaning up at exit is switched off, because it follows
/// dangling pointers after a file that could not be closed on a full disk; it must be told before anything else.
const herr_t k_no_cleaning_at_exit = H5dont_atexit();

/// Walks from the call of ours to where it went wrong; the last one visited knows best.
herr_t keep_description(unsigned /*level*/, const H5E_error2_t* error, void* text) {
    if (error->desc != nullptr && *error->desc != '\0') *static_cast<std::string*>(text) = error->desc;
    return 0;
}

/// The system's own words, where the library has put them among numbers of its own.
std::string in_short(const std::string& reason) {
    const std::string before = "error message = '";
    const std::size_t at = reason.find(before);
    if (at == std::string::npos) return reason;
    const std::size_t from = at + before.size();
    return reason.substr(from, reason.find('\'', from) - from);
}

Handle property_list(hid_t kind) { return {H5Pcreate(kind), H5Pclose, "create a property list"}; }

Handle untimed(hid_t kind) {
    Handle list = property_list(kind);
    check(H5Pset_obj_track_times(list.id(), false), "leave times out");
    return list;
}

Handle simple_space(const Size& size) {
    return {H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose, "describe an extent"};
}

Handle text_type() {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe a text");
    check(H5Tset_size(type.id(), H5T_VARIABLE), "describe a text");
    check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "describe a text");
    return type;
}

Handle open_attribute(hid_t object, const std::string& name) {
    return {H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "read attribute " + name};
}

void put_attribute(hid_t object, const std::string& name, hid_t type, const Handle& space, const void* values) {
    const std::string doing = "write attribute " + name;
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                           doing);
    check(H5Awrite(attribute.id(), type, values), doing);
}

Size extent(hid_t space) {
    const int rank = H5Sget_simple_extent_ndims(space);
    check(rank, "read an extent");
    Size size(static_cast<std::size_t>(rank));
    check(H5Sget_simple_extent_dims(space, size.data(), nullptr), "read an extent");
    return size;
}

std::size_t product(const Size& size) {
    return static_cast<std::size_t>(std::accumulate(size.begin(), size.end(), hsize_t{1}, std::multiplies<>()));
}

/// How many numbers there are to be read, in a file that may be damaged: no compression makes a thousandth of anything.
template <typename T>
std::size_t believable_product(hid_t object, const Size& size, const std::string& name) {
    const Handle file(H5Iget_file_id(object), H5Fclose, "read " + name);
    hsize_t bytes = 0;
    check(H5Fget_filesize(file.id(), &bytes), "read " + name);
    constexpr hsize_t most_packed = 2000;
    const auto most = static_cast<double>(most_packed * bytes);
    double claimed = sizeof(T);
    for (const hsize_t n : size) claimed *= static_cast<double>(n);
    if (claimed > most) {
        throw Failure(fmt::format("cannot read {}: it claims {:.3g} bytes in a file of {}", name, claimed, bytes));
    }
    return product(size);
}

Handle scalar_space() { return {H5Screate(H5S_SCALAR), H5Sclose, "describe an extent"}; }

Handle open_dataset(hid_t parent, const std::string& name) {
    return {H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "read dataset " + name};
}

Handle space_of(const Handle& dataset) { return {H5Dget_space(dataset.id()), H5Sclose, "read an extent"}; }

/// Selects rows along the first axis of a file space whose extent is `size`.
void select_rows(const Handle& space, const Size& size, hsize_t first, hsize_t count) {
    Size start(size.size(), 0);
    Size block = size;
    start[0] = first;
    block[0] = count;
    check(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), "select rows");
}

/// Small enough to be written whole at each flush, large enough not to drown in book-keeping.
constexpr std::size_t k_chunk_bytes = 8192;

}  // namespace

void check(std::int64_t result, const std::string& doing) {
    if (result >= 0) return;
    std::string reason;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_description, &reason);
    throw Failure(fmt::format("cannot {}: {}", doing, in_short(reason)));
}

Handle::Handle(hid_t id, Close closer, const std::string& doing) : id_(id), close_(closer) { check(id, doing); }

void Handle::reset() {
    if (id_ >= 0) close_(std::exchange(id_, -1));
}

void Handle::close(const std::string& doing) {
    if (id_ >= 0) check(close_(std::exchange(id_, -1)), doing);
}

Handle create_file(const std::string& path, hsize_t user_block) {
    // Errors are thrown, with the file's name; the library's own print-out would only precede them.
    check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr), "set up");
    const Handle access = property_list(H5P_FILE_ACCESS);
    // Version 1.8 of the format has no mark "open for writing", which would lock out readers after a kill.
    check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18), "choose the format");
    const Handle creation = untimed(H5P_FILE_CREATE);
    check(H5Pset_userblock(creation.id(), user_block), "leave room at the beginning");
    return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose, "create the file"};
}

Handle open_file(const std::string& path) {
    check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr), "set up");
    return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open the file"};
}

Handle create_group(hid_t parent, const std::string& name) {
    const Handle creation = untimed(H5P_GROUP_CREATE);
    return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Gclose,
            "create group " + name};
}

Handle open_group(hid_t parent, const std::string& name) {
    return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "read group " + name};
}

std::vector<std::string> names_in(hid_t group) {
    H5G_info_t info;
    check(H5Gget_info(group, &info), "list a group");
    std::vector<std::string> names;
    for (hsize_t k = 0; k < info.nlinks; ++k) {
        const auto name_at = [&](char* text, std::size_t size) {
            return H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, text, size, H5P_DEFAULT);
        };
        const ssize_t length = name_at(nullptr, 0);
        check(length, "list a group");
        std::string name(static_cast<std::size_t>(length) + 1, '\0');
        check(name_at(name.data(), name.size()), "list a group");
        name.pop_back();
        names.push_back(std::move(name));
    }
    return names;
}

bool is_group(hid_t parent, const std::string& name) {
    const Handle object(H5Oopen(parent, name.c_str(), H5P_DEFAULT), H5Oclose, "read " + name);
    return H5Iget_type(object.id()) == H5I_GROUP;
}

bool is_real(hid_t parent, const std::string& name) {
    const Handle dataset = open_dataset(parent, name);
    const Handle type(H5Dget_type(dataset.id()), H5Tclose, "read the type of " + name);
    return H5Tget_class(type.id()) == H5T_FLOAT;
}

bool has_attribute(hid_t object, const std::string& name) { return H5Aexists(object, name.c_str()) > 0; }

void put_text(hid_t object, const std::string& name, const std::string& value) {
    const char* text = value.c_str();
    put_attribute(object, name, text_type().id(), scalar_space(), static_cast<const void*>(&text));
}

void put_texts(hid_t object, const std::string& name, const std::vector<std::string>& values) {
    std::vector<const char*> texts;
    texts.reserve(values.size());
    for (const std::string& value : values) texts.push_back(value.c_str());
    put_attribute(object, name, text_type().id(), simple_space({values.size()}),
                  static_cast<const void*>(texts.data()));
}

std::string text(hid_t object, const std::string& name) {
    const Handle attribute = open_attribute(object, name);
    const Handle stored(H5Aget_type(attribute.id()), H5Tclose, "read attribute " + name);
    const Handle space(H5Aget_space(attribute.id()), H5Sclose, "read attribute " + name);
    // Room is made for one text, whose length the library finds.
    if (H5Tis_variable_str(stored.id()) <= 0 || product(extent(space.id())) != 1) {
        throw Failure(fmt::format("cannot read attribute {}: it is no text", name));
    }
    const Handle type = text_type();
    char* value = nullptr;
    check(H5Aread(attribute.id(), type.id(), static_cast<void*>(&value)), "read attribute " + name);
    std::string copy = value != nullptr ? value : "";
    H5free_memory(value);
    return copy;
}

template <typename T>
void put_number(hid_t object, const std::string& name, T value) {
    put_attribute(object, name, memory_type<T>(), scalar_space(), &value);
}

template <typename T>
void put_numbers(hid_t object, const std::string& name, std::span<const T> values) {
    put_attribute(object, name, memory_type<T>(), simple_space({values.size()}), values.data());
}

template <typename T>
T number(hid_t object, const std::string& name) {
    const std::vector<T> values = numbers<T>(object, name);
    if (values.empty()) throw Failure(fmt::format("cannot read attribute {}: it is empty", name));
    return values[0];
}

template <typename T>
std::vector<T> numbers(hid_t object, const std::string& name) {
    const Handle attribute = open_attribute(object, name);
    const Handle space(H5Aget_space(attribute.id()), H5Sclose, "read an extent");
    std::vector<T> values(believable_product<T>(object, extent(space.id()), name));
    check(H5Aread(attribute.id(), memory_type<T>(), values.data()), "read attribute " + name);
    return values;
}

template <typename T>
Handle put_data(hid_t parent, const std::string& name, std::span<const T> values, const Size& size) {
    const std::string doing = "write dataset " + name;
    const Handle creation = untimed(H5P_DATASET_CREATE);
    const Handle space = simple_space(size);
    const Handle links = property_list(H5P_LINK_CREATE);
    check(H5Pset_create_intermediate_group(links.id(), 1), doing);
    Handle dataset(
        H5Dcreate2(parent, name.c_str(), memory_type<T>(), space.id(), links.id(), creation.id(), H5P_DEFAULT),
        H5Dclose, doing);
    if (!values.empty()) {
        check(H5Dwrite(dataset.id(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), doing);
    }
    return dataset;
}

template <typename T>
void overwrite(const Handle& dataset, std::span<const T> values) {
    check(H5Dwrite(dataset.id(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "write over a dataset");
}

template <typename T>
std::vector<T> data(hid_t parent, const std::string& name, Size* size) {
    const Handle dataset = open_dataset(parent, name);
    const Size found = extent(space_of(dataset).id());
    if (size != nullptr) *size = found;
    std::vector<T> values(believable_product<T>(dataset.id(), found, name));
    if (values.empty()) return values;
    check(H5Dread(dataset.id(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "read dataset " + name);
    return values;
}

template <typename T>
std::vector<T> rows(hid_t parent, const std::string& name, hsize_t first, hsize_t count) {
    const Handle dataset = open_dataset(parent, name);
    const Handle space = space_of(dataset);
    Size size = extent(space.id());
    if (size.empty()) throw Failure(fmt::format("cannot read rows of dataset {}: it has none", name));
    if (first > size[0] || count > size[0] - first) {
        throw Failure(
            fmt::format("cannot read {} rows from {} on of dataset {}: it has {}", count, first, name, size[0]));
    }
    select_rows(space, size, first, count);
    size[0] = count;
    std::vector<T> values(believable_product<T>(dataset.id(), size, name));
    if (values.empty()) return values;
    const Handle memory = simple_space(size);
    check(H5Dread(dataset.id(), memory_type<T>(), memory.id(), space.id(), H5P_DEFAULT, values.data()),
          "read dataset " + name);
    return values;
}

template <typename T>
hsize_t rows_per_chunk(std::size_t row_length) {
    return std::max<hsize_t>(1, k_chunk_bytes / std::max<std::size_t>(1, row_length * sizeof(T)));
}

template <typename T>
Growing<T>::Growing(hid_t parent, const std::string& name, Size row) : size_(std::move(row)) {
    size_.insert(size_.begin(), 1);
    const std::size_t row_length = product(size_);
    size_[0] = 0;
    // An axis of no grains still needs room for a chunk of one.
    Size most = size_, chunk = size_;
    for (std::size_t axis = 1; axis < size_.size(); ++axis)
        most[axis] = chunk[axis] = std::max<hsize_t>(1, size_[axis]);
    most[0] = H5S_UNLIMITED;
    chunk[0] = chunk_rows_ = rows_per_chunk<T>(row_length);
    const Handle creation = untimed(H5P_DATASET_CREATE);
    const int rank = static_cast<int>(size_.size());
    check(H5Pset_chunk(creation.id(), rank, chunk.data()), "cut dataset " + name + " into chunks");
    const Handle space(H5Screate_simple(rank, size_.data(), most.data()), H5Sclose, "describe an extent");
    dataset_ =
        Handle(H5Dcreate2(parent, name.c_str(), memory_type<T>(), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
               H5Dclose, "create dataset " + name);
}

template <typename T>
void Growing<T>::append(std::span<const T> values) {
    Size added = size_;
    added[0] = 1;
    const std::size_t row_length = product(added);
    added[0] = row_length > 0 ? values.size() / row_length : 1;
    if (added[0] == 0) return;
    const hsize_t first = size_[0];
    size_[0] += added[0];
    check(H5Dset_extent(dataset_.id(), size_.data()), "append to a dataset");
    if (values.empty()) return;
    const Handle space = space_of(dataset_);
    select_rows(space, size_, first, added[0]);
    const Handle memory = simple_space(added);
    check(H5Dwrite(dataset_.id(), memory_type<T>(), memory.id(), space.id(), H5P_DEFAULT, values.data()),
          "append to a dataset");
}

template <typename T>
const std::vector<std::int64_t>& Growing<T>::chunk_places() {
    Size corner(size_.size(), 0);
    for (hsize_t k = chunk_places_.size(); k * chunk_rows_ < size_[0]; ++k) {
        corner[0] = k * chunk_rows_;
        unsigned filters = 0;
        haddr_t place = HADDR_UNDEF;
        hsize_t bytes = 0;
        check(H5Dget_chunk_info_by_coord(dataset_.id(), corner.data(), &filters, &place, &bytes), "find a chunk");
        chunk_places_.push_back(static_cast<std::int64_t>(place));
    }
    return chunk_places_;
}

void sync(hid_t file) {
    void* descriptor = nullptr;
    check(H5Fget_vfd_handle(file, H5P_DEFAULT, &descriptor), "write the file");
    if (fsync(*static_cast<const int*>(descriptor)) == 0) return;
    throw Failure("cannot write the file: " + std::generic_category().message(errno));
}

#define POLARGRAIN_H5_FOR(T)                                                                 \
    template void put_number<T>(hid_t, const std::string&, T);                               \
    template void put_numbers<T>(hid_t, const std::string&, std::span<const T>);             \
    template T number<T>(hid_t, const std::string&);                                         \
    template std::vector<T> numbers<T>(hid_t, const std::string&);                           \
    template Handle put_data<T>(hid_t, const std::string&, std::span<const T>, const Size&); \
    template void overwrite<T>(const Handle&, std::span<const T>);                           \
    template std::vector<T> data<T>(hid_t, const std::string&, Size*);                       \
    template std::vector<T> rows<T>(hid_t, const std::string&, hsize_t, hsize_t);            \
    template hsize_t rows_per_chunk<T>(std::size_t);                                         \
    template class Growing<T>;
POLARGRAIN_H5_FOR(double)
POLARGRAIN_H5_FOR(std::int32_t)
POLARGRAIN_H5_FOR(std::int64_t)
#undef POLARGRAIN_H5_FOR

}  // namespace polargrain::h5
