#pragma once

// Private to this folder: the few things that we want of HDF5, with owned handles and errors as exceptions.

#include <hdf5.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace polargrain::h5 {

/// What went wrong, in HDF5's own words; the caller knows the file and adds it.
class Failure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Throws Failure with the innermost message of the library's error stack where the result is negative.
void check(std::int64_t result, const std::string& doing);

/// Owns an identifier of the library.
class Handle {
public:
    using Close = herr_t (*)(hid_t);
    Handle() = default;
    /// Takes over; Failure where the identifier is invalid.
    Handle(hid_t id, Close closer, const std::string& doing);
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, -1);
            close_ = other.close_;
        }
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    hid_t id() const { return id_; }
    void reset();
    /// As reset, but a failure is thrown: data may have been lost in it.
    void close(const std::string& doing);

private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

using Size = std::vector<hsize_t>;

template <typename T>
hid_t memory_type();
template <>
inline hid_t memory_type<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t memory_type<std::int32_t>() {
    return H5T_NATIVE_INT32;
}
template <>
inline hid_t memory_type<std::int64_t>() {
    return H5T_NATIVE_INT64;
}

/// Creates (or empties) a file readable by HDF5 1.8 and later, without times of day in it, so that equal content is
/// equal bytes. A program that is killed after a flush leaves it readable.
/// user_block: bytes left free at its beginning for the caller, 0 or a power of two from 512.
Handle create_file(const std::string& path, hsize_t user_block = 0);
Handle open_file(const std::string& path);
Handle create_group(hid_t parent, const std::string& name);
Handle open_group(hid_t parent, const std::string& name);
/// Whether the entry of a group is a group itself, or a dataset.
bool is_group(hid_t parent, const std::string& name);
/// Whether a dataset holds floating-point numbers, or integers.
bool is_real(hid_t parent, const std::string& name);
/// Names of what is in a group, in alphabetical order.
std::vector<std::string> names_in(hid_t group);
bool has_attribute(hid_t object, const std::string& name);

void put_text(hid_t object, const std::string& name, const std::string& value);
void put_texts(hid_t object, const std::string& name, const std::vector<std::string>& values);
std::string text(hid_t object, const std::string& name);

// The typed functions below come for double, int32_t and int64_t.

template <typename T>
void put_number(hid_t object, const std::string& name, T value);
template <typename T>
void put_numbers(hid_t object, const std::string& name, std::span<const T> values);
template <typename T>
T number(hid_t object, const std::string& name);
template <typename T>
std::vector<T> numbers(hid_t object, const std::string& name);

/// A dataset of fixed size. Groups that the name asks for are made.
template <typename T>
Handle put_data(hid_t parent, const std::string& name, std::span<const T> values, const Size& size);
/// In place of what a dataset holds; as many values.
template <typename T>
void overwrite(const Handle& dataset, std::span<const T> values);
/// All of a dataset, row by row; `size` receives its extent.
template <typename T>
std::vector<T> data(hid_t parent, const std::string& name, Size* size = nullptr);
/// Rows first ... first + count - 1 along the first axis of a dataset.
template <typename T>
std::vector<T> rows(hid_t parent, const std::string& name, hsize_t first, hsize_t count);

/// A dataset that grows along its first axis.
template <typename T>
class Growing {
public:
    Growing() = default;
    /// row: extent of one row, empty for a plain list.
    Growing(hid_t parent, const std::string& name, Size row);
    /// Any number of whole rows.
    void append(std::span<const T> values);
    hid_t id() const { return dataset_.id(); }

    /// Where its chunks stand in the file, counted from the file's beginning [byte]; they never move. To be called
    /// after a flush.
    const std::vector<std::int64_t>& chunk_places();
    hsize_t rows() const { return size_.at(0); }

private:
    Handle dataset_;
    Size size_;  // extent so far; the first axis grows
    hsize_t chunk_rows_ = 1;
    std::vector<std::int64_t> chunk_places_;  // as far as they have been asked for
};

/// Rows in a chunk of a growing dataset whose rows have so many numbers of type T.
template <typename T>
hsize_t rows_per_chunk(std::size_t row_length);

/// Waits until the file is on the disk.
void sync(hid_t file);

}  // namespace polargrain::h5
