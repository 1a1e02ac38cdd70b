#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace polargrain::testing {

/// A piece of a file that the program handed to the system in one call.
struct Write {
    std::size_t at = 0;
    std::string bytes;

    void put_into(std::string& file) const {
        file.resize(std::max(file.size(), at + bytes.size()));
        file.replace(at, bytes.size(), bytes);
    }
};

/// Of this program in their order, while the list is wanted.
struct RecordedWrites {
    bool wanted = false;
    std::vector<Write> list;
};

inline RecordedWrites& recorded_writes() {
    static RecordedWrites writes;
    return writes;
}

}  // namespace polargrain::testing

/// In place of the system's: notes what is written. To be included by one file of a test program.
extern "C" ssize_t pwrite(int descriptor, const void* bytes, std::size_t count, off_t at) {
    polargrain::testing::RecordedWrites& writes = polargrain::testing::recorded_writes();
    if (writes.wanted) {
        writes.list.push_back({static_cast<std::size_t>(at), std::string(static_cast<const char*>(bytes), count)});
    }
    return syscall(SYS_pwrite64, descriptor, bytes, count, at);
}
