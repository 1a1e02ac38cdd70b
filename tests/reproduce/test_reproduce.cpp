#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "src/core/error.h"
#include "src/engines/contact/contact_1994.h"
#include "src/engines/contact/contact_engine.h"
#include "src/record/folder_lock.h"
#include "src/reproduce/dominoes.h"
#include "src/reproduce/reproduce.h"
#include "src/reproduce/simulation_figures.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::atomic<bool> k_go_on{false};

EngineAtHand refined() { return {"contact", make_contact}; }
EngineAtHand literal() { return {"contact-1994", make_contact_1994}; }

class Reproduced : public ::testing::Test {
protected:
    void TearDown() override { fs::remove_all(folder_); }

    /// A stand-in for the program: notes each start in starts.txt, then does what `body` says with the run folder in
    /// $4.
    fs::path program(const std::string& body) {
        fs::create_directories(folder_);
        const fs::path path = folder_ / "program.sh";
        std::ofstream(path) << "#!/bin/sh\necho started >> " << (folder_ / "starts.txt").string() << "\n"
                            << body << "\n";
        fs::permissions(path, fs::perms::owner_all);
        return path;
    }
    int starts() const {
        std::ifstream file(folder_ / "starts.txt");
        int count = 0;
        for (std::string line; std::getline(file, line);) ++count;
        return count;
    }

    fs::path folder_ = fs::path(::testing::TempDir()) /
                       ("reproduced-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
};

const std::vector<Piece> k_two{{"a", "x = 1", "contact"}, {"b", "x = 2", "contact"}};
void ignore(const StoreProgress& /*progress*/) {}

TEST_F(Reproduced, FinishedRunsAreKept) {
    const RunStore store(folder_ / "runs", program("mkdir -p $4 && echo {} > $4/summary.json"), {refined()});
    std::vector<std::size_t> done;
    EXPECT_TRUE(store.complete(k_two, 2, k_go_on, [&](const StoreProgress& p) { done.push_back(p.done); }));
    EXPECT_THAT(done, ::testing::ElementsAre(0, 1, 2));
    EXPECT_TRUE(store.finished(k_two[0]) && store.finished(k_two[1]));
    EXPECT_EQ(starts(), 2);
    EXPECT_TRUE(store.complete(k_two, 2, k_go_on, ignore));
    EXPECT_EQ(starts(), 2) << "nothing is run twice";
    fs::remove_all(store.folder_of(k_two[1]));
    EXPECT_TRUE(store.complete(k_two, 2, k_go_on, ignore));
    EXPECT_EQ(starts(), 3) << "only what is missing";
}

TEST_F(Reproduced, AFailedRunIsToldWithItsWords) {
    const RunStore store(folder_ / "runs", program("echo the disk is full >&2; exit 1"), {refined()});
    try {
        store.complete(k_two, 1, k_go_on, ignore);
        ADD_FAILURE();
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), HasSubstr("the disk is full"));
    }
    EXPECT_FALSE(store.finished(k_two[0]));
}

TEST_F(Reproduced, AStopLosesOnlyWhatIsInProgress) {
    std::atomic<bool> stop{false};
    // The first one ends at once, the second never does.
    const RunStore store(folder_ / "runs",
                         program("if [ $(wc -l < " + (folder_ / "starts.txt").string() +
                                 ") = 1 ]; then mkdir -p $4 && echo {} > $4/summary.json; else exec sleep 60; fi"),
                         {refined()});
    EXPECT_FALSE(store.complete(k_two, 1, stop, [&](const StoreProgress& p) { stop = p.done == 1; }));
    EXPECT_TRUE(store.finished(k_two[0]));
    EXPECT_FALSE(store.finished(k_two[1]));
    int left = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "runs")) left += entry.is_directory();
    EXPECT_EQ(left, 1) << "the folder of the one in progress is gone";
}

