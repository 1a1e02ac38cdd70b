#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>

#include "src/core/error.h"
#include "src/core/random.h"
#include "src/record/checkpoint_file.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

using testing::content;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
namespace fs = std::filesystem;

LabelledCheckpoint some_checkpoint() {
    LabelledCheckpoint checkpoint;
    checkpoint.label = {"0.1.0", "GNU 12; -O2", "contact-1994", "0123456789abcdef"};
    checkpoint.content.put("reals",
                           std::vector{0.1, -0.0, std::nan(""), std::numeric_limits<double>::denorm_min(), 1e300});
    checkpoint.content.put("sinks/0/length", std::vector<std::int64_t>{-1, 1LL << 62U});
    checkpoint.content.put("engine/contact-1994/bodies", std::vector<std::int64_t>{});
    checkpoint.content.put("engine/none", std::vector<double>{});
    return checkpoint;
}

void write_text(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string message_of_reading(const fs::path& path) {
    try {
        read_checkpoint(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(CheckpointFile, GivesBackEveryBit) {
    const TemporaryFolder folder("checkpoint");
    const LabelledCheckpoint written = some_checkpoint();
    write_checkpoint(folder / "checkpoint.h5", written);
    EXPECT_FALSE(fs::exists(folder / "checkpoint.h5.part"));
    const LabelledCheckpoint read = read_checkpoint(folder / "checkpoint.h5");
    EXPECT_EQ(read.label.version, written.label.version);
    EXPECT_EQ(read.label.build, written.label.build);
    EXPECT_EQ(read.label.engine, written.label.engine);
    EXPECT_EQ(read.label.scenario, written.label.scenario);
    EXPECT_EQ(read.content.all_integers(), written.content.all_integers());
    ASSERT_EQ(read.content.all_reals().size(), written.content.all_reals().size());
    for (const auto& [key, values] : written.content.all_reals()) {
        const std::vector<double>& back = read.content.reals(key);
        ASSERT_EQ(back.size(), values.size()) << key;
        if (values.empty()) continue;
        EXPECT_EQ(std::memcmp(back.data(), values.data(), values.size() * sizeof(double)), 0) << key;
    }
}

TEST(CheckpointFile, IsRefusedWhereOneByteIsAnother) {
    const TemporaryFolder folder("checkpoint");
    write_checkpoint(folder / "good.h5", some_checkpoint());
    const std::string good = content(folder / "good.h5");
    RandomStream random(20261122, RandomPurpose::test);
    for (int k = 0; k < 400; ++k) {
        std::string bad = good;
        const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(good.size()));
        bad[at] = static_cast<char>(bad[at] ^ static_cast<char>(1 + k % 255));
        write_text(folder / "bad.h5", bad);
        EXPECT_THROW(read_checkpoint(folder / "bad.h5"), InputError) << "byte " << at << " of " << good.size();
    }
}

TEST(CheckpointFile, IsRefusedWhereItIsCutShortOrLonger) {
    const TemporaryFolder folder("checkpoint");
    write_checkpoint(folder / "good.h5", some_checkpoint());
    const std::string good = content(folder / "good.h5");
    for (const std::size_t length : {std::size_t{0}, std::size_t{10}, std::size_t{40}, std::size_t{511},
                                     std::size_t{512}, good.size() / 2, good.size() - 1}) {
        write_text(folder / "bad.h5", good.substr(0, length));
        EXPECT_THROW(read_checkpoint(folder / "bad.h5"), InputError) << length << " bytes of " << good.size();
    }
    write_text(folder / "bad.h5", good + "x");
    EXPECT_THROW(read_checkpoint(folder / "bad.h5"), InputError);
}

TEST(CheckpointFile, SaysWhatIsWrong) {
    const TemporaryFolder folder("checkpoint");
    EXPECT_THAT(message_of_reading(folder / "none.h5"), HasSubstr("none.h5: there is no checkpoint"));
    write_text(folder / "foreign.h5", "\x89HDF\r\n\x1a\n and so on");
    EXPECT_THAT(message_of_reading(folder / "foreign.h5"), HasSubstr("not a checkpoint that polargrain wrote"));

    write_checkpoint(folder / "good.h5", some_checkpoint());
    std::string text = content(folder / "good.h5");
    text.replace(text.find("format 4"), 8, "format 7");
    write_text(folder / "newer.h5", text);
    EXPECT_THAT(message_of_reading(folder / "newer.h5"), HasSubstr("a newer polargrain"));
    text = content(folder / "good.h5");
    write_text(folder / "short.h5", text.substr(0, text.size() - 100));
    EXPECT_THAT(message_of_reading(folder / "short.h5"), HasSubstr("damaged or cut short"));
}

/// Lets no file of this process grow beyond so many bytes while it lives.
class LargestFile {
public:
    explicit LargestFile(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~LargestFile() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    LargestFile(const LargestFile&) = delete;
    LargestFile& operator=(const LargestFile&) = delete;

private:
    void (*handler_)(int);
    rlimit before_{};
};

TEST(CheckpointFile, AFullDiskLeavesTheLastGoodOne) {
    const TemporaryFolder folder("checkpoint");
    const fs::path file = folder / "checkpoint.h5";
    write_checkpoint(file, some_checkpoint());
    const std::string good = content(file);
    LabelledCheckpoint larger = some_checkpoint();
    larger.content.put("more", std::vector<double>(10000, 1.0));
    for (const rlim_t room : {rlim_t{100}, rlim_t{3000}, rlim_t{50000}}) {
        const LargestFile limit(room);
        try {
            write_checkpoint(file, larger);
            ADD_FAILURE() << "80 kB went into " << room << " bytes";
        } catch (const RunError& error) {
            EXPECT_THAT(error.what(), HasSubstr(file.string()));
        }
        EXPECT_EQ(content(file), good);
    }
    write_checkpoint(file, larger);
    EXPECT_EQ(read_checkpoint(file).content.reals("more").size(), 10000U);
}

}  // namespace
}  // namespace polargrain
