#include "src/record/private_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "src/core/error.h"

namespace polargrain {

PrivateFolder::PrivateFolder(const std::filesystem::path& path) {
    std::string name = path.string() + ".part-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) {
        throw RunError(fmt::format("{}: cannot make a folder beside it: {}; give a place in which you may write",
                                   path.string(), std::generic_category().message(errno)));
    }
    path_ = name;
}

PrivateFolder::~PrivateFolder() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove_all(path_, ignored);
}

}  // namespace polargrain