TEST_F(Reproduced, WhatAKilledProcessLeftGoesAndWhatAnotherWorksAtStays) {
    const RunStore store(folder_ / "runs", program("mkdir -p $4 && echo {} > $4/summary.json"), {refined()});
    const fs::path left = store.folder_of(k_two[0]).string() + ".part12345";
    const fs::path held = store.folder_of(k_two[1]).string() + ".part23456";
    for (const fs::path& part : {left, held}) fs::create_directories(part / "run");
    const FolderLock lock(held);
    EXPECT_TRUE(store.complete(k_two, 2, k_go_on, ignore));
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(held));
    EXPECT_TRUE(store.finished(k_two[0]) && store.finished(k_two[1]));
}

TEST_F(Reproduced, AStopDoesNotWaitForARunThatDoesNotListen) {
    std::atomic<bool> stop{false};
    const RunStore store(folder_ / "runs", program("trap '' INT TERM; exec sleep 60"), {refined()});
    const auto start = std::chrono::steady_clock::now();
    std::thread later([&stop] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        stop = true;
    });
    EXPECT_FALSE(store.complete(k_two, 2, stop, ignore));
    later.join();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(Pieces, GoByWhatTheirResultDependsOn) {
    const std::string one = engine_fingerprint(refined());
    EXPECT_EQ(one, engine_fingerprint(refined()));
    EXPECT_NE(one, engine_fingerprint(literal()));
    EXPECT_EQ(piece_key(k_two[0], one), piece_key({"another name", "x = 1", "contact"}, one));
    EXPECT_NE(piece_key(k_two[0], one), piece_key(k_two[1], one));
    EXPECT_NE(piece_key(k_two[0], one), piece_key(k_two[0], "another engine"));
    EXPECT_NE(piece_key({"a", "", "contact"}, one), piece_key({"a", std::string(1, '\0'), "contact"}, one));
}

TEST(Pieces, AreThoseOfTheEnginesAtHand) {
    EXPECT_EQ(fig11_pieces({"contact"}).size(), 30U);
    EXPECT_EQ(fig11_pieces({"contact-1994", "contact"}).size(), 60U);
    EXPECT_TRUE(fig16_pieces({"dem"}).empty());
    EXPECT_EQ(domino_wave_pieces({"contact"}).size(), 18U);
    EXPECT_EQ(domino_wave_pieces({"contact-1994", "contact"}).size(), 42U);
    EXPECT_EQ(at_hand({"contact", "dem"}, {"dem", "box2d"}), Engines{"dem"});
}

/// What the drawing code itself finds must agree: these figures rest on no simulation.
class DrawnFromTheCode : public Reproduced, public ::testing::WithParamInterface<const char*> {};

TEST_P(DrawnFromTheCode, AgreesWithThePaper) {
    folder_ += GetParam();
    ReproduceSettings settings{find_figures({GetParam()}), folder_, "/nowhere", {refined(), literal()}, 1};
    std::string said;
    const ReproduceEvents events{[](const Figure&, const StoreProgress&) {}, [](const Figure&) {},
                                 [&](const Figure&, const std::string& verdict) { said = verdict; }};
    EXPECT_TRUE(reproduce(settings, k_go_on, events));
    EXPECT_THAT(said, HasSubstr("agrees ("));
    EXPECT_THAT(said, ::testing::Not(HasSubstr("agrees in")));
    for (const char* extension : {".png", ".pdf", ".csv"}) {
        EXPECT_GT(fs::file_size(folder_ / (GetParam() + std::string(extension))), 500U) << extension;
    }
    EXPECT_TRUE(fs::exists(folder_ / "report.html"));
}

INSTANTIATE_TEST_SUITE_P(Figures, DrawnFromTheCode, ::testing::Values("fig2", "fig5", "fig7", "fig9"),
                         [](const auto& figure) { return std::string(figure.param); });

TEST_F(Reproduced, FoldersThatHoldSomethingElseAreLeftAlone) {
    fs::create_directories(folder_);
    EXPECT_NO_THROW(check_reproduce_folder(folder_)) << "an empty folder is fine";
    std::ofstream(folder_ / "thesis.tex") << "precious";
    EXPECT_THROW(check_reproduce_folder(folder_), InputError);
    EXPECT_THROW(check_reproduce_folder(folder_ / "thesis.tex"), InputError);
    fs::create_directories(folder_ / "sections");
    EXPECT_NO_THROW(check_reproduce_folder(folder_));
}

}  // namespace
}  // namespace polargrain
