#include "src/core/data_folder.h"

#include <cstdlib>
#include <system_error>

#include "src/core/error.h"

namespace polargrain {

namespace fs = std::filesystem;

fs::path data_folder(const std::string& part) {
    std::error_code status;
    if (const char* data = std::getenv("POLARGRAIN_DATA")) {
        fs::path folder = fs::path(data) / part;
        require(fs::is_directory(folder, status), "POLARGRAIN_DATA is {}: there is no folder {} in it", data, part);
        return folder;
    }
    const fs::path program = fs::read_symlink("/proc/self/exe", status);
    for (const fs::path& data :
         {fs::path(POLARGRAIN_DATA_FOLDER), program.parent_path().parent_path() / "share" / "polargrain"}) {
        fs::path folder = data / part;
        if (fs::is_directory(folder, status)) return folder;
    }
    throw InputError(fmt::format(
        "the folder {} that comes with the program is neither in {} nor in ../share/polargrain beside the program: set "
        "the environment variable POLARGRAIN_DATA to the folder that holds it",
        part, POLARGRAIN_DATA_FOLDER));
}

}  // namespace polargrain
